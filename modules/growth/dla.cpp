#include "growth/dla.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "anatomy/central_airways.h"
#include "anatomy/diameter_law.h"
#include "core/error.h"
#include "core/joint_progress.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/units.h"
#include "growth/aggregate_tree.h"
#include "growth/lobe_lattice.h"
#include "growth/seeding.h"

namespace pneuma {
namespace {

using Cell = LatticeCell<3>;

constexpr double TipsPerParticle = 0.066;  // after short twigs have gone
constexpr double TerminalTolerance = 0.02;
constexpr int MostTrials = 6;
constexpr double BytesPerParticle = 400.0;  // cluster, way to the tree, tree
constexpr double ShareOfMemory = 0.8;

/// What is wanted of the five lobes, in the order of FiveLobes.
std::array<double, 5> givenShares(const DlaOptions& options) {
  return {options.shareRul, options.shareRml, options.shareRll, options.shareLul, options.shareLll};
}

/// Share of the walkers for every lobe; they sum to 1.
/// @throws InvalidOption
std::vector<double> launchShares(std::span<const LobeRegion> lobes, const DlaOptions& options) {
  const std::array<double, 5> given = givenShares(options);
  const double sum = std::accumulate(given.begin(), given.end(), 0.0);
  std::vector<double> shares;
  if (sum == 0.0) {
    for (const LobeRegion& region : lobes) {
      shares.push_back(region.domain->volumeMm3() / totalVolumeMm3(lobes));
    }
    return shares;
  }
  double found = 0.0;
  for (const LobeRegion& region : lobes) {
    const auto place = std::ranges::find(FiveLobes, region.lobe);
    shares.push_back(place == FiveLobes.end()
                         ? 0.0
                         : given[static_cast<std::size_t>(place - FiveLobes.begin())]);
    found += shares.back();
  }
  if (std::abs(found - 1.0) > 1e-6) {
    throw InvalidOption("share-rul to share-lll sum to " + textOf(found) +
                        " over the lobes that are there; they must sum to 1, or all be 0 for "
                        "shares by volume");
  }
  return shares;
}

/// `count` divided by shares in whole numbers: the largest remainders are rounded up.
std::vector<std::size_t> apportioned(std::size_t count, const std::vector<double>& shares) {
  std::vector<std::size_t> parts;
  std::vector<double> remainders;
  std::size_t given = 0;
  for (const double share : shares) {
    const double exact = share * static_cast<double>(count);
    parts.push_back(static_cast<std::size_t>(exact));
    remainders.push_back(exact - std::floor(exact));
    given += parts.back();
  }
  for (; given < count; ++given) {
    const auto most = std::ranges::max_element(remainders) - remainders.begin();
    ++parts[static_cast<std::size_t>(most)];
    remainders[static_cast<std::size_t>(most)] = -1.0;
  }
  return parts;
}

/// What became of one lobe.
struct GrownLobe {
  LobeAggregate aggregate;
  AggregationEnd end = AggregationEnd::Complete;
  std::size_t wanted = 0;
  std::size_t voxels = 0;
  std::size_t unreachable = 0;
  std::uint64_t launches = 0;
};

/// Bytes for people.
std::string gigabytes(double bytes) { return textOf(std::round(bytes / 1e7) / 100.0) + " GB"; }

class Grower {
 public:
  Grower(const AirwayTree& central, std::span<const LobeRegion> lobes, const DlaOptions& options,
         const Progress& progress)
      : central_(central),
        lobes_(lobes),
        options_(options),
        progress_(progress),
        shares_(launchShares(lobes, options)),
        inlets_(lobes.size()) {
    for (const Inlet& inlet : assignLobes(central_, lobes_)) {
      inlets_[inlet.region].push_back(inlet.branch);
    }
    Box3 box;
    for (const LobeRegion& region : lobes_) box.extend(region.domain->bounds());
    corner_ = box.min();
  }

