#include "pipeline/lobe_parts.h"

#include <algorithm>
#include <array>
#include <limits>
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
  constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();
  std::map<Lobe, TriangleMesh> parts;
  std::map<Lobe, std::vector<std::uint32_t>> placeIn;  // of the mesh's points, in each part
  for (std::size_t n = 0; n < lobes.size(); ++n) {
    const auto lobe = static_cast<Lobe>(lobes[n]);
    TriangleMesh& part = parts[lobe];
    std::vector<std::uint32_t>& places = placeIn[lobe];
    if (places.empty()) places.assign(mesh.points.size(), None);
    std::array<std::uint32_t, 3> triangle = mesh.triangles[n];
    for (std::uint32_t& corner : triangle) {
      if (places[corner] == None) {
        places[corner] = static_cast<std::uint32_t>(part.points.size());
        part.points.push_back(mesh.points[corner]);
      }
      corner = places[corner];
    }
    part.triangles.push_back(triangle);
  }
  return parts;
}

}  // namespace pneuma
