#include "growth/free_cluster.h"

#include <gtest/gtest.h>

#include "anatomy/cluster_dimension.h"

namespace pneuma {
namespace {

template <int D>
double meanDimension(std::size_t particles) {
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    sum += gyrationDimension(freeCluster<D>(particles, seed)) / 4.0;
  }
  return sum;
}

// The literature: 1.71 and 2.5 (Meakin 1983; Tolman and Meakin 1989).
TEST(FreeCluster, HasTheKnownDimensionInThePlane) {
  EXPECT_NEAR(meanDimension<2>(30000), 1.71, 0.06);
}

TEST(FreeCluster, HasTheKnownDimensionInSpace) { EXPECT_NEAR(meanDimension<3>(20000), 2.5, 0.1); }

TEST(FreeCluster, StartsAtTheOriginAndIsTheSameForTheSameSeed) {
  const std::vector<Vec3> cluster = freeCluster<3>(500, 7);
  EXPECT_EQ(cluster.size(), 500U);
  EXPECT_EQ(cluster.front(), Vec3::Zero());
  EXPECT_EQ(cluster, freeCluster<3>(500, 7));
  EXPECT_NE(cluster, freeCluster<3>(500, 8));
}

}  // namespace
}  // namespace pneuma
