#include "growth/kitaoka.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <string>

#include "anatomy/central_airways.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/units.h"
#include "growth/inlet_regions.h"

namespace pneuma {
namespace {

/// Subtrees that grow in parallel: the same ones for any number of threads.
constexpr std::size_t Tasks = 64;

constexpr double TerminalTolerance = 0.004;  // of the number of terminals asked for
constexpr int MostTrials = 8;

/// The lung of the paper, by which trunks are scaled.
constexpr double PaperVolumeMl = 6388.0;
constexpr double PaperTrunkMm = 18.0;

/// While it grows and is put together, a branch is held this often in its two forms.
constexpr double BytesPerBranch = 3.0 * (sizeof(Branch) + sizeof(RegionBranch));

std::string rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

void requireMemoryFor(const KitaokaOptions& options) {
  const double terminals = options.terminals > 0 ? static_cast<double>(options.terminals)
                                                 : TerminalsTimesThreshold / options.flowThreshold;
  const double branches = 2.0 * terminals;
  const auto available = static_cast<double>(availableMemoryBytes());
  if (available <= 0.0 || branches * BytesPerBranch <= available) return;
  const double possible = available / BytesPerBranch / 2.0;
  throw Error(ExitCode::OutOfMemory,
              (options.terminals > 0 ? std::to_string(options.terminals) + " terminals"
                                     : "a flow-threshold of " + textOf(options.flowThreshold)) +
                  " would make about " + rounded(branches / 1e6) +
                  " million branches, which take " + rounded(branches * BytesPerBranch / 1e9) +
                  " GB of memory; " + rounded(available / 1e9) +
                  " GB are free: choose a flow-threshold of " +
                  rounded(TerminalsTimesThreshold / possible) + " or more, or fewer terminals");
}

void requirePossible(const KitaokaOptions& options) {
  requireValid(options);
  if (options.minDistanceToLength > options.maxDistanceToLength) {
    throw InvalidOption("min-distance-to-length (" + textOf(options.minDistanceToLength) +
                        ") must not be larger than max-distance-to-length (" +
                        textOf(options.maxDistanceToLength) + ")");
  }
  if (options.reach > 0.0 && options.reach < 1.0) {
    throw InvalidOption("reach must be 0 (never) or lie in [1, 10], but is " +
                        textOf(options.reach) +
                        ": hardly any region reaches less far, and division would not end");
  }
  requireMemoryFor(options);
}

/// Progress by the flow that has found its end; rises whatever the order of the threads.
class FlowProgress {
 public:
  explicit FlowProgress(const Progress& progress) : progress_(progress) {}

  void ended(double flow) {
    const std::lock_guard lock(mutex_);
    flow_ += flow;
    progress_.report(std::min(flow_, 1.0));
  }

  void throwIfStopped() const { progress_.throwIfStopped(); }

 private:
  const Progress& progress_;
  std::mutex mutex_;
  double flow_ = 0.0;
};

/// What grows from one sprout.
struct Subtree {
  std::size_t inlet = 0;
  int above = -1;  ///< the branch of `stems` from which it grows; -1: the inlet
  std::vector<RegionBranch> branches;
};

/// One growth from inlets to terminals.
struct Forest {
  std::vector<Sprout> inlets;
  std::vector<Ending> inletEndings;
  std::vector<RegionBranch> stems;  ///< grown first, one after the other
  std::vector<std::size_t> stemInlets;
  std::vector<Subtree> subtrees;
  RegionCounts counts;
  double flowThreshold = 0.0;
  std::size_t terminals = 0;
};

class Grower {
 public:
  Grower(const AirwayTree& central, std::span<const LobeRegion> lobes,
         const KitaokaOptions& options, const Progress& progress)
      : central_(central), lobes_(lobes), options_(options), progress_(progress) {
    inlets_ = assignLobes(central_, lobes_);
    for (const LobeRegion& lobe : lobes_) volumeMl_ += millilitres(lobe.domain->volumeMm3());
    const Branch& root = central_[0];
    trunkDiameterMm_ = options.trunkDiameterMm > 0.0 ? options.trunkDiameterMm
                       : root.origin == Origin::Template
                           ? 2.0 * root.radiusMm
                           : PaperTrunkMm * std::cbrt(volumeMl_ / PaperVolumeMl);
  }

