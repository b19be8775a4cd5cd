#include "lobes/fissure_proposal.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "geometry/surface_domain.h"

namespace pneuma {
namespace {

constexpr double GridMm = 4.0;
constexpr double LongestMm = 1000.0;  ///< no lung is longer
constexpr double EndShare = 0.005;
constexpr double ScaleMm = 60.0;  ///< about the spread of a fissure's points

constexpr std::array<BoxQuadratic, 3> Coefficients = {{
    {0.0459, -0.0966, 0.7688, 0.0653, 0.3284, -0.1840},   // right oblique
    {0.3455, 0.3020, 0.3868, -0.2494, -0.1037, -0.3251},  // right horizontal
    {0.1916, -0.3213, 0.7579, 0.1678, -0.0649, 0.1448},   // left oblique
}};

}  // namespace

LungBox lungBox(const TriangleMesh& lung) {
  const Box3 box = bounds(lung);
  if (!(box.sizes().maxCoeff() <= LongestMm)) {
    throw InvalidInput("the lung is " + std::to_string(std::lround(box.sizes().maxCoeff())) +
                       " mm long; check its units");
  }
  const SurfaceDomain domain(lung);
  std::array<std::vector<double>, 3> along;
  for (double z = box.min().z() + GridMm / 2.0; z < box.max().z(); z += GridMm) {
    for (double y = box.min().y() + GridMm / 2.0; y < box.max().y(); y += GridMm) {
      for (double x = box.min().x() + GridMm / 2.0; x < box.max().x(); x += GridMm) {
        if (!domain.contains({x, y, z})) continue;
        along[0].push_back(x);
        along[1].push_back(y);
        along[2].push_back(z);
      }
    }
  }
  if (along[0].size() < 100) {
    throw InvalidInput("the lung's surface encloses too little for fissures; check its units (mm)");
  }
  LungBox result;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& values = along[static_cast<std::size_t>(axis)];
    std::ranges::sort(values);
    const auto last = static_cast<double>(values.size() - 1);
    result.low[axis] = values[static_cast<std::size_t>(EndShare * last)];
    result.high[axis] = values[static_cast<std::size_t>((1.0 - EndShare) * last)];
  }
  return result;
}

HeightSurface quadraticFissure(const BoxQuadratic& c, const LungBox& box) {
  const Vec3 size = box.high - box.low;
  const double x = ScaleMm / size.x();
  const double y = ScaleMm / size.y();
  HeightSurface surface;
  surface.centre = box.low;
  surface.scale = ScaleMm;
  surface.quadratic = {c[0] * size.z(),         c[1] * x * size.z(),     c[2] * y * size.z(),
                       c[3] * x * x * size.z(), c[4] * x * y * size.z(), c[5] * y * y * size.z()};
  return surface;
}

HeightSurface proposedFissure(Fissure fissure, const LungBox& box) {
  return quadraticFissure(Coefficients[static_cast<std::size_t>(fissure)], box);
}

}  // namespace pneuma
