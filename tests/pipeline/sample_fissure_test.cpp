#include "pipeline/sample_fissure.h"

#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"
#include "lobes/contact_sampling.h"
#include "lobes/fissure_fit.h"
#include "pipeline/sample_lung.h"
#include "support/lobe_dice.h"

namespace pneuma {
namespace {

constexpr double GridMm = 3.0;

/// The part of a fissure in its lung, as places with their areas.
FissureContact partInLung(Fissure fissure) {
  const SampleLung lung = sampleLung(side(fissure));
  const bool horizontal = fissure == Fissure::RightHorizontal;
  const SampleFissure& surface = horizontal ? *lung.horizontal : lung.oblique;
  const Box3 box = lung.bounds();
  FissureContact contact;
  for (double y = box.min().y(); y < box.max().y(); y += GridMm) {
    for (double x = box.min().x(); x < box.max().x(); x += GridMm) {
      const Vec3 p(x, y, surface.zAt(x, y));
      if (lung.pleura(lung.modelFromLps(p)) <= 0.0) continue;
      if (horizontal && lung.oblique.above(p) <= 0.0) continue;
      contact.points.push_back(p);
      contact.areasMm2.push_back(GridMm * GridMm * surface.steepness(x, y));
      contact.areaMm2 += contact.areasMm2.back();
    }
  }
  return contact;
}

/// Of a place within the pleura.
Lobe lobeAt(const SampleLung& lung, const Vec3& p) {
  const bool right = lung.side == Side::Right;
  if (lung.oblique.above(p) < 0.0) return right ? Lobe::RightLower : Lobe::LeftLower;
  if (!right) return Lobe::LeftUpper;
  return lung.horizontal->above(p) < 0.0 ? Lobe::RightMiddle : Lobe::RightUpper;
}

/// Mean by area of what `distanceMm` says of each place.
template <class F>
double meanOver(const FissureContact& contact, const F& distanceMm) {
  double sum = 0.0;
  for (std::size_t i = 0; i < contact.points.size(); ++i) {
    sum += contact.areasMm2[i] * distanceMm(contact.points[i]);
  }
  return sum / contact.areaMm2;
}

TEST(SampleFissure, IsAsRoughAsThoseOfPeople) {
  for (const Fissure fissure : ThreeFissures) {
    const FissureContact contact = partInLung(fissure);
    std::vector<Vec3> some;
    std::vector<double> areas;
    const std::size_t step = contact.points.size() / MostFissurePoints + 1;
    for (std::size_t i = 0; i < contact.points.size(); i += step) {
      some.push_back(contact.points[i]);
      areas.push_back(contact.areasMm2[i]);
    }
    const BestPlane plane = bestPlane(some, areas);
    const double away = meanOver(
        contact, [&](const Vec3& p) { return std::abs((p - plane.centre).dot(plane.axes[2])); });
    EXPECT_GE(away, 4.0) << shortName(fissure);
    EXPECT_LE(away, 7.0) << shortName(fissure);
  }
}

TEST(SampleFissure, IsSteepAsItsDerivativesSayAndNowhereSteeperThanItsBound) {
  for (const Side lung : {Side::Right, Side::Left}) {
    for (const SampleFissure& fissure : sampleLung(lung).fissures()) {
      const Box3 box = sampleLung(lung).bounds();
      Random random(2);
      for (int i = 0; i < 500; ++i) {
        const double x = random.uniform(box.min().x(), box.max().x());
        const double y = random.uniform(box.min().y(), box.max().y());
        const double h = 1e-4;
        const double dx = (fissure.zAt(x + h, y) - fissure.zAt(x - h, y)) / (2.0 * h);
        const double dy = (fissure.zAt(x, y + h) - fissure.zAt(x, y - h)) / (2.0 * h);
        EXPECT_NEAR(fissure.steepness(x, y), std::sqrt(1.0 + dx * dx + dy * dy), 1e-6);
        EXPECT_LE(fissure.steepness(x, y), fissure.steepest) << fissure.name;
      }
    }
  }
}

TEST(SampleFissure, HasPointsOnItInTheLung) {
  for (const Side lung : {Side::Right, Side::Left}) {
    const SampleLung shape = sampleLung(lung);
    for (const SampleFissure& fissure : shape.fissures()) {
      EXPECT_GT(fissure.points.size(), 100U) << fissure.name;
      EXPECT_LE(fissure.points.size(), MostFissurePoints) << fissure.name;
      for (const Vec3& p : fissure.points) {
        EXPECT_EQ(p.z(), fissure.zAt(p.x(), p.y()));
        EXPECT_GT(shape.pleura(shape.modelFromLps(p)), 0.0);
        EXPECT_TRUE(fissure.name == shape.oblique.name || shape.oblique.above(p) > 0.0);
      }
    }
  }
}

TEST(SampleFissure, InAMirrorLiesOnTheOtherSide) {
  for (const SampleFissure& fissure : sampleLung(Side::Right).fissures()) {
    const SampleFissure turned = fissure.mirrored();
    EXPECT_NEAR(turned.zAt(60.0, 17.0), fissure.zAt(-60.0, 17.0), 1e-12);
    EXPECT_EQ(turned.points[0].x(), -fissure.points[0].x());
  }
}

TEST(SampleFissure, TwentyFivePointsGiveItAndItsLobesBack) {
  constexpr double NoiseMm = 1.0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Random random(seed);
    FissureSurfaces found;
    for (const Fissure fissure : ThreeFissures) {
      const FissureContact contact = partInLung(fissure);
      found[fissure] = fitFissure(withNoise(spreadPoints(contact, 25, random), NoiseMm, random));
      const double away =
          meanOver(contact, [&](const Vec3& p) { return std::abs(found[fissure].distance(p)); });
      EXPECT_LE(away, 1.5) << shortName(fissure) << ", seed " << seed;
    }
    for (const Side half : {Side::Right, Side::Left}) {
      const SampleLung lung = sampleLung(half);
      const testing::LungVoxels voxels = testing::lungVoxels(
          half, lung.bounds(), GridMm,
          [&](const Vec3& p) { return lung.pleura(lung.modelFromLps(p)) > 0.0; });
      std::vector<Lobe> truth;
      for (const Vec3& p : voxels.centres) truth.push_back(lobeAt(lung, p));
      for (const auto& [lobe, dice] : testing::dice(truth, testing::lobesBy(found, voxels))) {
        EXPECT_GE(dice, 0.97) << shortName(lobe) << ", seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace pneuma
