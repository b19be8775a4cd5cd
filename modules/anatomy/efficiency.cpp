#include "anatomy/efficiency.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "anatomy/branch_order.h"
#include "anatomy/centreline.h"
#include "anatomy/summary.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/units.h"

namespace pneuma {
namespace {

constexpr int SamplesPerEdge = 6;  // of a cube
constexpr double MostCubes = 1e6;
constexpr double PaperLossFactor = 4.0;  // fits the EL of every row of her tables within 15 %
constexpr double PoiseuilleFactor = 128.0 / std::numbers::pi;

/// What a cube's count of terminals is divided by.
enum class Share { None, Inside };

/// A coefficient of variation; nothing for fewer than two values, or a mean of 0.
std::optional<double> variation(const std::vector<double>& values) {
  const Summary s = summary(values);
  if (s.count < 2 || !(s.mean > 0.0)) return std::nullopt;
  return s.sd / s.mean;
}

/// All cubes of a lattice that touch the box around an organ.
class CubeLattice {
 public:
  CubeLattice(std::span<const LobeRegion> lobes, const EfficiencyCubes& cubes)
      : lobes_(lobes), cubes_(cubes) {
    Box3 box;
    for (const LobeRegion& lobe : lobes) box.extend(lobe.domain->bounds());
    first_ = inEdges(box.min()).array().floor();
    size_ = inEdges(box.max()).array().ceil() - first_.array();
  }

  bool tooMany() const { return size_.prod() > MostCubes; }

  /// C_n of terminal `ends` into `result`, with the cubes that it was taken in.
  void countInto(EfficiencyFunctions& result, const std::vector<Vec3>& ends, Share share,
                 const Progress& progress) const {
    result.cubes = cubes_;
    if (tooMany()) return;
    const std::vector<double> inside = insideShares(progress);
    std::vector<double> counts(inside.size(), 0.0);
    for (const Vec3& end : ends) {
      const Vec3 cube = inEdges(end).array().floor() - first_.array();
      if ((cube.array() < 0.0).any() || (cube.array() >= size_.array()).any()) continue;
      counts[indexOf(cube)] += 1.0;
    }
    std::vector<double> densities;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (inside[i] < cubes_.leastInside) continue;
      densities.push_back(share == Share::Inside ? counts[i] / inside[i] : counts[i]);
    }
    result.cubeCount = densities.size();
    result.cn = variation(densities);
    progress.report(1.0);
  }

 private:
  Vec3 inEdges(const Vec3& p) const { return (p - cubes_.node) / cubes_.edgeMm; }

  std::size_t indexOf(const Vec3& cube) const {
    return static_cast<std::size_t>((cube.z() * size_.y() + cube.y()) * size_.x() + cube.x());
  }

  /// How much of every cube lies in the organ, by 6 x 6 x 6 sample points.
  std::vector<double> insideShares(const Progress& progress) const {
    const auto layer = static_cast<std::size_t>(size_.x() * size_.y());
    std::vector<double> shares(layer * static_cast<std::size_t>(size_.z()));
    parallelFor(shares.size(), [&](std::size_t i) {
      progress.throwIfStopped();
      const std::size_t inLayer = i % layer;
      const auto width = static_cast<std::size_t>(size_.x());
      const Vec3 cube =
          first_ + Vec3(static_cast<double>(inLayer % width), static_cast<double>(inLayer / width),
                        static_cast<double>(i / layer));
      shares[i] = insideShare(cubes_.node + cubes_.edgeMm * cube);
    });
    return shares;
  }

  double insideShare(const Vec3& corner) const {
    constexpr std::uint32_t Row = (1U << SamplesPerEdge) - 1U;
    const double step = cubes_.edgeMm / SamplesPerEdge;
    const Box3 cube(corner, corner + Vec3::Constant(cubes_.edgeMm));
    int inside = 0;
    for (int k = 0; k < SamplesPerEdge; ++k) {
      for (int j = 0; j < SamplesPerEdge; ++j) {
        const Vec3 first = corner + step * Vec3(0.5, j + 0.5, k + 0.5);
        std::uint32_t found = 0;
        for (const LobeRegion& lobe : lobes_) {
          if (!lobe.domain->bounds().intersects(cube)) continue;
          found |= lobe.domain->insideAlongX(first, step, Row & ~found);
        }
        inside += std::popcount(found);
      }
    }
    return static_cast<double>(inside) / (SamplesPerEdge * SamplesPerEdge * SamplesPerEdge);
  }