  GrowthResult run() {
    if (options_.terminals == 0) {
      return assembled(clusters(options_.particles, progress_.part(0.0, 0.85, "aggregating")));
    }
    const auto wanted = static_cast<double>(options_.terminals);
    double particles = std::ceil(wanted / TipsPerParticle);
    std::vector<GrownLobe> best;
    double bestError = 0.0;
    for (int trial = 0; trial < MostTrials; ++trial) {
      const Progress part =
          progress_.part(0.85 * trial / MostTrials, 0.85 * (trial + 1) / MostTrials, "aggregating");
      std::vector<GrownLobe> grown = clusters(static_cast<std::size_t>(particles), part);
      AirwayTree tree = central_;
      double tips = 0.0;
      for (const GrownLobe& lobe : grown) {
        tips +=
            static_cast<double>(appendAggregate(tree, lobe.aggregate, {options_.minTwig, 0}).kept);
      }
      const double error = std::abs(tips / wanted - 1.0);
      if (trial == 0 || error < bestError) {
        best = std::move(grown);
        bestError = error;
      }
      if (bestError <= TerminalTolerance) break;
      particles = std::ceil(particles * wanted / std::max(tips, 1.0));
    }
    return assembled(best);
  }

 private:
  std::vector<GrownLobe> clusters(std::size_t particles, const Progress& progress) {
    const std::vector<std::size_t> counts = apportioned(particles, shares_);
    voxelMm_ = options_.voxelMm > 0.0 ? options_.voxelMm : fillingVoxelMm(counts);
    requireMemory(particles);
    std::vector<GrownLobe> grown(lobes_.size());
    JointProgress joint(progress, lobes_.size());
    parallelFor(lobes_.size(),
                [&](std::size_t i) { grown[i] = cluster(i, counts[i], joint.task(i)); });
    return grown;
  }

  /// The voxels with which no lobe is filled before it has its particles.
  double fillingVoxelMm(const std::vector<std::size_t>& counts) const {
    double voxelMm = 1e9;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const auto particles = static_cast<double>(std::max<std::size_t>(counts[i], 1));
      voxelMm = std::min(voxelMm, pneuma::fillingVoxelMm(lobes_[i].domain->volumeMm3(), particles));
    }
    return voxelMm;
  }

  /// @throws Error (OutOfMemory) saying how many particles fit, InvalidOption saying which voxels
  /// do
  void requireMemory(std::size_t particles) const {
    const double there = ShareOfMemory * static_cast<double>(availableMemoryBytes());
    const double forParticles = BytesPerParticle * static_cast<double>(particles);
    const auto lattices = [&](double voxelMm) {
      double bytes = 0.0;
      double most = 0.0;
      for (const LobeRegion& region : lobes_) {
        const Box3 box = region.domain->bounds();
        bytes += LobeLattice::bytesFor(box, voxelMm);
        most = std::max(most, box.volume() / (voxelMm * voxelMm * voxelMm));
      }
      return most < 0x1p32 ? bytes : 1e300;  // cells are numbered with 32 bits
    };
    if (there <= 0.0) return;
    if (forParticles > there) {
      throw Error(ExitCode::OutOfMemory,
                  std::to_string(particles) + " particles need " + gigabytes(forParticles) +
                      " of memory, and " + gigabytes(there) + " may be used; ask for " +
                      std::to_string(static_cast<std::size_t>(there / BytesPerParticle)) +
                      " at most");
    }
    if (lattices(voxelMm_) + forParticles <= there) return;
    double fits = voxelMm_;
    while (lattices(fits) + forParticles > there) fits *= 1.05;
    const double bytes = lattices(voxelMm_);
    throw InvalidOption("voxels of " + textOf(voxelMm_) + " mm need " +
                        (bytes < 1e300 ? gigabytes(bytes) + " of memory"
                                       : std::string("more than 4 billion cells a lobe")) +
                        ", and " + gigabytes(there) + " may be used; a voxel of " +
                        textOf(std::ceil(fits * 100.0) / 100.0) + " mm would fit");
  }

