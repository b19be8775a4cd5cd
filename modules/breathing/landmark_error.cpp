#include "breathing/landmark_error.h"

#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "core/error.h"

namespace pneuma {
namespace {

/// @param residuals a column for each landmark
LandmarkError errorOf(const Eigen::Matrix3Xd& residuals) {
  const Eigen::ArrayXd lengths = residuals.colwise().norm().transpose().array();
  const double mean = lengths.mean();
  const double squares = (lengths - mean).square().sum();
  return {mean, std::sqrt(squares / static_cast<double>(lengths.size() - 1))};
}

}  // namespace

LandmarkErrors landmarkErrors(std::span<const LandmarkPair> landmarks,
                              std::span<const Vec3> displacement) {
  constexpr std::size_t Fewest = 3;
  if (landmarks.size() != displacement.size()) {
    throw InvalidInput("there are " + std::to_string(landmarks.size()) + " landmarks and " +
                       std::to_string(displacement.size()) + " displacements; each needs one");
  }
  if (landmarks.size() < Fewest) {
    throw InvalidInput("there are " + std::to_string(landmarks.size()) +
                       " landmarks; an error of position needs three at least");
  }
  const auto count = static_cast<Eigen::Index>(landmarks.size());
  Eigen::Matrix3Xd predicted(3, count);
  Eigen::Matrix3Xd marked(3, count);
  for (Eigen::Index n = 0; n < count; ++n) {
    const auto at = static_cast<std::size_t>(n);
    predicted.col(n) = landmarks[at].rest + displacement[at];
    marked.col(n) = landmarks[at].moved;
  }
  const Eigen::Matrix3Xd raw = marked - predicted;
  const Vec3 shift = raw.rowwise().mean();
  const Eigen::Matrix4d rigid = Eigen::umeyama(predicted, marked, false);
  const Eigen::Matrix3Xd turned =
      (rigid.topLeftCorner<3, 3>() * predicted).colwise() + Vec3(rigid.topRightCorner<3, 1>());
  return {errorOf(raw), errorOf(raw.colwise() - shift), errorOf(marked - turned)};
}

}  // namespace pneuma
