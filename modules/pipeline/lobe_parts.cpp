#include "pipeline/lobe_parts.h"

#include <algorithm>
#include <array>
#include <vector>

namespace pneuma {
namespace {

bool isLobeOrLung(std::uint8_t value) {
  const auto lobe = static_cast<Lobe>(value);
  return lobe == Lobe::Whole || lobe == Lobe::RightLung || lobe == Lobe::LeftLung ||
         std::ranges::find(FiveLobes, lobe) != FiveLobes.end();
}

}  // namespace

std::map<Lobe, TriangleMesh> lobeParts(const TriangleMesh& mesh,
                                       std::span<const std::uint8_t> lobes) {
  if (lobes.empty() || !std::ranges::all_of(lobes, isLobeOrLung)) return {};
  std::map<Lobe, std::vector<std::array<std::uint32_t, 3>>> triangles;
  for (std::size_t n = 0; n < lobes.size(); ++n) {
    triangles[static_cast<Lobe>(lobes[n])].push_back(mesh.triangles[n]);
  }
  std::map<Lobe, TriangleMesh> parts;
  for (const auto& [lobe, own] : triangles) parts.emplace(lobe, partOf(mesh, own));
  return parts;
}

}  // namespace pneuma
