#include "anatomy/validation.h"

#include <algorithm>
#include <atomic>

#include "anatomy/centreline.h"
#include "core/parallel.h"

namespace pneuma {

std::vector<std::string> problems(const AirwayTree& tree) {
  std::vector<std::string> found;
  const auto say = [&](std::size_t branch, const std::string& what) {
    if (found.size() < 20) found.push_back("branch " + std::to_string(branch) + " " + what);
  };
  std::size_t roots = 0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const Branch& branch = tree[i];
    if (!branch.proximal.allFinite() || !branch.distal.allFinite()) {
      say(i, "has coordinates that are not numbers");
      continue;
    }
    if (!(branch.radiusMm > 0.0)) say(i, "has no radius");
    if (!(lengthMm(branch) > 0.0)) say(i, "has no length");
    if (branch.parent < 0) {
      ++roots;
    } else if ((tree[static_cast<std::size_t>(branch.parent)].distal - branch.proximal).norm() >
               1e-6) {
      say(i, "does not start where its parent ends");
    }
  }
  if (roots != 1) {
    found.insert(found.begin(), "the tree has " + std::to_string(roots) + " roots instead of one");
  }
  return found;
}

Outside outsideTheirLobe(const AirwayTree& tree, std::span<const LobeRegion> lobes) {
  std::atomic<std::size_t> ends = 0;
  std::atomic<std::size_t> segments = 0;
  constexpr std::size_t Chunk = 1024;
  parallelFor((tree.size() + Chunk - 1) / Chunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * Chunk; i < std::min(tree.size(), (chunk + 1) * Chunk); ++i) {
      const Branch& branch = tree[i];
      if (branch.origin != Origin::Grown) continue;
      const auto region =
          std::ranges::find_if(lobes, [&](const LobeRegion& r) { return r.lobe == branch.lobe; });
      if (region == lobes.end()) continue;
      if (!region->domain->contains(branch.distal)) ++ends;
      bool inside = true;
      forEachPiece(branch, [&](const CentrelinePiece& piece) {
        inside = inside && region->domain->containsSegment(piece.from, piece.to);
      });
      if (!inside) ++segments;
    }
  });
  return {ends, segments};
}

}  // namespace pneuma
