#include "pipeline/fissure_coverage.h"

#include "lobes/contact_sampling.h"
#include "lobes/point_coverage.h"
#include "pipeline/figure_table.h"

namespace pneuma {
namespace {

constexpr double LeastCoverage = 0.5;

}  // namespace

void addCoverage(UsedFissures& used, const SplitLung& lung, const GivenFissures& given,
                 std::vector<std::string>& warnings) {
  for (const Fissure fissure : fissuresOf(lung.side)) {
    const auto found = given.find(fissure);
    if (found == given.end() || found->second.points.empty()) continue;
    double covered = 0.0;
    double whole = 0.0;
    for (const auto& [below, above] : lobesBeside(fissure)) {
      const TriangleMesh contact =
          contactOf(lung.complex, static_cast<RegionId>(below), static_cast<RegionId>(above));
      if (contact.triangles.empty()) continue;
      const double area = areaMm2(contact);
      covered += area * pointCoverage(found->second.points, used.at(fissure).surface, contact);
      whole += area;
    }
    const double share = covered / whole;
    used.at(fissure).coverage = share;
    if (share >= LeastCoverage) continue;
    warnings.push_back("the points of the " + std::string(longName(fissure)) + " enclose " +
                       fixed(100.0 * share, 0) +
                       " % of it; the rest is a guess: set points there too");
  }
}

}  // namespace pneuma
