#include "growth/aggregation.h"

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/plain_aggregation.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

/// A ball on a lattice, or a disc, its cells open.
template <int D>
class Round {
 public:
  explicit Round(int radius) : radius_(radius), lattice_(LatticeCell<D>::Constant(2 * radius + 3)) {
    forEachCell([&](const LatticeCell<D>& cell) {
      if (inside(cell)) lattice_.setOpen(cell);
    });
  }

  bool inside(const LatticeCell<D>& cell) const {
    return (cell - centre()).squaredNorm() <= radius_ * radius_;
  }

  LatticeCell<D> centre() const { return LatticeCell<D>::Constant(radius_ + 1); }

  AggregationLattice<D>& lattice() { return lattice_; }

  /// `count` particles from the wall onto a seed.
  AggregationResult grown(std::size_t count, std::uint64_t seed, const LatticeCell<D>& from,
                          const AggregationRules& rules = {}, double sticking = 1.0) {
    LaunchGroup<D> group{1.0, sticking, lattice_.wallCells()};
    lattice_.addToCluster(from);
    Aggregation<D> aggregation(lattice_, rules);
    Random random(seed);
    return aggregation.run(count, {std::move(group)}, random);
  }

  template <class F>
  void forEachCell(F&& f) const {
    LatticeCell<D> cell = LatticeCell<D>::Zero();
    while (cell[D - 1] < 2 * radius_ + 3) {
      f(cell);
      for (int axis = 0; axis < D; ++axis) {
        if (++cell[axis] < 2 * radius_ + 3 || axis == D - 1) break;
        cell[axis] = 0;
      }
    }
  }

 private:
  int radius_;
  AggregationLattice<D> lattice_;
};

struct Statistics {
  double mean = 0.0;
  double error = 0.0;  ///< of the mean
};

Statistics statistics(const std::vector<double>& values) {
  Statistics result;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.error = std::sqrt(squares / (n - 1.0) / n);
  return result;
}

void expectAlike(const std::vector<double>& a, const std::vector<double>& b, const char* what) {
  const Statistics one = statistics(a);
  const Statistics other = statistics(b);
  EXPECT_NEAR(one.mean, other.mean, 4.0 * std::hypot(one.error, other.error) + 1e-9) << what;
}

/// Size and place of a cluster whose seed lies off the middle: both depend on how walkers are
/// reflected and where they arrive.
template <int D>
void expectGrowsAsThePlainWalk(int radius, std::size_t particles, int seeds) {
  std::vector<double> engineSize;
  std::vector<double> engineShift;
  std::vector<double> plainSize;
  std::vector<double> plainShift;
  const auto add = [](const std::vector<LatticeCell<D>>& cells, const LatticeCell<D>& seed,
                      std::vector<double>& sizes, std::vector<double>& shifts) {
    double size = 0.0;
    double shift = 0.0;
    for (const LatticeCell<D>& cell : cells) {
      size += (cell - seed).template cast<double>().norm();
      shift += cell[0] - seed[0];
    }
    sizes.push_back(size / static_cast<double>(cells.size()));
    shifts.push_back(shift / static_cast<double>(cells.size()));
  };
  for (int i = 0; i < seeds; ++i) {
    Round<D> round(radius);
    LatticeCell<D> from = round.centre();
    from[0] -= radius / 2;
    std::vector<LatticeCell<D>> sites;
    for (const LatticeCell<D>& cell : round.lattice().wallCells()) sites.push_back(cell);
    testing::PlainAggregation<D> plain([&](const auto& cell) { return round.inside(cell); }, sites,
                                       from);
    Random random(static_cast<std::uint64_t>(100 + i));
    add(plain.run(particles, random), from, plainSize, plainShift);
    std::vector<LatticeCell<D>> cells;
    for (const AggregateParticle& particle :
         round.grown(particles, static_cast<std::uint64_t>(i), from).particles) {
      cells.push_back(round.lattice().cellOf(particle.cell));
    }
    add(cells, from, engineSize, engineShift);
  }
  expectAlike(engineSize, plainSize, "mean distance from the seed");
  expectAlike(engineShift, plainShift, "mean shift towards the middle");
}

TEST(Aggregation, GrowsInThePlaneAsTheWalkStepByStep) { expectGrowsAsThePlainWalk<2>(40, 250, 24); }

TEST(Aggregation, GrowsInSpaceAsTheWalkStepByStep) { expectGrowsAsThePlainWalk<3>(18, 250, 24); }

TEST(Aggregation, HangsEveryParticleOnANeighbourThatCameBefore) {
  Round<3> round(20);
  const AggregationResult result = round.grown(3000, 1, round.centre());
  ASSERT_EQ(result.particles.size(), 3000U);
  std::set<std::uint32_t> cluster = {round.lattice().number(round.centre())};
  for (const AggregateParticle& particle : result.particles) {
    ASSERT_TRUE(cluster.contains(particle.parent));
    const LatticeCell<3> way =
        round.lattice().cellOf(particle.cell) - round.lattice().cellOf(particle.parent);
    ASSERT_EQ(way.squaredNorm(), 1);
    ASSERT_TRUE(cluster.insert(particle.cell).second) << "two particles in one cell";
    ASSERT_TRUE(round.inside(round.lattice().cellOf(particle.cell)));
  }
}

TEST(Aggregation, EveryWalkerArrivesWhereWallsReflect) {
  Round<2> round(60);
  const AggregationResult result = round.grown(800, 1, round.centre());
  EXPECT_EQ(result.end, AggregationEnd::Complete);
  EXPECT_EQ(result.launches, result.particles.size());
}

