#include "pipeline/landmark_lungs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/LU>
#include <Eigen/QR>

#include "core/error.h"
#include "core/random.h"
#include "geometry/nearest_triangle.h"

namespace pneuma {

void tellSidesByWalls(std::span<LandmarkPair> landmarks,
                      const std::map<Side, TriangleMesh>& walls) {
  constexpr double MostOutsideMm = 20.0;
  // From within a lung the other's wall lies behind its own, so that the nearest wall is its own.
  std::map<Side, NearestTriangle> nearest;
  Box3 box;
  for (const auto& [side, wall] : walls) {
    nearest.try_emplace(side, wall);
    box.extend(bounds(wall));
  }
  for (std::size_t n = 0; n < landmarks.size(); ++n) {
    LandmarkPair& pair = landmarks[n];
    const double outsideMm = box.exteriorDistance(pair.rest);
    if (!(outsideMm < MostOutsideMm)) {
      throw InvalidInput("landmark " + std::to_string(n + 1) + " lies " +
                         std::to_string(std::lround(outsideMm)) +
                         " mm outside of the lungs; landmarks and surfaces need one frame, LPS in "
                         "mm, and the lung that they lie in");
    }
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [side, wall] : nearest) {
      const double distance = wall.distanceMm(pair.rest);
      if (distance >= least) continue;
      least = distance;
      pair.side = side;
    }
  }
}

void tellSidesByGap(std::span<LandmarkPair> landmarks) {
  std::vector<double> xs;
  for (const LandmarkPair& pair : landmarks) xs.push_back(pair.rest.x());
  std::ranges::sort(xs);
  double middle = xs.empty() ? 0.0 : xs.front();
  double gap = 0.0;
  for (std::size_t n = 1; n < xs.size(); ++n) {
    if (xs[n] - xs[n - 1] <= gap) continue;
    gap = xs[n] - xs[n - 1];
    middle = 0.5 * (xs[n] + xs[n - 1]);
  }
  for (LandmarkPair& pair : landmarks) {
    pair.side = pair.rest.x() < middle ? Side::Right : Side::Left;
  }
}

std::map<Side, Box3> boxesOf(std::span<const LandmarkPair> landmarks) {
  std::map<Side, Box3> boxes;
  for (const LandmarkPair& pair : landmarks) boxes[pair.side].extend(pair.rest);
  return boxes;
}

double innerStrain(std::span<const LandmarkPair> landmarks, Side side) {
  const auto count = std::ranges::count(landmarks, side, &LandmarkPair::side);
  Eigen::MatrixX4d places(count, 4);
  Eigen::MatrixX3d moved(count, 3);
  Eigen::Index row = 0;
  for (const LandmarkPair& pair : landmarks) {
    if (pair.side != side) continue;
    places.row(row) << pair.rest.transpose(), 1.0;
    moved.row(row++) = pair.moved.transpose();
  }
  const Eigen::Matrix<double, 4, 3> affine = places.colPivHouseholderQr().solve(moved);
  return std::cbrt(affine.topRows<3>().determinant()) - 1.0;
}

LandmarkSplit drawnLandmarks(std::vector<LandmarkPair> landmarks, std::size_t fitted,
                             std::uint64_t seed) {
  Random(seed).shuffle(landmarks);
  const auto end =
      landmarks.begin() + static_cast<std::ptrdiff_t>(std::min(fitted, landmarks.size()));
  return {{landmarks.begin(), end}, {end, landmarks.end()}};
}

LandmarkSplit everyNthHeldOut(std::span<const LandmarkPair> landmarks, std::size_t every) {
  LandmarkSplit split;
  for (std::size_t n = 0; n < landmarks.size(); ++n) {
    ((n + 1) % every == 0 ? split.heldOut : split.fitted).push_back(landmarks[n]);
  }
  return split;
}

}  // namespace pneuma
