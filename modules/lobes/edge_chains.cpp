#include "lobes/edge_chains.h"

#include <algorithm>

namespace pneuma {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Points = std::vector<std::uint32_t>;

/// Halves at the middle point of the fullest edge until there are none: no part is without area
/// unless the triangle is.
void divide(const Corners& t, const std::array<Points, 3>& upon, std::vector<Corners>& parts) {
  std::size_t e = 0;
  for (std::size_t other = 1; other < 3; ++other) {
    if (upon[other].size() > upon[e].size()) e = other;
  }
  if (upon[e].empty()) {
    parts.push_back(t);
    return;
  }
  const std::size_t next = (e + 1) % 3;
  const std::size_t last = (e + 2) % 3;
  const auto middle = upon[e].begin() + static_cast<std::ptrdiff_t>(upon[e].size() / 2);
  divide({t[e], *middle, t[last]}, {Points(upon[e].begin(), middle), {}, upon[last]}, parts);
  divide({*middle, t[next], t[last]}, {Points(middle + 1, upon[e].end()), upon[next], {}}, parts);
}

}  // namespace

void EdgeChains::add(const Corners& parent, std::span<const Corners> parts) {
  std::map<std::uint32_t, std::uint32_t> next;  // along the border
  for (const Corners& part : parts) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = part[e];
      const std::uint32_t b = part[(e + 1) % 3];
      const bool inside = std::ranges::any_of(parts, [&](const Corners& other) {
        for (std::size_t k = 0; k < 3; ++k) {
          if (other[k] == b && other[(k + 1) % 3] == a) return true;
        }
        return false;
      });
      if (!inside) next[a] = b;
    }
  }
  for (std::size_t e = 0; e < 3; ++e) {
    const std::uint32_t a = parent[e];
    const std::uint32_t b = parent[(e + 1) % 3];
    Points chain;
    for (std::uint32_t v = next.at(a); v != b; v = next.at(v)) chain.push_back(v);
    if (chain.empty()) continue;
    if (b < a) std::ranges::reverse(chain);
    chains_[{std::min(a, b), std::max(a, b)}] = std::move(chain);
  }
}

Points EdgeChains::between(std::uint32_t a, std::uint32_t b) const {
  const auto found = chains_.find({std::min(a, b), std::max(a, b)});
  if (found == chains_.end()) return {};
  Points chain = found->second;
  if (b < a) std::ranges::reverse(chain);
  return chain;
}

std::vector<Corners> dividedAlong(const EdgeChains& chains, const Corners& t) {
  std::vector<Corners> parts;
  divide(t, {chains.between(t[0], t[1]), chains.between(t[1], t[2]), chains.between(t[2], t[0])},
         parts);
  return parts;
}

}  // namespace pneuma