  GrownLobe cluster(std::size_t index, std::size_t count, const Progress& progress) const {
    const LobeRegion& region = lobes_[index];
    const Domain& domain = *region.domain;
    GrownLobe grown;
    grown.wanted = count;
    grown.aggregate = {
        region, voxelMm_, airwaySeeds(central_, inlets_[index], domain, voxelMm_ / 2.0), {}, {}};
    const std::vector<AirwaySeed>& seeds = grown.aggregate.seeds;
    std::vector<Vec3> points;
    for (const AirwaySeed& seed : seeds) points.push_back(seed.point);
    LobeLattice lattice(domain, corner_ + voxelMm_ * LatticeOffset, voxelMm_, points, progress);
    grown.voxels = lattice.cells().openCells();
    requireRoom(region.lobe, count, grown.voxels);

    LaunchGroup<3> launch{1.0, options_.sticking, lattice.cells().wallCells()};
    std::unordered_map<std::uint32_t, std::int32_t> placeOf;  // cell to particle, or ~seed
    for (std::size_t s = 0; s < seeds.size(); ++s) {
      const Cell cell = lattice.cellOf(points[s]);
      if (!placeOf.emplace(lattice.cells().number(cell), ~static_cast<std::int32_t>(s)).second) {
        continue;
      }
      lattice.cells().addToCluster(cell);
    }
    // The straight way from a particle to its parent stays in the lobe.
    const auto link = [&](const Cell& cell, const Cell& parent) {
      const Vec3 from = lattice.centre(cell);
      const auto seed = placeOf.find(lattice.cells().number(parent));
      const Vec3 to = seed == placeOf.end() ? lattice.centre(parent)
                                            : points[static_cast<std::size_t>(~seed->second)];
      return domain.containsSegment(to, from);
    };
    Aggregation<3> aggregation(lattice.cells(), {options_.wall, options_.mostSteps}, link);
    grown.unreachable = aggregation.unreachableCells();
    Random random(options_.seed ^ 0x9E3779B97F4A7C15U * (index + 1));
    std::vector<Vec3> shown;
    const auto arrived = [&](std::span<const AggregateParticle> particles) {
      if (!progress.wantsPoints()) return;
      shown.clear();
      for (const AggregateParticle& particle : particles) {
        shown.push_back(lattice.centre(lattice.cells().cellOf(particle.cell)));
      }
      progress.placed(shown);
    };
    const AggregationResult result =
        aggregation.run(count, {std::move(launch)}, random, progress, arrived);
    grown.end = result.end;
    grown.launches = result.launches;

    placeOf.reserve(placeOf.size() + result.particles.size());
    for (const AggregateParticle& particle : result.particles) {
      grown.aggregate.parents.push_back(placeOf.at(particle.parent));
      placeOf.emplace(particle.cell, static_cast<std::int32_t>(grown.aggregate.positions.size()));
      grown.aggregate.positions.push_back(lattice.centre(lattice.cells().cellOf(particle.cell)));
    }
    return grown;
  }

  void requireRoom(Lobe lobe, std::size_t count, std::size_t voxels) const {
    if (count <= voxels && voxels > 0) return;
    throw InvalidOption("the " + std::string(longName(lobe)) + " holds " + std::to_string(voxels) +
                        " voxels of " + textOf(voxelMm_) + " mm, too few for " +
                        std::to_string(count) +
                        " particles; choose smaller voxels or fewer particles");
  }

  GrowthResult assembled(const std::vector<GrownLobe>& grown) {
    const Progress last = progress_.part(0.85, 1.0, "putting the tree together");
    GrowthResult result;
    result.tree = std::move(central_);
    AggregateTips tips;
    for (std::size_t i = 0; i < grown.size(); ++i) {
      last.report(static_cast<double>(i) / static_cast<double>(grown.size()));
      const LobeAggregate& aggregate = grown[i].aggregate;
      const AggregateTips own =
          appendAggregate(result.tree, aggregate, {options_.minTwig, options_.smoothing});
      tips.all += own.all;
      tips.kept += own.kept;
      if (own.kept > 0) continue;
      const double ml =
          millilitres(lobes_[i].domain->volumeMm3()) / static_cast<double>(inlets_[i].size());
      for (const std::size_t inlet : inlets_[i]) result.tree.setSuppliedMl(inlet, ml);
    }
    assignDiameters(result.tree, DiameterLaw::Flow, options_.diameterExponent);
    result.aggregate = inOrderOfArrival(grown);
    result.endsContained = result.branchesContained = true;
    describe(grown, tips, result);
    last.report(1.0);
    return result;
  }

