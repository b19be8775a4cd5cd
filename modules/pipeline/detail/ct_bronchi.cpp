#include "pipeline/detail/ct_bronchi.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "growth/centroid_splitting.h"

namespace pneuma {
namespace {

constexpr int DeepestGeneration = 6;  // of the bronchi that are drawn; the lobar ones are 2 and 3
constexpr double LumenHu = -990.0;
constexpr double WallHu = -30.0;
constexpr double BloodHu = 42.0;

std::vector<int> generationsOf(const AirwayTree& tree) {
  std::vector<int> generations;
  for (const Branch& branch : tree) {
    generations.push_back(
        branch.parent < 0 ? 0 : generations[static_cast<std::size_t>(branch.parent)] + 1);
  }
  return generations;
}

double wallMm(double radiusMm) { return std::clamp(0.22 * radiusMm, 0.7, 1.6); }

AirwayTree grown(const AirwayTree& central, const SampleChest& chest, std::uint64_t terminals,
                 std::uint64_t seed, const Progress& progress) {
  CentroidSplittingOptions options;
  options.terminals = terminals;
  options.jitter = 0.7;
  options.seed = seed;
  return growByCentroidSplitting(central, chest.truth, options, progress).tree;
}

AirwayTree upTo(int generation, const AirwayTree& tree) {
  const std::vector<int> generations = generationsOf(tree);
  std::vector<int> kept(tree.size(), -1);
  AirwayTree result;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (generations[i] > generation) continue;
    Branch branch = tree[i];
    if (branch.parent >= 0) branch.parent = kept[static_cast<std::size_t>(branch.parent)];
    branch.suppliedMl = 0.0;
    kept[i] = result.add(std::move(branch));
  }
  return result;
}

/// From the left atrium to where the lobar bronchi end, somewhat in front of and below them.
AirwayTree centralVeins(const SampleChest& chest) {
  const Vec3 atrium(0.0, -14.0, -38.0);
  AirwayTree veins;
  Branch root;
  root.proximal = atrium + Vec3(0.0, 0.0, -12.0);
  root.distal = atrium;
  root.radiusMm = 7.0;
  root.origin = Origin::Template;
  const int trunk = veins.add(root);
  for (const Branch& bronchus : chest.central) {
    if (side(bronchus.lobe) == Side::None) continue;
    const auto region = std::ranges::find(chest.truth, bronchus.lobe, &LobeRegion::lobe);
    Branch vein;
    vein.parent = trunk;
    vein.proximal = atrium;
    vein.distal = bronchus.distal;
    for (const Vec3& beside : {Vec3(0.0, -9.0, -7.0), Vec3(0.0, -9.0, 7.0), Vec3(0.0, 9.0, -7.0)}) {
      if (region->domain->contains(bronchus.distal + beside)) {
        vein.distal = bronchus.distal + beside;
        break;
      }
    }
    vein.radiusMm = 4.2;
    vein.lobe = bronchus.lobe;
    vein.origin = Origin::Template;
    veins.add(std::move(vein));
  }
  return veins;
}

class Bronchi {
 public:
  Bronchi(const SampleChest& chest, double topMm) : chest_(chest), topMm_(topMm) {}

  CtBronchi build(std::uint64_t seed, const Progress& progress) {
    const AirwayTree all =
        grown(chest_.central, chest_, 1800, seed, progress.part(0.0, 0.5, "growing bronchi"));
    const AirwayTree veins = grown(centralVeins(chest_), chest_, 1500, seed + 1,
                                   progress.part(0.5, 1.0, "growing veins"));
    CtBronchi result;
    result.airways = upTo(DeepestGeneration, all);
    for (const double wall : {0.0, 1.0}) addAirways(result.airways, wall);
    addArteries(all);
    addVeins(veins);
    result.shapes = std::move(shapes_);
    return result;
  }

 private:
  void addAirways(const AirwayTree& tree, double walls) {
    for (const Branch& branch : tree) {
      Vec3 from = branch.proximal;
      if (branch.parent < 0) from.z() = topMm_;
      const double radius = branch.radiusMm + walls * wallMm(branch.radiusMm);
      CtShape shape =
          tubeShape({from, branch.distal, radius, radius}, walls > 0.0 ? WallHu : LumenHu);
      if (walls > 0.0) {
        shape.labelledAsLung = true;
      } else {
        shape.label = Lobe::Central;
      }
      shapes_.push_back(std::move(shape));
    }
  }

  void addVessel(const CtTube& tube) {
    CtShape shape = tubeShape(tube, BloodHu);
    shape.labelledAsLung = true;
    shapes_.push_back(std::move(shape));
  }

  /// Each bronchus from the lobar ones on has an artery of its width at its side.
  void addArteries(const AirwayTree& tree) {
    const std::vector<int> generations = generationsOf(tree);
    std::vector<Vec3> beside(tree.size(), Vec3::UnitZ());
    std::vector<double> radii(tree.size());
    const auto shifted = [&](const Vec3& p, std::size_t i) -> Vec3 {
      const double lumen = tree[i].radiusMm;
      return p + beside[i] * (lumen + wallMm(lumen) + radii[i]);
    };
    for (std::size_t i = 0; i < tree.size(); ++i) {
      const Branch& branch = tree[i];
      radii[i] = std::min(0.9 * branch.radiusMm, 5.5);
      if (branch.parent < 0) continue;
      const auto parent = static_cast<std::size_t>(branch.parent);
      const Vec3 way = direction(branch);
      const Vec3 across = beside[parent] - way * way.dot(beside[parent]);
      beside[i] = across.norm() > 0.1 ? Vec3(across.normalized()) : anyPerpendicular(way);
      if (generations[i] < 2) continue;
      addVessel({shifted(branch.proximal, parent), shifted(branch.distal, i),
                 std::min(radii[parent], 1.5 * radii[i]), radii[i]});
    }
  }

  void addVeins(const AirwayTree& tree) {
    for (const Branch& branch : tree) {
      const double radius = branch.radiusMm;
      const double before =
          branch.parent < 0
              ? radius
              : std::min(1.4 * radius, tree[static_cast<std::size_t>(branch.parent)].radiusMm);
      addVessel({branch.proximal, branch.distal, before, radius});
    }
  }

  const SampleChest& chest_;
  double topMm_;
  CtBody shapes_;
};

}  // namespace

CtBronchi bronchi(const SampleChest& chest, double topMm, std::uint64_t seed,
                  const Progress& progress) {
  return Bronchi(chest, topMm).build(seed, progress);
}

}  // namespace pneuma
