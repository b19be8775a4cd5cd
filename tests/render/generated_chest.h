#pragma once

#include "core/image.h"

namespace pneuma::test {

/// A chest of ellipsoids as CT and labels on any grid: body, lungs with vessels, trachea, heart
/// (towards the patient's left), spine (at the back), liver (on the right). The same chest on
/// every grid, so that pictures of differently turned images can be compared.
struct GeneratedChest {
  CtImage ct;
  LabelImage labels;  ///< 10 right, 20 left, 6 trachea
};

inline double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii) {
  return (p - centre).cwiseQuotient(radii).squaredNorm();
}

inline bool isVessel(const Vec3& p) {
  const Vec3 cell(std::remainder(p.x(), 22.0), std::remainder(p.y() + 5.0, 19.0),
                  std::remainder(p.z(), 26.0));
  return cell.squaredNorm() < 9.0;
}

inline GeneratedChest generatedChest(const ImageGeometry& geometry) {
  GeneratedChest chest;
  chest.ct = {geometry, std::vector<std::int16_t>(geometry.voxelCount(), PaddingHu)};
  chest.labels = {geometry, std::vector<std::uint8_t>(geometry.voxelCount(), 0)};
  for (int k = 0; k < geometry.size[2]; ++k) {
    for (int j = 0; j < geometry.size[1]; ++j) {
      for (int i = 0; i < geometry.size[0]; ++i) {
        const Vec3 p = geometry.worldFromVoxel(Vec3(i, j, k));
        double hu = -1000.0;
        std::uint8_t label = 0;
        if (ellipsoid(p, {0, 0, 0}, {160, 105, 600}) < 1.0) hu = 40.0;
        const bool right = ellipsoid(p, {-72, 0, 0}, {58, 78, 120}) < 1.0;
        const bool left = ellipsoid(p, {72, 0, 0}, {55, 78, 120}) < 1.0;
        if (right || left) {
          hu = isVessel(p) ? 60.0 : -860.0;
          label = right ? 10 : 20;
        }
        if (ellipsoid(p, {24, -25, -45}, {52, 45, 48}) < 1.0 ||
            ellipsoid(p, {-60, -5, -130}, {80, 80, 60}) < 1.0) {
          hu = 70.0;
          label = 0;
        }
        if (std::hypot(p.x(), p.y() - 82.0) < 16.0) hu = 500.0;
        if (std::hypot(p.x(), p.y() + 5.0) < 9.0 && p.z() > 10.0) {
          hu = -990.0;
          label = 6;
        }
        chest.ct.at(i, j, k) = static_cast<std::int16_t>(hu);
        chest.labels.at(i, j, k) = label;
      }
    }
  }
  return chest;
}

/// 360 x 240 x 300 mm about the origin, voxels of 3 x 3 x 5 mm.
inline ImageGeometry chestGrid() {
  ImageGeometry geometry;
  geometry.size = {120, 80, 60};
  geometry.spacing = Vec3(3.0, 3.0, 5.0);
  geometry.origin = Vec3(-178.5, -118.5, -147.5);
  return geometry;
}

}  // namespace pneuma::test
