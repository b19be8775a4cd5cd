#include "breathing/radial_field.h"

#include <algorithm>
#include <limits>
#include <string>

#include <Eigen/LU>

#include "core/error.h"

namespace pneuma {
namespace {

constexpr double LeastCondition = 1e-14;

}  // namespace

std::vector<std::uint32_t> farthestPoints(std::span<const Vec3> points, std::size_t count) {
  std::vector<std::uint32_t> chosen;
  std::vector<double> squared(points.size(), std::numeric_limits<double>::infinity());
  std::size_t next = 0;
  while (chosen.size() < std::min(count, points.size()) && squared[next] > 0.0) {
    chosen.push_back(static_cast<std::uint32_t>(next));
    const Vec3& last = points[next];
    for (std::size_t n = 0; n < points.size(); ++n) {
      squared[n] = std::min(squared[n], (points[n] - last).squaredNorm());
    }
    next = static_cast<std::size_t>(std::ranges::max_element(squared) - squared.begin());
  }
  return chosen;
}

RadialField::RadialField(std::span<const Vec3> centres, std::span<const Vec3> values) {
  const auto count = static_cast<Eigen::Index>(centres.size());
  if (count < 4 || count > MostCentres || values.size() != centres.size()) {
    throw InvalidInput("a field needs 4 to " + std::to_string(MostCentres) +
                       " points with a value each; it got " + std::to_string(centres.size()) +
                       " and " + std::to_string(values.size()));
  }
  Box3 box;
  for (const Vec3& p : centres) box.extend(p);
  // In shares of the box's diagonal, so that rows of distances and of coordinates are alike.
  const double size = box.diagonal().norm();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(count + 4, count + 4);
  Eigen::MatrixX3d wanted = Eigen::MatrixX3d::Zero(count + 4, 3);
  centres_.resize(count, 3);
  for (Eigen::Index row = 0; row < count; ++row) {
    const Vec3& p = centres[static_cast<std::size_t>(row)];
    for (Eigen::Index k = 0; k < count; ++k) {
      matrix(row, k) = (p - centres[static_cast<std::size_t>(k)]).norm() / size;
    }
    matrix(row, count) = matrix(count, row) = 1.0;
    const Vec3 place = (p - box.center()) / size;
    matrix.block<1, 3>(row, count + 1) = place.transpose();
    matrix.block<3, 1>(count + 1, row) = place;
    wanted.row(row) = values[static_cast<std::size_t>(row)].transpose();
    centres_.row(row) = p.transpose().array();
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(matrix);
  Eigen::MatrixX3d solved = factors.solve(wanted);
  solved += factors.solve(wanted - matrix * solved);  // once more, for the last bits
  if (!(factors.rcond() > LeastCondition) || !solved.allFinite()) {
    throw InvalidInput(
        "the points of a field lie in a plane, or one of them is there twice; examine the surface "
        "with 'pneuma info'");
  }
  weights_ = solved.topRows(count) / size;
  map_ = solved.bottomRows(3).transpose() / size;
  offset_ = solved.row(count).transpose() - map_ * box.center();
}

Vec3 RadialField::at(const Vec3& p) const {
  const Numbers distance = ((centres_.col(0) - p.x()).square() +
                            (centres_.col(1) - p.y()).square() + (centres_.col(2) - p.z()).square())
                               .sqrt();
  return weights_.transpose() * distance.matrix() + map_ * p + offset_;
}

Eigen::Matrix3d RadialField::gradientAt(const Vec3& p) const {
  const Numbers distance = ((centres_.col(0) - p.x()).square() +
                            (centres_.col(1) - p.y()).square() + (centres_.col(2) - p.z()).square())
                               .sqrt();
  Eigen::Matrix3d gradient = map_;
  for (int axis = 0; axis < 3; ++axis) {
    const Numbers slope = (distance > 0.0).select((p[axis] - centres_.col(axis)) / distance, 0.0);
    gradient.col(axis) += weights_.transpose() * slope.matrix();
  }
  return gradient;
}

}  // namespace pneuma