  std::span<const LobeRegion> lobes_;
  EfficiencyCubes cubes_;
  Vec3 first_;  ///< of the cubes, in edges from the node; whole numbers, like size_
  Vec3 size_;
};

double volumeMlOf(std::span<const LobeRegion> lobes) {
  double mm3 = 0.0;
  for (const LobeRegion& lobe : lobes) mm3 += lobe.domain->volumeMm3();
  if (!(mm3 > 0.0 && std::isfinite(mm3))) {
    throw InvalidInput(
        "the efficiency of a tree is that in its lobes, but there is no lobe with a volume; give "
        "the lobes it was grown in");
  }
  return millilitres(mm3);
}

/// Q^2 L / d^4 summed over the branches, in units of the whole flow and the root's diameter.
double energyLoss(const AirwayTree& tree, const std::vector<double>& flow) {
  const double rootDiameterMm = 2.0 * tree[0].radiusMm;
  double loss = 0.0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const double width = 2.0 * tree[i].radiusMm / rootDiameterMm;
    loss += lengthMm(tree[i]) / rootDiameterMm * flow[i] * flow[i] / std::pow(width, 4);
  }
  return loss;
}

/// Of the terminals.
struct Terminals {
  std::vector<Vec3> ends;
  std::vector<double> goodFlows;
};

bool hasFailed(Ending ending) { return ending == Ending::LeftRegion || ending == Ending::Ratio; }

Terminals takeTerminals(const AirwayTree& tree, const std::vector<double>& flow,
                        Efficiency& result) {
  const Children children(tree);
  Terminals terminals;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (!children.isTerminal(i)) continue;
    terminals.ends.push_back(tree[i].distal);
    if (hasFailed(tree[i].ending)) {
      ++result.failed;
      result.qf += flow[i];
    } else if (flow[i] > 0.0) {
      terminals.goodFlows.push_back(flow[i]);
    }
  }
  result.terminals = terminals.ends.size();
  result.ca = variation(terminals.goodFlows);
  return terminals;
}

void addUp(const Efficiency& whole, EfficiencyFunctions& functions) {
  if (!functions.cn.has_value() || !whole.ca.has_value()) return;
  functions.pi = whole.qf + *functions.cn + *whole.ca + functions.vr + functions.el;
}

}  // namespace

EfficiencyCubes simpleOrganCubes() { return {}; }

EfficiencyCubes thoraxCubes() { return {.node = Vec3(15.0, 0.0, 0.0), .leastInside = 0.7}; }

Efficiency efficiency(const AirwayTree& tree, std::span<const LobeRegion> lobes,
                      const EfficiencyCubes& cubes, const Progress& progress) {
  if (tree.empty()) throw InvalidInput("a tree without branches has no efficiency");
  const double organMl = volumeMlOf(lobes);
  const std::vector<double> flow = flowFractions(tree);
  Efficiency result;
  result.branches = tree.size();
  const Terminals terminals = takeTerminals(tree, flow, result);
  double airwayMm3 = 0.0;
  for (const Branch& branch : tree) airwayMm3 += airwayVolumeMm3(branch);
  result.airwayVolumeMl = millilitres(airwayMm3);

  const auto count = static_cast<double>(result.terminals);
  const double loss = energyLoss(tree, flow) / count;
  result.paper.lungVolumeMl = PaperLungVolumeMl;
  result.paper.el = PaperLossFactor * loss;
  result.today.lungVolumeMl = organMl;
  result.today.el = PoiseuilleFactor * loss;
  const double edgeMm = std::cbrt(TerminalsPerCube * cubicMillimetres(organMl) / count);
  CubeLattice(lobes, cubes)
      .countInto(result.paper, terminals.ends, Share::None, progress.part(0.0, 0.5, "counting"));
  CubeLattice(lobes, {.edgeMm = edgeMm, .node = cubes.node, .leastInside = 0.9})
      .countInto(result.today, terminals.ends, Share::Inside, progress.part(0.5, 1.0, "counting"));
  for (EfficiencyFunctions* functions : {&result.paper, &result.today}) {
    functions->vr = result.airwayVolumeMl / functions->lungVolumeMl;
    addUp(result, *functions);
  }
  return result;
}

}  // namespace pneuma
