#include "pipeline/lung_shape.h"

#include <utility>

#include "geometry/surface_domain.h"

namespace pneuma {
namespace {

constexpr double RayGridMm =
    4.0;  ///< 50,000 points in a lung of 3 l: a lobe's volume to half a percent

}  // namespace

LungShape lungShape(std::shared_ptr<const TriangleMesh> lung, Side side) {
  LungShape shape;
  shape.side = side;
  shape.extent = extentOf(*lung);
  const SurfaceDomain domain(*lung);
  shape.volumeMm3 = domain.volumeMm3();
  const Box3& box = shape.extent.bounds;
  for (double z = box.min().z() + RayGridMm / 2.0; z < box.max().z(); z += RayGridMm) {
    for (double y = box.min().y() + RayGridMm / 2.0; y < box.max().y(); y += RayGridMm) {
      for (double x = box.min().x() + RayGridMm / 2.0; x < box.max().x(); x += RayGridMm) {
        if (domain.contains({x, y, z})) shape.inside.emplace_back(x, y, z);
      }
    }
  }
  shape.mesh = std::move(lung);
  return shape;
}

}  // namespace pneuma