  /// The lobes' particles as if walkers had been sent to them in turn by their shares.
  static std::vector<AggregatePoint> inOrderOfArrival(const std::vector<GrownLobe>& grown) {
    std::vector<AggregatePoint> points;
    std::vector<std::size_t> next(grown.size(), 0);
    while (true) {
      std::size_t first = grown.size();
      double least = 2.0;
      for (std::size_t i = 0; i < grown.size(); ++i) {
        const std::size_t count = grown[i].aggregate.positions.size();
        if (next[i] == count) continue;
        const double time = (static_cast<double>(next[i]) + 0.5) / static_cast<double>(count);
        if (time < least) {
          least = time;
          first = i;
        }
      }
      if (first == grown.size()) return points;
      const LobeAggregate& aggregate = grown[first].aggregate;
      points.push_back({aggregate.positions[next[first]++], aggregate.region.lobe});
    }
  }

  void describe(const std::vector<GrownLobe>& grown, const AggregateTips& tips,
                GrowthResult& result) const {
    double launches = 0.0;
    double unreachable = 0.0;
    double voxels = 0.0;
    double particles = 0.0;
    for (const GrownLobe& lobe : grown) {
      launches += static_cast<double>(lobe.launches);
      unreachable += static_cast<double>(lobe.unreachable);
      voxels += static_cast<double>(lobe.voxels);
      particles += static_cast<double>(lobe.aggregate.positions.size());
    }
    result.figures = {{"voxel_mm", voxelMm_},
                      {"voxels", voxels},
                      {"voxels_not_reached_from_an_airway", unreachable},
                      {"particles", particles},
                      {"walkers", launches},
                      {"tips", static_cast<double>(tips.all)},
                      {"tips_after_pruning", static_cast<double>(tips.kept)}};
    for (const GrownLobe& lobe : grown) {
      const auto count = static_cast<double>(lobe.aggregate.positions.size());
      result.figures.emplace_back(
          "particles_share_" + std::string(shortName(lobe.aggregate.region.lobe)),
          count / std::max(particles, 1.0));
      if (lobe.end == AggregationEnd::Complete) continue;
      result.warnings.push_back(
          "the " + std::string(longName(lobe.aggregate.region.lobe)) +
          (lobe.end == AggregationEnd::Saturated
               ? " is saturated: no place to start from is left open after "
               : " is starved: walkers no longer arrive after ") +
          std::to_string(lobe.aggregate.positions.size()) + " of " + std::to_string(lobe.wanted) +
          " particles; choose smaller voxels for more" +
          (lobe.end == AggregationEnd::Starved ? ", or walls that reflect and no limit of steps"
                                               : ""));
    }
    if (options_.terminals > 0) {
      const auto wanted = static_cast<double>(options_.terminals);
      if (std::abs(static_cast<double>(tips.kept) / wanted - 1.0) > 0.05) {
        result.warnings.push_back("asked for " + std::to_string(options_.terminals) +
                                  " terminals, grown " + std::to_string(tips.kept) +
                                  ": with these lobes and options nothing comes closer");
      }
    }
  }

  AirwayTree central_;
  std::span<const LobeRegion> lobes_;
  const DlaOptions& options_;
  const Progress& progress_;
  std::vector<double> shares_;
  std::vector<std::vector<std::size_t>> inlets_;  ///< by lobe
  Vec3 corner_ = Vec3::Zero();
  double voxelMm_ = 1.0;
};

}  // namespace

double fillingVoxelMm(double volumeMm3, double particles) {
  constexpr double Filling = 0.55;
  constexpr double Dimension = 2.5;
  return std::cbrt(volumeMm3) * std::pow(Filling / particles, 1.0 / Dimension);
}

GrowthResult growByDla(const AirwayTree& central, std::span<const LobeRegion> lobes,
                       const DlaOptions& options, const Progress& progress) {
  requireValid(options);
  return Grower(central, lobes, options, progress).run();
}

}  // namespace pneuma
