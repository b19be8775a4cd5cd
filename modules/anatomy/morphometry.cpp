#include "anatomy/morphometry.h"

#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "anatomy/branch_order.h"
#include "anatomy/branching_angles.h"
#include "anatomy/centreline.h"
#include "anatomy/crossings.h"
#include "core/error.h"
#include "core/units.h"

namespace pneuma {
namespace {

struct DiameterClass {
  const char* name;
  double aboveMm;  ///< lower limit of the mother's diameter, exclusive; classes from wide to narrow
};

constexpr std::array<DiameterClass, 6> DiameterClasses = {{{">4 mm", 4.0},
                                                           {"4-3 mm", 3.0},
                                                           {"3-2 mm", 2.0},
                                                           {"2-1 mm", 1.0},
                                                           {"1-0.7 mm", 0.7},
                                                           {"<0.7 mm", 0.0}}};

void requireMeasurable(const AirwayTree& tree) {
  if (tree.empty()) throw InvalidInput("the tree has no branches to measure; grow or open one");
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const Branch& branch = tree[i];
    const double sum = lengthMm(branch) + branch.distal.sum() + branch.proximal.sum();
    if (!std::isfinite(sum) || !std::isfinite(branch.radiusMm) || branch.radiusMm < 0.0) {
      throw InvalidInput("branch " + std::to_string(i) +
                         " has coordinates or a radius that are no numbers, or a negative radius; "
                         "mend the tree before measuring it");
    }
  }
}

/// Length along the airways from the root's proximal end to every branch's distal end.
std::vector<double> pathLengthsMm(const AirwayTree& tree) {
  std::vector<double> path(tree.size(), 0.0);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const int parent = tree[i].parent;
    path[i] = lengthMm(tree[i]) + (parent < 0 ? 0.0 : path[static_cast<std::size_t>(parent)]);
  }
  return path;
}

/// Branches of `tree` that lie in `lobe`, or all.
std::vector<std::size_t> branchesOf(const AirwayTree& tree, std::optional<Lobe> lobe) {
  std::vector<std::size_t> ids;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (!lobe.has_value() || tree[i].lobe == *lobe) ids.push_back(i);
  }
  return ids;
}

/// A tree with everything prepared that does not depend on which part of it is asked for.
class MeasuredTree {
 public:
  MeasuredTree(const AirwayTree& tree, const Progress& progress)
      : tree_(tree),
        joined_(contractChains(tree)),
        children_(tree),
        joinedChildren_(joined_),
        generation_(generations(tree)),
        horsfield_(horsfieldOrders(joined_)),
        strahler_(strahlerOrders(joined_)),
        pathMm_(pathLengthsMm(tree)),
        angles_(branchingAngles(tree)),
        rotations_(rotationAngles(tree)) {
    progress.report(0.3);
    crossings_ = crossings(tree, progress.part(0.3, 1.0, "looking for crossings"));
  }

  /// Everything but the gap, of the branches in `lobe` or of all.
  Morphometry of(std::optional<Lobe> lobe) const;

  std::vector<Vec3> terminalEnds(std::optional<Lobe> lobe) const;

 private:
  void measureTerminals(std::span<const std::size_t> branches, Morphometry& result) const;
  void measureAngles(std::optional<Lobe> lobe, Morphometry& result) const;
  void measureProportions(std::span<const std::size_t> joinedBranches, Morphometry& result) const;

  const AirwayTree& tree_;
  AirwayTree joined_;  ///< one-daughter steps joined: from bifurcation to bifurcation
  Children children_;
  Children joinedChildren_;
  std::vector<int> generation_;
  std::vector<int> horsfield_;  ///< of joined_
  std::vector<int> strahler_;   ///< of joined_
  std::vector<double> pathMm_;
  std::vector<BranchingAngle> angles_;
  std::vector<RotationAngle> rotations_;
  std::vector<std::pair<std::size_t, std::size_t>> crossings_;
};

