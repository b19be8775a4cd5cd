#include "breathing/shot_unshot.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "breathing/strained_surfaces.h"
#include "core/error.h"

namespace pneuma {
namespace {

using testing::correlation;
using ::testing::HasSubstr;

/// A lung on which force is shared.
struct Strained {
  explicit Strained(const TriangleMesh& surface)
      : neighbours(surface), strain(testing::publishedStrainOf(surface)) {}

  std::vector<double> uniform() const { return std::vector<double>(strain.size(), 1.0); }

  VertexNeighbours neighbours;
  std::vector<double> strain;
};

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double variation(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += std::pow(value / mean(values) - 1.0, 2.0);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(VertexNeighbours, AreThoseOfTheTriangles) {
  const TriangleMesh lung = testing::irregularLung();
  const VertexNeighbours neighbours(lung);
  std::size_t ends = 0;
  std::size_t most = 0;
  std::size_t least = 100;
  for (std::size_t n = 0; n < neighbours.size(); ++n) {
    ends += neighbours.of(n).size();
    most = std::max(most, neighbours.of(n).size());
    least = std::min(least, neighbours.of(n).size());
    for (const std::uint32_t k : neighbours.of(n)) {
      EXPECT_TRUE(std::ranges::count(neighbours.of(k), n) == 1) << n << " " << k;
    }
  }
  EXPECT_EQ(ends, 2 * (3 * neighbours.size() - 6));
  EXPECT_GE(least, 4U);
  EXPECT_GE(most, 8U);
}

TEST(SharedForce, ShrinksByThePublishedRuleOnlyIfAPointCountsItself) {
  for (const TriangleMesh& surface : {testing::regularLung(), testing::irregularLung()}) {
    const Strained lung(surface);
    const auto radius = [&](ForceSharing sharing) {
      return sharingRadius(lung.neighbours, lung.strain, sharing);
    };
    EXPECT_NEAR(radius(ForceSharing::Printed), 1.0, 1e-6);
    EXPECT_NEAR(radius(ForceSharing::Receiver), 0.857, 0.01);
    EXPECT_NEAR(radius(ForceSharing::Sender), radius(ForceSharing::Receiver), 1e-6);
  }
}

/// The paper's algorithm to the letter: a promise that it does not end, so that nobody takes it for
/// a method.
TEST(SharedForce, AsPrintedNeverEnds) {
  const Strained lung(testing::regularLung(3));
  const auto after = [&](double relaxations) {
    return sharedInTurns(lung.neighbours, lung.strain, lung.uniform(), ForceSharing::Printed,
                         {.relaxationsPerNode = relaxations});
  };
  const SharedForce early = after(200);
  const SharedForce late = after(800);
  EXPECT_FALSE(late.converged);
  EXPECT_THAT(late.problem, HasSubstr("never used up"));
  EXPECT_GT(mean(late.shot), 3.5 * mean(early.shot));
  EXPECT_GT(late.left, 0.5 * early.left);
  EXPECT_THROW(sharedForce(lung.neighbours, lung.strain, lung.uniform(), ForceSharing::Printed),
               Unsupported);
  EXPECT_FALSE(sharedBySweeps(lung.neighbours, lung.strain, lung.uniform(), ForceSharing::Printed,
                              {.relaxationsPerNode = 50})
                   .converged);
}

TEST(SharedForce, IsTheSameInTurnsBySweepsAndByTheEquation) {
  const Strained lung(testing::irregularLung());
  for (const ForceSharing sharing : {ForceSharing::Receiver, ForceSharing::Sender}) {
    const std::vector<double> solved =
        sharedForce(lung.neighbours, lung.strain, lung.strain, sharing);
    for (const SharedForce& found :
         {sharedInTurns(lung.neighbours, lung.strain, lung.strain, sharing, {.tolerance = 1e-9}),
          sharedBySweeps(lung.neighbours, lung.strain, lung.strain, sharing,
                         {.tolerance = 1e-9})}) {
      EXPECT_TRUE(found.converged);
      EXPECT_EQ(found.problem, "");
      for (std::size_t n = 0; n < solved.size(); ++n) {
        EXPECT_NEAR(found.shot[n] / solved[n], 1.0, 1e-6) << n;
      }
    }
  }
}

TEST(SharedForce, InTurnsTakesAboutFiftyRelaxationsOfEachPoint) {
  const Strained lung(testing::regularLung(3));
  const SharedForce found =
      sharedInTurns(lung.neighbours, lung.strain, lung.uniform(), ForceSharing::Receiver);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.relaxationsPerNode, 48.5, 4.0);
  EXPECT_LE(found.left, 1e-6);
}

TEST(SharedForce, OfTheSendersRuleAddsUpToWhatWasPutIn) {
  const Strained lung(testing::irregularLung());
  const std::vector<double> shot =
      sharedForce(lung.neighbours, lung.strain, lung.uniform(), ForceSharing::Sender);
  double absorbed = 0.0;
  for (std::size_t n = 0; n < shot.size(); ++n) {
    double sum = lung.strain[n];
    for (const std::uint32_t k : lung.neighbours.of(n)) sum += lung.strain[k];
    absorbed += shot[n] * lung.strain[n] / sum;
  }
  EXPECT_NEAR(absorbed / static_cast<double>(shot.size()), 1.0, 1e-9);
}

TEST(SharedForce, ForgetsTheStrainUnlessTheForceHasIt) {
  const Strained regular(testing::regularLung());
  const Strained irregular(testing::irregularLung());
  const auto shot = [](const Strained& lung, const std::vector<double>& force) {
    return sharedForce(lung.neighbours, lung.strain, force, ForceSharing::Receiver);
  };
  EXPECT_LT(variation(shot(regular, regular.uniform())), 0.02);
  EXPECT_GE(correlation(shot(regular, regular.strain), regular.strain), 0.99);
  EXPECT_GE(correlation(shot(irregular, irregular.strain), irregular.strain), 0.97);
}

TEST(SharedForce, RefusesWhatCannotBeShared) {
  const Strained lung(testing::regularLung(3));
  std::vector<double> wrong = lung.strain;
  wrong[7] = 0.0;
  const auto share = [&](const std::vector<double>& strain, const std::vector<double>& force) {
    sharedForce(lung.neighbours, strain, force, ForceSharing::Receiver);
  };
  EXPECT_THROW(share(wrong, lung.uniform()), InvalidInput);
  wrong[7] = std::nan("");
  EXPECT_THROW(share(wrong, lung.uniform()), InvalidInput);
  EXPECT_THROW(share(lung.strain, wrong), InvalidInput);
  EXPECT_THROW(share({0.4}, lung.uniform()), InvalidInput);
  EXPECT_THROW(share(lung.strain, {1.0}), InvalidInput);
}

}  // namespace
}  // namespace pneuma
