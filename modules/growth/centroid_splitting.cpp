#include "growth/centroid_splitting.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "anatomy/central_airways.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/units.h"
#include "growth/point_splitter.h"
#include "growth/seeding.h"

namespace pneuma {
namespace {

constexpr double PaperSpacingMm = 3.2298;    // 103,894 points in 3.5 l
constexpr double PointsPerTerminal = 6.4;    // with the paper's options
constexpr double TerminalTolerance = 0.004;  // of the number of terminals asked for
constexpr int MostTrials = 8;

/// Points of a lobe, divided among its inlets.
struct Share {
  std::size_t inlet = 0;
  std::vector<Vec3> points;
};

/// Every point goes to the inlet of its lobe whose end is nearest.
std::vector<Share> shares(const AirwayTree& central, const std::vector<Inlet>& inlets,
                          const SeedPoints& seeds) {
  std::vector<Share> result(inlets.size());
  std::vector<std::vector<std::size_t>> inletsOf(seeds.byRegion.size());
  for (std::size_t i = 0; i < inlets.size(); ++i) {
    result[i].inlet = i;
    inletsOf[inlets[i].region].push_back(i);
  }
  for (std::size_t region = 0; region < seeds.byRegion.size(); ++region) {
    if (inletsOf[region].size() == 1) {
      result[inletsOf[region][0]].points = seeds.byRegion[region];
      continue;
    }
    for (const Vec3& p : seeds.byRegion[region]) {
      const auto nearest = std::ranges::min_element(inletsOf[region], {}, [&](std::size_t i) {
        return (central[inlets[i].branch].distal - p).squaredNorm();
      });
      result[*nearest].points.push_back(p);
    }
  }
  return result;
}

SplitInlet inletOf(const AirwayTree& central, std::size_t branch) {
  const Branch& self = central[branch];
  SplitInlet inlet{self.distal, direction(self), Vec3::Zero()};
  if (self.parent >= 0) {
    inlet.parentDirection = direction(central[static_cast<std::size_t>(self.parent)]);
  }
  return inlet;
}

SplitRules rulesFor(const CentroidSplittingOptions& options, const SeedPoints& seeds) {
  return {.ratio = options.ratio,
          .minPoints = options.minPoints,
          .minLengthMm = options.minLengthMm * seeds.spacingMm / PaperSpacingMm,
          .minAngleRad = radians(options.minAngleDeg),
          .maxAngleRad = radians(options.maxAngleDeg),
          .containment = options.containment,
          .spacingMm = seeds.spacingMm,
          .anchor = seeds.anchor};
}

/// One growth from seeds to the trees of all inlets.
struct Trial {
  SeedPoints seeds;
  SplitRules rules;
  std::vector<SplitTree> trees;
  std::size_t terminals = 0;
};

std::size_t terminalsOf(const SplitTree& tree) {
  std::vector<char> hasChild(tree.branches.size(), 0);
  bool inletHasChild = false;
  for (const SplitBranch& branch : tree.branches) {
    if (branch.parent < 0) {
      inletHasChild = true;
    } else {
      hasChild[static_cast<std::size_t>(branch.parent)] = 1;
    }
  }
  return static_cast<std::size_t>(std::ranges::count(hasChild, 0)) + (inletHasChild ? 0U : 1U);
}

class Grower {
 public:
  Grower(const AirwayTree& central, std::span<const LobeRegion> lobes,
         const CentroidSplittingOptions& options, const Progress& progress)
      : central_(central), lobes_(lobes), options_(options), progress_(progress) {
    inlets_ = assignLobes(central_, lobes_);
  }

  GrowthResult run() {
    Trial trial = options_.terminals > 0 ? aimAtTerminals() : tryOnce(firstSeeds(), progress_);
    return assembled(trial);
  }

 private:
  SeedPoints firstSeeds() const {
    const Progress seeding = progress_.part(0.0, 0.3, "placing points");
    SeedPoints seeds =
        options_.points > 0
            ? seedExactly(lobes_, options_.points, options_.jitter, options_.seed, seeding)
            : seedLattice(lobes_, options_.spacingMm, options_.jitter, options_.seed, seeding);
    seeding.report(1.0);
    return seeds;
  }

  Trial tryOnce(SeedPoints seeds, const Progress& progress) const {
    const Progress growing = progress.part(0.3, 0.9, "growing branches");
    Trial trial;
    trial.rules = rulesFor(options_, seeds);
    const std::vector<Share> work = shares(central_, inlets_, seeds);
    trial.trees.resize(inlets_.size());
    parallelFor(work.size(), [&](std::size_t i) {
      const Inlet& inlet = inlets_[i];
      trial.trees[i] = splitPoints(inletOf(central_, inlet.branch), work[i].points,
                                   *lobes_[inlet.region].domain, trial.rules, growing);
    });
    growing.report(1.0);
    for (const SplitTree& tree : trial.trees) trial.terminals += terminalsOf(tree);
    trial.seeds = std::move(seeds);
    return trial;
  }