std::vector<Vec3> MeasuredTree::terminalEnds(std::optional<Lobe> lobe) const {
  std::vector<Vec3> ends;
  for (const std::size_t i : branchesOf(tree_, lobe)) {
    if (children_.isTerminal(i)) ends.push_back(tree_[i].distal);
  }
  return ends;
}

void MeasuredTree::measureTerminals(std::span<const std::size_t> branches,
                                    Morphometry& result) const {
  std::vector<double> generation;
  std::vector<double> length;
  std::vector<double> path;
  for (const std::size_t i : branches) {
    if (!children_.isTerminal(i)) continue;
    generation.push_back(generation_[i]);
    length.push_back(lengthMm(tree_[i]));
    path.push_back(pathMm_[i]);
  }
  result.terminals = generation.size();
  result.terminalGeneration = summary(generation);
  result.terminalLengthMm = summary(length);
  result.pathLengthMm = summary(path);
}

void MeasuredTree::measureAngles(std::optional<Lobe> lobe, Morphometry& result) const {
  std::vector<double> all;
  std::vector<double> major;
  std::vector<double> minor;
  std::array<std::vector<double>, DiameterClasses.size()> byClass;
  for (const BranchingAngle& angle : angles_) {
    const Branch& daughter = tree_[angle.daughter];
    if (lobe.has_value() && daughter.lobe != *lobe) continue;
    const double deg = degrees(angle.radians);
    all.push_back(deg);
    (angle.major ? major : minor).push_back(deg);
    const double motherMm = 2.0 * tree_[static_cast<std::size_t>(daughter.parent)].radiusMm;
    std::size_t k = 0;
    while (k + 1 < DiameterClasses.size() && motherMm <= DiameterClasses[k].aboveMm) ++k;
    byClass[k].push_back(deg);
  }
  result.branchingAngleDeg = summary(all);
  result.branchingAngleMajorDeg = summary(major);
  result.branchingAngleMinorDeg = summary(minor);
  for (std::size_t k = 0; k < DiameterClasses.size(); ++k) {
    result.branchingAngleByParentDiameterDeg.emplace_back(DiameterClasses[k].name,
                                                          summary(byClass[k]));
  }
  std::vector<double> rotation;
  for (const RotationAngle& angle : rotations_) {
    if (lobe.has_value() && tree_[angle.mother].lobe != *lobe) continue;
    rotation.push_back(degrees(angle.radians));
  }
  result.rotationAngleDeg = summary(rotation);
}

void MeasuredTree::measureProportions(std::span<const std::size_t> joinedBranches,
                                      Morphometry& result) const {
  std::vector<double> lengthToDiameter;
  std::vector<double> lengthToParent;
  std::vector<double> diameterToParent;
  std::vector<double> minorToMajor;
  std::size_t shorter = 0;
  for (const std::size_t i : joinedBranches) {
    const Branch& branch = joined_[i];
    const double length = lengthMm(branch);
    if (branch.radiusMm > 0.0) lengthToDiameter.push_back(length / (2.0 * branch.radiusMm));
    if (branch.parent >= 0) {
      const Branch& parent = joined_[static_cast<std::size_t>(branch.parent)];
      const double parentLength = lengthMm(parent);
      if (parentLength > 0.0) lengthToParent.push_back(length / parentLength);
      if (parentLength > 0.0 && length < parentLength) ++shorter;
      if (parent.radiusMm > 0.0) diameterToParent.push_back(branch.radiusMm / parent.radiusMm);
    }
    double narrowest = std::numeric_limits<double>::infinity();
    double widest = 0.0;
    for (const int id : joinedChildren_.of(i)) {
      const double radius = joined_[static_cast<std::size_t>(id)].radiusMm;
      narrowest = std::min(narrowest, radius);
      widest = std::max(widest, radius);
    }
    if (widest > 0.0) minorToMajor.push_back(narrowest / widest);
  }
  result.lengthToDiameter = summary(lengthToDiameter);
  result.lengthToParent = summary(lengthToParent);
  if (!lengthToParent.empty()) {
    result.lengthToParentBelowOne =
        static_cast<double>(shorter) / static_cast<double>(lengthToParent.size());
  }
  result.diameterToParent = summary(diameterToParent);
  result.diameterMinorToMajor = summary(minorToMajor);
}