  GrowthResult run() {
    Forest forest = options_.terminals > 0 ? aimAtTerminals()
                                           : grown(options_.flowThreshold,
                                                   progress_.part(0.0, 0.9, "growing branches"));
    return assembled(forest);
  }

 private:
  /// Searches the flow threshold that gives the wanted number of terminals.
  Forest aimAtTerminals() const {
    const auto wanted = static_cast<double>(options_.terminals);
    // What divides for its reach adds up to half as many again.
    const double expected = TerminalsTimesThreshold * (options_.reach > 0.0 ? 1.5 : 1.0);
    double threshold = std::min(0.5, expected / wanted);
    // Terminals go with a power of the threshold, about -1; two trials tell it better.
    double power = -1.0;
    double lastThreshold = 0.0;
    double lastTerminals = 0.0;
    Forest best;
    double bestError = 0.0;
    for (int trial = 0; trial < MostTrials; ++trial) {
      Forest forest =
          grown(threshold, progress_.part(0.9 * trial / MostTrials, 0.9 * (trial + 1) / MostTrials,
                                          "growing branches"));
      const auto terminals = static_cast<double>(std::max<std::size_t>(forest.terminals, 1));
      const double error = std::abs(terminals / wanted - 1.0);
      if (trial == 0 || error < bestError) {
        best = std::move(forest);
        bestError = error;
      }
      if (bestError <= TerminalTolerance) break;
      if (trial > 0 && threshold != lastThreshold && terminals != lastTerminals) {
        power = std::clamp(
            std::log(terminals / lastTerminals) / std::log(threshold / lastThreshold), -2.0, -0.3);
      }
      lastThreshold = threshold;
      lastTerminals = terminals;
      threshold = std::min(0.5, threshold * steady(std::pow(wanted / terminals, 1.0 / power)));
    }
    return best;
  }

  Forest grown(double threshold, const Progress& progress) const {
    KitaokaOptions options = options_;
    options.flowThreshold = threshold;
    FlowProgress flow(progress);
    Forest forest;
    forest.flowThreshold = threshold;
    forest.inlets = inletSprouts(central_, inlets_, lobes_, options);
    forest.inletEndings.assign(forest.inlets.size(), Ending::None);
    growSubtrees(growStems(forest, options), forest, options, flow);
    forest.terminals = terminalsOf(forest);
    progress.report(1.0);
    return forest;
  }

  /// Grows the branches with the largest flow until there are enough tasks for all threads.
  std::vector<std::pair<std::size_t, Sprout>> growStems(Forest& forest,
                                                        const KitaokaOptions& options) const {
    const auto lessFlow = [](const auto& a, const auto& b) {
      return a.second.stem.flow < b.second.stem.flow;
    };
    std::vector<std::pair<std::size_t, Sprout>> waiting;
    for (std::size_t i = 0; i < forest.inlets.size(); ++i) {
      if (forest.inlets[i].stem.flow < options.flowThreshold) {
        forest.inletEndings[i] = Ending::Flow;
      } else {
        waiting.emplace_back(i, forest.inlets[i]);
      }
    }
    RegionGrower grower(options, trunkDiameterMm_, cubicMillimetres(volumeMl_));
    while (!waiting.empty() && waiting.size() < Tasks) {
      progress_.throwIfStopped();
      const auto largest = std::ranges::max_element(waiting, lessFlow);
      auto [inlet, sprout] = std::move(*largest);
      waiting.erase(largest);
      std::vector<Sprout> daughters;
      const Ending ending = grower.grow(sprout, forest.stems, daughters);
      forest.stemInlets.resize(forest.stems.size(), inlet);
      if (ending != Ending::None) {
        (sprout.branch < 0 ? forest.inletEndings[inlet]
                           : forest.stems[static_cast<std::size_t>(sprout.branch)].ending) = ending;
      }
      for (Sprout& daughter : daughters) waiting.emplace_back(inlet, std::move(daughter));
    }
    forest.counts.add(grower.counts());
    return waiting;
  }