  /// Searches the spacing that gives the wanted number of terminals.
  Trial aimAtTerminals() const {
    const auto wanted = static_cast<double>(options_.terminals);
    double volume = 0.0;
    for (const LobeRegion& region : lobes_) volume += region.domain->volumeMm3();
    double spacing = std::cbrt(volume / (wanted * PointsPerTerminal));
    Trial best;
    double bestError = 0.0;
    for (int step = 0; step < MostTrials; ++step) {
      const Progress part = progress_.part(0.9 * step / MostTrials, 0.9 * (step + 1) / MostTrials,
                                           "growing branches");
      Trial trial =
          tryOnce(seedLattice(lobes_, spacing, options_.jitter, options_.seed, part), part);
      const double terminals = std::max(static_cast<double>(trial.terminals), 1.0);
      const double error = std::abs(terminals / wanted - 1.0);
      if (step == 0 || error < bestError) {
        best = std::move(trial);
        bestError = error;
      }
      if (bestError <= TerminalTolerance) break;
      spacing *= std::cbrt(terminals / wanted);
    }
    return best;
  }

  GrowthResult assembled(const Trial& trial) {
    const Progress last = progress_.part(0.9, 1.0, "putting the tree together");
    std::size_t branches = central_.size();
    for (const SplitTree& tree : trial.trees) branches += tree.branches.size();
    GrowthResult result;
    result.tree = std::move(central_);
    result.tree.reserve(branches);
    SplitCounts counts;
    for (std::size_t i = 0; i < inlets_.size(); ++i) {
      const Inlet& inlet = inlets_[i];
      const SplitTree& grown = trial.trees[i];
      const LobeRegion& region = lobes_[inlet.region];
      const double mlPerPoint = millilitres(region.domain->volumeMm3()) /
                                static_cast<double>(trial.seeds.byRegion[inlet.region].size());
      result.tree.setSuppliedMl(inlet.branch, grown.inletPoints * mlPerPoint);
      const auto first = static_cast<int>(result.tree.size());
      for (const SplitBranch& branch : grown.branches) {
        Branch added;
        added.parent = branch.parent < 0 ? static_cast<int>(inlet.branch) : first + branch.parent;
        added.proximal = result.tree[static_cast<std::size_t>(added.parent)].distal;
        added.distal = branch.end;
        added.lobe = region.lobe;
        added.segment = result.tree[inlet.branch].segment;
        added.suppliedMl = branch.points * mlPerPoint;
        result.tree.add(std::move(added));
      }
      counts.dropped += grown.counts.dropped;
      counts.droppedPoints += grown.counts.droppedPoints;
      counts.shortened += grown.counts.shortened;
      counts.redirected += grown.counts.redirected;
    }
    assignDiameters(result.tree, options_.diameterLaw, options_.diameterExponent);
    describe(trial, counts, result);
    last.report(1.0);
    return result;
  }

  void describe(const Trial& trial, const SplitCounts& counts, GrowthResult& result) const {
    const auto points = static_cast<double>(trial.seeds.count());
    result.endsContained = options_.containment != Containment::None;
    result.branchesContained = options_.containment == Containment::Branches;
    result.figures = {
        {"points", points},
        {"spacing_mm", trial.seeds.spacingMm},
        {"min_length_mm", trial.rules.minLengthMm},
        {"inlets", static_cast<double>(inlets_.size())},
        {"daughters_not_made", static_cast<double>(counts.dropped)},
        {"points_booked_to_mothers", static_cast<double>(counts.droppedPoints)},
        {"branches_shortened", static_cast<double>(counts.shortened)},
        {"branches_redirected", static_cast<double>(counts.redirected)},
    };
    if (options_.terminals > 0) {
      const auto wanted = static_cast<double>(options_.terminals);
      if (std::abs(static_cast<double>(trial.terminals) / wanted - 1.0) > 0.03) {
        result.warnings.push_back("asked for " + std::to_string(options_.terminals) +
                                  " terminals, grown " + std::to_string(trial.terminals) +
                                  ": with these lobes and options no spacing comes closer");
      }
    }
  }

  AirwayTree central_;
  std::span<const LobeRegion> lobes_;
  const CentroidSplittingOptions& options_;
  const Progress& progress_;
  std::vector<Inlet> inlets_;
};

}  // namespace

GrowthResult growByCentroidSplitting(const AirwayTree& central, std::span<const LobeRegion> lobes,
                                     const CentroidSplittingOptions& options,
                                     const Progress& progress) {
  requireValid(options);
  if (options.minAngleDeg > options.maxAngleDeg) {
    throw InvalidOption("min-angle (" + textOf(options.minAngleDeg) +
                        " deg) must not be larger than max-angle (" + textOf(options.maxAngleDeg) +
                        " deg)");
  }
  return Grower(central, lobes, options, progress).run();
}

}  // namespace pneuma