TEST(Aggregation, WalkersFindTheirWayOutOfANarrowPassage) {
  // A corridor three cells wide and 200 long, the cluster at one end, walkers from the other.
  AggregationLattice<3> lattice(LatticeCell<3>(5, 5, 204));
  LatticeCell<3> cell;
  for (cell[2] = 1; cell[2] < 203; ++cell[2])
    for (cell[1] = 1; cell[1] < 4; ++cell[1])
      for (cell[0] = 1; cell[0] < 4; ++cell[0]) lattice.setOpen(cell);
  lattice.addToCluster({2, 2, 1});
  Aggregation<3> aggregation(lattice, {});
  Random random(1);
  const AggregationResult result =
      aggregation.run(5, {{1.0, 1.0, {LatticeCell<3>(2, 2, 202)}}}, random);
  EXPECT_EQ(result.particles.size(), 5U);
}

TEST(Aggregation, MostWalkersAreLostWhereWallsAbsorb) {
  Round<2> round(60);
  const AggregationResult result = round.grown(300, 1, round.centre(), {.wall = Wall::Absorb});
  EXPECT_EQ(result.end, AggregationEnd::Complete);
  EXPECT_GT(result.launches, 20 * result.particles.size());
}

TEST(Aggregation, ALimitOfStepsLosesWalkersToo) {
  Round<2> round(60);
  const AggregationResult result = round.grown(100, 1, round.centre(), {.mostSteps = 2000.0});
  EXPECT_EQ(result.end, AggregationEnd::Complete);
  EXPECT_GT(result.launches, 2 * result.particles.size());
}

TEST(Aggregation, IsSaturatedWhenNoSiteIsOpen) {
  Round<2> round(20);
  const AggregationResult result = round.grown(100000, 1, round.centre());
  EXPECT_EQ(result.end, AggregationEnd::Saturated);
  EXPECT_LT(result.particles.size(), 100000U);
  for (const LatticeCell<2>& cell : round.lattice().wallCells()) {
    EXPECT_TRUE(round.lattice().inCluster(cell) || round.lattice().open(cell));
  }
}

TEST(Aggregation, IsStarvedWhenNobodyArrives) {
  Round<2> round(60);
  const AggregationResult result = round.grown(10, 1, round.centre(), {.mostSteps = 3.0});
  EXPECT_EQ(result.end, AggregationEnd::Starved);
  EXPECT_TRUE(result.particles.empty());
}

/// Particles that have no daughter, as a share.
double tipShare(const AggregationResult& result) {
  std::set<std::uint32_t> mothers;
  for (const AggregateParticle& particle : result.particles) mothers.insert(particle.parent);
  double tips = 0.0;
  for (const AggregateParticle& particle : result.particles) {
    tips += mothers.contains(particle.cell) ? 0.0 : 1.0;
  }
  return tips / static_cast<double>(result.particles.size());
}

TEST(Aggregation, ALowStickingProbabilityMakesItStubby) {
  const auto spread = [](double sticking) {
    Round<2> round(60);
    const AggregationResult result = round.grown(1000, 1, round.centre(), {}, sticking);
    double sum = 0.0;
    for (const AggregateParticle& particle : result.particles) {
      sum += (round.lattice().cellOf(particle.cell) - round.centre()).cast<double>().norm();
    }
    return sum / 1000.0;
  };
  EXPECT_LT(spread(0.1), 0.9 * spread(1.0));
}

TEST(Aggregation, TipsAreAsFrequentAsTheSpecificationMeasured) {
  Round<3> space(60);
  EXPECT_NEAR(tipShare(space.grown(8000, 1, space.centre())), 0.33, 0.02);
  Round<2> plane(150);
  EXPECT_NEAR(tipShare(plane.grown(5000, 1, plane.centre())), 0.23, 0.02);
}

TEST(Aggregation, LongStepsAndReachMakeItCoarse) {
  Round<2> round(100);
  const AggregationResult result = round.grown(200, 1, round.centre(), {.step = 10, .reach = 10});
  EXPECT_GT(result.particles.size(), 50U);
  double longest = 0.0;
  for (const AggregateParticle& particle : result.particles) {
    const LatticeCell<2> way =
        round.lattice().cellOf(particle.cell) - round.lattice().cellOf(particle.parent);
    longest = std::max(longest, way.cast<double>().norm());
    ASSERT_LE(way.squaredNorm(), 100);
  }
  EXPECT_GT(longest, 5.0);
}

TEST(Aggregation, HangsNothingWhereALinkIsNotAllowed) {
  Round<2> round(30);
  LaunchGroup<2> group{1.0, 1.0, round.lattice().wallCells()};
  round.lattice().addToCluster(round.centre());
  Aggregation<2> aggregation(round.lattice(), {}, [](const auto& cell, const auto& parent) {
    return cell[0] != parent[0];  // only along x
  });
  Random random(1);
  const AggregationResult result = aggregation.run(12, {std::move(group)}, random);
  ASSERT_GT(result.particles.size(), 5U);
  for (const AggregateParticle& particle : result.particles) {
    EXPECT_EQ(round.lattice().cellOf(particle.cell)[1], round.centre()[1]);
  }
}

TEST(Aggregation, StopsWhenAskedTo) {
  Round<3> round(40);
  LaunchGroup<3> group{1.0, 1.0, round.lattice().wallCells()};
  round.lattice().addToCluster(round.centre());
  Aggregation<3> aggregation(round.lattice(), {});
  Random random(1);
  testing::ProgressRecorder recorder(0.5);
  EXPECT_THROW(aggregation.run(5000, {std::move(group)}, random, Progress(recorder)), Cancelled);
}

}  // namespace
}  // namespace pneuma