  void growSubtrees(std::vector<std::pair<std::size_t, Sprout>> waiting, Forest& forest,
                    const KitaokaOptions& options, FlowProgress& flow) const {
    forest.subtrees.resize(waiting.size());
    std::vector<RegionCounts> counts(waiting.size());
    std::vector<Ending> rootEndings(waiting.size(), Ending::None);
    parallelFor(waiting.size(), [&](std::size_t task) {
      RegionGrower grower(options, trunkDiameterMm_, cubicMillimetres(volumeMl_));
      Subtree& subtree = forest.subtrees[task];
      auto& [inlet, root] = waiting[task];
      subtree.inlet = inlet;
      subtree.above = root.branch;
      root.branch = -1;
      const double share = root.stem.flow;
      std::vector<Sprout> sprouts;
      sprouts.push_back(std::move(root));
      while (!sprouts.empty()) {
        flow.throwIfStopped();
        Sprout sprout = std::move(sprouts.back());
        sprouts.pop_back();
        const Ending ending = grower.grow(sprout, subtree.branches, sprouts);
        if (ending == Ending::None) continue;
        (sprout.branch < 0 ? rootEndings[task]
                           : subtree.branches[static_cast<std::size_t>(sprout.branch)].ending) =
            ending;
      }
      counts[task] = grower.counts();
      flow.ended(share);
    });
    for (std::size_t task = 0; task < waiting.size(); ++task) {
      forest.counts.add(counts[task]);
      if (rootEndings[task] == Ending::None) continue;
      const Subtree& subtree = forest.subtrees[task];
      (subtree.above < 0 ? forest.inletEndings[subtree.inlet]
                         : forest.stems[static_cast<std::size_t>(subtree.above)].ending) =
          rootEndings[task];
    }
  }

  /// Every terminal has an ending, and nothing else.
  static std::size_t terminalsOf(const Forest& forest) {
    const auto ends = [](const RegionBranch& branch) { return branch.ending != Ending::None; };
    auto count = std::ranges::count_if(forest.inletEndings,
                                       [](Ending ending) { return ending != Ending::None; }) +
                 std::ranges::count_if(forest.stems, ends);
    for (const Subtree& subtree : forest.subtrees) {
      count += std::ranges::count_if(subtree.branches, ends);
    }
    return static_cast<std::size_t>(count);
  }

  GrowthResult assembled(const Forest& forest) {
    const Progress last = progress_.part(0.9, 1.0, "putting the tree together");
    GrowthResult result;
    result.tree = std::move(central_);
    std::size_t branches = result.tree.size() + forest.stems.size();
    for (const Subtree& subtree : forest.subtrees) branches += subtree.branches.size();
    result.tree.reserve(branches);
    for (std::size_t i = 0; i < inlets_.size(); ++i) {
      if (forest.inletEndings[i] == Ending::None) continue;
      result.tree.setEnding(inlets_[i].branch, forest.inletEndings[i]);
      result.tree.setSuppliedMl(inlets_[i].branch, forest.inlets[i].stem.flow * volumeMl_);
    }
    const auto firstStem = static_cast<int>(result.tree.size());
    for (std::size_t i = 0; i < forest.stems.size(); ++i) {
      const RegionBranch& stem = forest.stems[i];
      const std::size_t inlet = forest.stemInlets[i];
      const auto above = static_cast<int>(inlets_[inlet].branch);
      add(result.tree, stem, stem.parent < 0 ? above : firstStem + stem.parent, inlet);
    }
    for (const Subtree& subtree : forest.subtrees) {
      const int above = subtree.above < 0 ? static_cast<int>(inlets_[subtree.inlet].branch)
                                          : firstStem + subtree.above;
      const auto first = static_cast<int>(result.tree.size());
      for (const RegionBranch& branch : subtree.branches) {
        add(result.tree, branch, branch.parent < 0 ? above : first + branch.parent, subtree.inlet);
      }
      last.throwIfStopped();
    }
    supplyWholeLobes(result.tree);
    describe(forest, result);
    last.report(1.0);
    return result;
  }

  /// What the terminals of a lobe supply adds up to the lobe: regions measured anew add up to it
  /// within a few per cent only.
  void supplyWholeLobes(AirwayTree& tree) const {
    for (const LobeRegion& lobe : lobes_) {
      double supplied = 0.0;
      for (const Branch& branch : tree)
        supplied += branch.lobe == lobe.lobe ? branch.suppliedMl : 0;
      if (supplied <= 0.0) continue;
      const double factor = millilitres(lobe.domain->volumeMm3()) / supplied;
      for (std::size_t i = 0; i < tree.size(); ++i) {
        if (tree[i].lobe == lobe.lobe) tree.setSuppliedMl(i, factor * tree[i].suppliedMl);
      }
    }
  }

