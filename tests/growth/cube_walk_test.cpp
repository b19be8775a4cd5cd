#include "growth/cube_walk.h"

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

/// Where a walk step by step first has a coordinate of `radius`, and how many steps it took.
template <int D>
std::pair<LatticeCell<D>, int> walked(int radius, Random& random) {
  LatticeCell<D> at = LatticeCell<D>::Zero();
  for (int steps = 1;; ++steps) {
    const auto way = static_cast<int>(random.below(2 * D));
    at[way / 2] += way % 2 == 0 ? 1 : -1;
    if (at.cwiseAbs().maxCoeff() == radius) return {at, steps};
  }
}

TEST(CubeWalk, AStepGoesToEveryNeighbourAlike) {
  EXPECT_DOUBLE_EQ(CubeWalk<2>::exitProbability(1, 0, 0), 1.0 / 4.0);
  EXPECT_NEAR(CubeWalk<3>::exitProbability(1, 0, 0), 1.0 / 6.0, 1e-15);
  const CubeWalk<3> walk;
  EXPECT_DOUBLE_EQ(walk.meanSteps(1), 1.0);
}

TEST(CubeWalk, ProbabilitiesOfAFaceSumToItsShare) {
  for (const int radius : {1, 2, 3, 7, 16}) {
    double two = 0.0;
    double three = 0.0;
    for (int i = 1 - radius; i < radius; ++i) {
      two += CubeWalk<2>::exitProbability(radius, i, 0);
      for (int j = 1 - radius; j < radius; ++j) three += CubeWalk<3>::exitProbability(radius, i, j);
    }
    EXPECT_NEAR(two, 1.0 / 4.0, 1e-12) << radius;
    EXPECT_NEAR(three, 1.0 / 6.0, 1e-12) << radius;
  }
}

// Two steps in the plane, by hand: from a neighbour of the start, a step on along the same axis
// (1/4) leaves at (2, 0); leaving at (2, 1) takes three steps or more.
TEST(CubeWalk, LeavesASquareOfRadiusTwoAsCountedByHand) {
  // p(2,0) = q1/4, p(2,1) = q2/4, with q the expected visits of (1,0) and (1,1):
  // visits of the origin v0 = 1 + v1, v1 = v0/4 + v2/2, v2 = v1/2.
  const double v1 = 0.25 / (1.0 - 0.25 - 0.25);
  EXPECT_NEAR(CubeWalk<2>::exitProbability(2, 0, 0), v1 / 4.0, 1e-14);
  EXPECT_NEAR(CubeWalk<2>::exitProbability(2, 1, 0), v1 / 8.0, 1e-14);
}

template <int D>
void expectSampledAsWalked(int radius) {
  constexpr int Samples = 60000;
  const CubeWalk<D> walk;
  Random random(1);
  Random other(2);
  // By the distance from the middle of the face, which tells where jumps end.
  std::vector<double> jumped(static_cast<std::size_t>(D * radius), 0.0);
  std::vector<double> stepped = jumped;
  double steps = 0.0;
  LatticeCell<D> sum = LatticeCell<D>::Zero();
  const auto rank = [&](const LatticeCell<D>& at) {
    return static_cast<std::size_t>(at.cwiseAbs().sum() - radius);
  };
  for (int i = 0; i < Samples; ++i) {
    const LatticeCell<D> jump = walk.exit(radius, random);
    ASSERT_EQ(jump.cwiseAbs().maxCoeff(), radius);
    ASSERT_EQ((jump.cwiseAbs().array() == radius).count(), 1) << "an edge cannot be left through";
    jumped[rank(jump)] += 1.0;
    sum += jump;
    const auto [at, count] = walked<D>(radius, other);
    stepped[rank(at)] += 1.0;
    steps += count;
  }
  for (std::size_t k = 0; k < jumped.size(); ++k) {
    EXPECT_NEAR(jumped[k], stepped[k], 5.0 * std::sqrt(jumped[k] + stepped[k] + 10.0)) << k;
  }
  EXPECT_NEAR(walk.meanSteps(radius), steps / Samples, 0.02 * walk.meanSteps(radius));
  for (int axis = 0; axis < D; ++axis) {
    EXPECT_LT(std::abs(sum[axis]), 5.0 * radius * std::sqrt(Samples))
        << "no direction is preferred";
  }
}

TEST(CubeWalk, JumpsInThePlaneAsAWalkDoes) {
  for (const int radius : {2, 5, 12}) expectSampledAsWalked<2>(radius);
}

TEST(CubeWalk, JumpsInSpaceAsAWalkDoes) {
  for (const int radius : {2, 4, 9}) expectSampledAsWalked<3>(radius);
}

TEST(CubeWalk, StretchesItsLargestTableBeyondIt) {
  expectSampledAsWalked<2>(21);
  expectSampledAsWalked<3>(19);
}

}  // namespace
}  // namespace pneuma