Morphometry MeasuredTree::of(std::optional<Lobe> lobe) const {
  const std::vector<std::size_t> branches = branchesOf(tree_, lobe);
  const std::vector<std::size_t> joinedBranches = branchesOf(joined_, lobe);
  Morphometry result;
  result.branches = branches.size();
  result.branchesContracted = joinedBranches.size();
  measureTerminals(branches, result);
  measureAngles(lobe, result);
  measureProportions(joinedBranches, result);
  result.horsfield = orderRatios(joined_, horsfield_, joinedBranches);
  result.strahler = orderRatios(joined_, strahler_, joinedBranches);
  for (const std::size_t i : branches) result.deadSpaceMl += airwayVolumeMm3(tree_[i]);
  result.deadSpaceMl = millilitres(result.deadSpaceMl);
  result.boxDimension = boxDimensions(tree_, branches);
  for (const auto& [a, b] : crossings_) {
    const bool counts = !lobe.has_value() || (tree_[a].lobe == *lobe && tree_[b].lobe == *lobe);
    result.crossings += counts ? 1 : 0;
  }
  return result;
}

/// The gap in the regions of `lobe`, or in all, between their share of the random points and the
/// terminals of `lobe`, or all.
std::optional<Gap> gapIn(std::optional<Lobe> lobe, const MeasuredTree& tree,
                         std::span<const LobeRegion> regions,
                         const std::vector<std::vector<Vec3>>& points, const Progress& progress) {
  std::vector<LobeRegion> ownRegions;
  std::vector<Vec3> ownPoints;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (lobe.has_value() && regions[r].lobe != *lobe) continue;
    ownRegions.push_back(regions[r]);
    ownPoints.insert(ownPoints.end(), points[r].begin(), points[r].end());
  }
  return gap(tree.terminalEnds(lobe), ownRegions, ownPoints, progress);
}

std::vector<std::vector<Vec3>> gapPoints(const MorphometryInput& input, const Progress& progress) {
  if (input.lobes.empty()) return {};
  return randomPoints(input.lobes, input.gapPoints, input.seed, progress);
}

}  // namespace

Morphometry measure(const AirwayTree& tree, const MorphometryInput& input,
                    const Progress& progress) {
  requireMeasurable(tree);
  const MeasuredTree measured(tree, progress.part(0.0, 0.5, "measuring branches"));
  Morphometry result = measured.of(std::nullopt);
  const auto points = gapPoints(input, progress.part(0.5, 0.7, "drawing random points"));
  result.gap = gapIn(std::nullopt, measured, input.lobes, points,
                     progress.part(0.7, 1.0, "measuring homogeneity"));
  progress.report(1.0);
  return result;
}

std::map<Lobe, Morphometry> measureByLobe(const AirwayTree& tree, const MorphometryInput& input,
                                          const Progress& progress) {
  requireMeasurable(tree);
  const MeasuredTree measured(tree, progress.part(0.0, 0.5, "measuring branches"));
  const auto points = gapPoints(input, progress.part(0.5, 0.7, "drawing random points"));
  std::map<Lobe, Morphometry> result;
  for (const Branch& branch : tree) result.try_emplace(branch.lobe);
  for (auto& [lobe, morphometry] : result) {
    morphometry = measured.of(lobe);
    morphometry.gap = gapIn(lobe, measured, input.lobes, points,
                            progress.part(0.7, 1.0, "measuring homogeneity"));
  }
  progress.report(1.0);
  return result;
}

}  // namespace pneuma
