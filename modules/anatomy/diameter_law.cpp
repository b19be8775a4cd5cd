#include "anatomy/diameter_law.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "anatomy/branch_order.h"

namespace pneuma {
namespace {

constexpr std::array<double, 24> WeibelMm = {18.0, 12.2, 8.3,  5.6,  4.5,  3.5,  2.8,  2.3,
                                             1.86, 1.54, 1.30, 1.09, 0.95, 0.82, 0.74, 0.66,
                                             0.60, 0.54, 0.50, 0.47, 0.45, 0.43, 0.41, 0.41};

}  // namespace

double weibelDiameterMm(int generation) {
  return WeibelMm[static_cast<std::size_t>(std::clamp(generation, 0, 23))];
}

void assignDiameters(AirwayTree& tree, DiameterLaw law, double exponent) {
  const std::vector<int> generation = generations(tree);
  const std::vector<double> flow =
      law == DiameterLaw::Flow ? flowFractions(tree) : std::vector<double>();
  std::vector<int> inlet(tree.size(), -1);  // the last branch above that is not grown
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const Branch& branch = tree[i];
    if (branch.origin != Origin::Grown) {
      inlet[i] = static_cast<int>(i);
      continue;
    }
    if (branch.parent >= 0) inlet[i] = inlet[static_cast<std::size_t>(branch.parent)];
    double radius = weibelDiameterMm(generation[i]) / 2.0;
    if (inlet[i] >= 0) {
      const auto above = static_cast<std::size_t>(inlet[i]);
      const double ratio =
          law == DiameterLaw::Weibel
              ? weibelDiameterMm(generation[i]) / weibelDiameterMm(generation[above])
              : std::pow(flow[i] / std::max(flow[above], 1e-300), 1.0 / exponent);
      radius = tree[above].radiusMm * ratio;
    }
    if (branch.parent >= 0) {
      radius = std::min(radius, tree[static_cast<std::size_t>(branch.parent)].radiusMm);
    }
    tree.setRadiusMm(i, radius);
  }
}

}  // namespace pneuma
