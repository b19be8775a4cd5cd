#pragma once

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/domain.h"
#include "core/random.h"

/// What every Domain with formulas of its own must keep to, shown at random places.
namespace pneuma::testing {

inline Vec3 randomPoint(Random& random, const Box3& box) {
  const double x = random.uniform(box.min().x(), box.max().x());
  const double y = random.uniform(box.min().y(), box.max().y());
  return {x, y, random.uniform(box.min().z(), box.max().z())};
}

inline Vec3 randomDirection(Random& random) {
  const double x = random.normal();
  const double y = random.normal();
  return Vec3(x, y, random.normal()).normalized();
}

inline Vec3 randomInside(Random& random, const Domain& domain) {
  while (true) {
    const Vec3 p = randomPoint(random, domain.bounds());
    if (domain.contains(p)) return p;
  }
}

/// insideAlongX() gives what contains() gives, point by point.
inline void expectRowsAgree(const Domain& domain) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    Vec3 first = randomPoint(random, domain.bounds());
    first.x() -= random.uniform(0.0, 20.0);
    const double step = random.uniform(0.01, 12.0);
    const auto wanted = static_cast<std::uint32_t>(random.below(std::uint64_t{1} << 32));
    ASSERT_EQ(domain.insideAlongX(first, step, wanted),
              domain.Domain::insideAlongX(first, step, wanted))
        << "from " << first.transpose() << " by " << step;
  }
}

/// exitDistance() is where the first of points 0.05 mm apart lies outside.
inline void expectExitsAgree(const Domain& domain) {
  constexpr double Step = 0.05;
  constexpr double Farthest = 150.0;
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = randomInside(random, domain);
    const Vec3 direction = randomDirection(random);
    double marched = 0.0;
    while (marched < Farthest && domain.contains(p + (marched + Step) * direction)) marched += Step;
    const double exit = domain.exitDistance(p, direction, Farthest);
    ASSERT_LE(exit, Farthest);
    // A way that leaves and comes back between two points is marched too far, by less than a step.
    ASSERT_NEAR(exit, std::min(marched + Step / 2.0, Farthest), 1.1 * Step)
        << "from " << p.transpose() << " along " << direction.transpose();
  }
}

/// No point nearer than distanceToWall() lies on the other side, and the bound is worth having.
/// @param leastShare of the nearest wall found, that the bound must reach on average
inline void expectWallIsNoNearer(const Domain& domain, double leastShare) {
  Random random(3);
  double shares = 0.0;
  constexpr int Points = 2000;
  for (int i = 0; i < Points; ++i) {
    const Vec3 p = randomInside(random, domain);
    const double bound = domain.distanceToWall(p);
    double nearest = 1e9;
    for (int k = 0; k < 60; ++k) {
      const Vec3 direction = randomDirection(random);
      ASSERT_TRUE(domain.contains(p + 0.999999 * bound * direction)) << p.transpose();
      nearest = std::min(nearest, domain.exitDistance(p, direction, 500.0));
    }
    shares += bound / std::max(nearest, 1e-9);
  }
  EXPECT_GT(shares / Points, leastShare);
}

/// A box that is said to lie inside holds no point outside, and small boxes in the middle are
/// found.
inline void expectBoxesAgree(const Domain& domain) {
  Random random(5);
  int held = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 corner = randomInside(random, domain);
    const Vec3 size = random.uniform(0.01, 0.4) * domain.bounds().sizes();
    const Box3 box(corner - size, corner);
    if (!domain.containsBox(box)) continue;
    ++held;
    for (int point = 0; point < 50; ++point) {
      ASSERT_TRUE(domain.contains(randomPoint(random, box))) << trial;
    }
    for (int i = 0; i < 8; ++i) {
      ASSERT_TRUE(domain.contains(box.corner(static_cast<Box3::CornerType>(i)))) << trial;
    }
  }
  EXPECT_GT(held, 100);
}

/// The volume by a lattice of points `stepMm` apart, mm^3.
inline double latticeVolumeMm3(const Domain& domain, double stepMm) {
  const Box3 box = domain.bounds();
  std::size_t inside = 0;
  for (double x = box.min().x() + 0.41 * stepMm; x < box.max().x(); x += stepMm)
    for (double y = box.min().y() + 0.37 * stepMm; y < box.max().y(); y += stepMm)
      for (double z = box.min().z() + 0.53 * stepMm; z < box.max().z(); z += stepMm)
        inside += domain.contains({x, y, z}) ? 1 : 0;
  return static_cast<double>(inside) * stepMm * stepMm * stepMm;
}

}  // namespace pneuma::testing
