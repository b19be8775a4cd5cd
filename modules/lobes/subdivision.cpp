#include "lobes/subdivision.h"

namespace pneuma {
namespace {

using Corners = std::array<std::uint32_t, 3>;

class Divider {
 public:
  Divider(const RegionComplex& complex, const EdgePoints& edgePoints)
      : points_(complex.points), edgePoints_(edgePoints) {}

  /// The parts of a triangle, turned as it is.
  const std::vector<Corners>& divided(const Corners& t) {
    parts_.clear();
    std::array<const std::uint32_t*, 3> upon{};  // edges 0-1, 1-2, 2-0
    int count = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      upon[e] = edgePoints_.find(t[e], t[(e + 1) % 3]);
      if (upon[e] != nullptr) ++count;
    }
    if (count == 0) {
      parts_.push_back(t);
    } else if (count == 3) {
      parts_ = {{t[0], *upon[0], *upon[2]},
                {t[1], *upon[1], *upon[0]},
                {t[2], *upon[2], *upon[1]},
                {*upon[0], *upon[1], *upon[2]}};
    } else if (count == 1) {
      const std::size_t e = upon[0] != nullptr ? 0 : upon[1] != nullptr ? 1 : 2;
      parts_ = {{t[e], *upon[e], t[(e + 2) % 3]}, {*upon[e], t[(e + 1) % 3], t[(e + 2) % 3]}};
    } else {
      // The corner between the two divided edges is cut off; the rest has four sides.
      const std::size_t whole = upon[0] == nullptr ? 0 : upon[1] == nullptr ? 1 : 2;
      const std::uint32_t a = t[whole];
      const std::uint32_t b = t[(whole + 1) % 3];
      const std::uint32_t corner = t[(whole + 2) % 3];
      const std::uint32_t beyondB = *upon[(whole + 1) % 3];
      const std::uint32_t beforeA = *upon[(whole + 2) % 3];
      parts_.push_back({beforeA, beyondB, corner});
      if ((points_[a] - points_[beyondB]).squaredNorm() <
          (points_[b] - points_[beforeA]).squaredNorm()) {
        parts_.push_back({a, b, beyondB});
        parts_.push_back({a, beyondB, beforeA});
      } else {
        parts_.push_back({a, b, beforeA});
        parts_.push_back({b, beyondB, beforeA});
      }
    }
    return parts_;
  }

 private:
  const std::vector<Vec3>& points_;
  const EdgePoints& edgePoints_;
  std::vector<Corners> parts_;
};

}  // namespace

void subdivide(RegionComplex& complex, const EdgePoints& edgePoints,
               std::vector<std::uint32_t>* parentOf) {
  Divider divider(complex, edgePoints);
  std::vector<Facet> facets;
  facets.reserve(complex.facets.size() + complex.facets.size() / 8);
  if (parentOf != nullptr) parentOf->clear();
  for (std::uint32_t f = 0; f < complex.facets.size(); ++f) {
    const Facet& facet = complex.facets[f];
    for (const Corners& part : divider.divided(facet.corners)) {
      facets.push_back({part, facet.behind, facet.front});
      if (parentOf != nullptr) parentOf->push_back(f);
    }
  }
  complex.facets = std::move(facets);
}

}  // namespace pneuma
