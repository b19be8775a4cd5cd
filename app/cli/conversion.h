#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/triangle_mesh.h"

namespace pneuma::cli {

enum class Frame { Lps, Ras };

constexpr std::array<std::string_view, 2> choices(Frame) { return {"lps", "ras"}; }

enum class LengthUnit { Mm, Cm, M };

constexpr std::array<std::string_view, 3> choices(LengthUnit) { return {"mm", "cm", "m"}; }

constexpr double millimetresIn(LengthUnit unit) {
  return unit == LengthUnit::M ? 1000.0 : unit == LengthUnit::Cm ? 10.0 : 1.0;
}

/// All lengths times `factor`; volumes times its cube.
TriangleMesh scaled(TriangleMesh mesh, double factor);
AirwayTree scaled(const AirwayTree& tree, double factor);

/// LPS to RAS or back: half a turn about the z axis.
TriangleMesh turnedToOtherFrame(TriangleMesh mesh);

/// The branches of these lobes and every branch on the way to them.
/// @throws InvalidInput if the tree has none of them
AirwayTree onlyLobes(const AirwayTree& tree, const std::vector<Lobe>& lobes);

}  // namespace pneuma::cli
