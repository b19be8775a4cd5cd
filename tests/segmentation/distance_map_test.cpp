#include "segmentation/distance_map.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/random.h"

namespace pneuma {
namespace {

std::vector<std::uint8_t> randomMask(const std::array<int, 3>& size, double share, Random& random) {
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  for (auto& voxel : mask) voxel = random.uniform() < share ? 1 : 0;
  return mask;
}

TEST(SquaredDistances, AreThoseOfComparingEveryPair) {
  Random random(11);
  const Vec3 spacing(0.7, 0.9, 2.5);
  for (const std::array<int, 3> size : {std::array{9, 8, 7}, {1, 12, 5}, {13, 1, 1}, {6, 6, 1}}) {
    const std::vector<std::uint8_t> mask = randomMask(size, 0.03, random);
    const std::vector<float> found = squaredDistances(mask, size, spacing, 1000.0);
    const auto place = [&](std::size_t v) -> Vec3 {
      const auto n = static_cast<int>(v);
      return Vec3(n % size[0], n / size[0] % size[1], n / size[0] / size[1]).cwiseProduct(spacing);
    };
    for (std::size_t v = 0; v < mask.size(); ++v) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t w = 0; w < mask.size(); ++w) {
        const Vec3 between = place(v) - place(w);
        if (mask[w] != 0) nearest = std::min(nearest, between.squaredNorm());
      }
      if (std::isinf(nearest)) {
        ASSERT_TRUE(std::isinf(found[v]));
      } else {
        ASSERT_NEAR(found[v], nearest, 1e-3);
      }
    }
  }
}

TEST(SquaredDistances, BeyondTheLimitAreInfinite) {
  const std::array<int, 3> size = {30, 1, 1};
  std::vector<std::uint8_t> mask(30, 0);
  mask[5] = 1;
  const std::vector<float> found = squaredDistances(mask, size, Vec3::Ones(), 10.0);
  EXPECT_EQ(found[15], 100.0F);
  EXPECT_TRUE(std::isinf(found[16]));
}

TEST(SquaredDistances, AreTheSameForAnyNumberOfThreads) {
  Random random(3);
  const std::array<int, 3> size = {40, 30, 20};
  const std::vector<std::uint8_t> mask = randomMask(size, 0.01, random);
  const std::vector<float> many = squaredDistances(mask, size, {0.7, 0.7, 1.3}, 12.0);
  const ThreadLimit one(1);
  EXPECT_EQ(squaredDistances(mask, size, {0.7, 0.7, 1.3}, 12.0), many);
}

}  // namespace
}  // namespace pneuma