  void add(AirwayTree& tree, const RegionBranch& grown, int parent, std::size_t inlet) const {
    const Branch& above = tree[static_cast<std::size_t>(parent)];
    Branch branch;
    branch.parent = parent;
    branch.proximal = above.distal;
    branch.distal = grown.tip;
    // Measured airways may be thinner than their flow asks for; nothing widens below them.
    branch.radiusMm = std::min(grown.diameterMm / 2.0, above.radiusMm);
    branch.lobe = lobes_[inlets_[inlet].region].lobe;
    branch.segment = above.segment;
    branch.ending = grown.ending;
    if (grown.ending != Ending::None) branch.suppliedMl = grown.flow * volumeMl_;
    tree.add(std::move(branch));
  }

  void describe(const Forest& forest, GrowthResult& result) const {
    const RegionCounts& counts = forest.counts;
    const auto bare = std::ranges::count_if(
        forest.inlets, [](const Sprout& inlet) { return inlet.stem.flow <= 0.0; });
    result.endsContained = options_.containment != Containment::None;
    result.branchesContained = options_.containment == Containment::Branches;
    const auto number = [](auto value) { return static_cast<double>(value); };
    result.figures = {
        {"flow_threshold", forest.flowThreshold},
        {"trunk_diameter_mm", trunkDiameterMm_},
        {"inlets", number(inlets_.size())},
        {"inlets_without_region", number(bare)},
        {"failed_left_region", number(counts.failedLeft)},
        {"failed_ratio", number(counts.failedRatio)},
        {"rotation_mean_deg", counts.rotationDeg.mean()},
        {"rotation_sd_deg", counts.rotationDeg.deviation()},
        {"length_to_diameter_mean", counts.lengthToDiameter.mean()},
        {"length_to_diameter_sd", counts.lengthToDiameter.deviation()},
        {"planes_turned", number(counts.turned)},
        {"angles_corrected", number(counts.corrected)},
        {"angles_corrected_below_18_deg", number(counts.correctedBelow18)},
        {"angles_corrected_dividing", number(counts.correctedDividing)},
        {"angles_corrected_dividing_below_18_deg", number(counts.correctedDividingBelow18)},
        {"rescued_shortened", number(counts.rescuedShortened)},
        {"rescued_turned", number(counts.rescuedTurned)},
        {"rescued_reentered", number(counts.rescuedReentered)},
        {"rescued_led_round", number(counts.rescuedLedRound)},
        {"rescued_divisions", number(counts.rescuedDivisions)},
        {"divided_for_reach", number(counts.dividedForReach)},
        {"divided_for_shape", number(counts.halvedForShape)},
        {"kept_inside", number(counts.keptInside)},
    };
    if (bare > 0) {
      result.warnings.push_back(std::to_string(bare) + " of " + std::to_string(inlets_.size()) +
                                " inlets got no part of their lobe and stay as they are");
    }
    if (options_.terminals == 0) return;
    const auto wanted = static_cast<double>(options_.terminals);
    if (std::abs(number(forest.terminals) / wanted - 1.0) > 0.03) {
      result.warnings.push_back("asked for " + std::to_string(options_.terminals) +
                                " terminals, grown " + std::to_string(forest.terminals) +
                                ": with these lobes and options no flow threshold comes closer");
    }
  }

  AirwayTree central_;
  std::span<const LobeRegion> lobes_;
  const KitaokaOptions& options_;
  const Progress& progress_;
  std::vector<Inlet> inlets_;
  double volumeMl_ = 0.0;
  double trunkDiameterMm_ = 0.0;
};

}  // namespace

KitaokaOptions kitaokaPaper() {
  KitaokaOptions options;
  options.inletRegions = InletRegions::Division;
  options.remeasure = Switch::Off;
  options.rescue = Switch::Off;
  options.symmetry = 0.0;
  options.terminalEnds = TerminalEnds::Rule;
  options.reach = 0.0;
  options.containment = Containment::None;
  return options;
}

GrowthResult growByKitaoka(const AirwayTree& central, std::span<const LobeRegion> lobes,
                           const KitaokaOptions& options, const Progress& progress) {
  requirePossible(options);
  return Grower(central, lobes, options, progress).run();
}

}  // namespace pneuma
