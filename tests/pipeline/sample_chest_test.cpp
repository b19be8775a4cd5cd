#include "pipeline/sample_chest.h"

#include <algorithm>
#include <array>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/central_airways.h"
#include "core/random.h"
#include "geometry/surface_domain.h"
#include "support/chest_once.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

const TriangleMesh& surface(Lobe lobe) {
  return *testing::chest().lobes[static_cast<std::size_t>(lobe) - 1].mesh;
}

double volumeMl(Lobe lobe) {
  return testing::chest().lobes[static_cast<std::size_t>(lobe) - 1].health.volumeMl;
}

Vec3 randomPoint(Random& random, const Box3& box) {
  const double x = random.uniform();
  const double y = random.uniform();
  const double z = random.uniform();
  return box.min() + box.sizes().cwiseProduct(Vec3(x, y, z));
}

TEST(SampleChest, HasFiveHealthyLobesInOrder) {
  ASSERT_EQ(testing::chest().lobes.size(), 5U);
  ASSERT_EQ(testing::chest().truth.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const LobeSurface& lobe = testing::chest().lobes[i];
    EXPECT_EQ(lobe.lobe, FiveLobes[i]);
    EXPECT_EQ(testing::chest().truth[i].lobe, FiveLobes[i]);
    EXPECT_TRUE(lobe.health.healthy()) << lobe.name;
    EXPECT_EQ(lobe.health.components, 1U) << lobe.name;
    EXPECT_THAT(complaints(lobe.health), ::testing::IsEmpty()) << lobe.name;
  }
}

TEST(SampleChest, HasTheVolumesOfAnAdult) {
  const double right =
      volumeMl(Lobe::RightUpper) + volumeMl(Lobe::RightMiddle) + volumeMl(Lobe::RightLower);
  const double left = volumeMl(Lobe::LeftUpper) + volumeMl(Lobe::LeftLower);
  EXPECT_NEAR(right, 3300.0, 100.0);
  EXPECT_NEAR(left, 2900.0, 100.0);
  EXPECT_NEAR(volumeMl(Lobe::RightUpper) / right, 0.36, 0.03);
  EXPECT_NEAR(volumeMl(Lobe::RightMiddle) / right, 0.18, 0.03);
  EXPECT_NEAR(volumeMl(Lobe::LeftUpper) / left, 0.50, 0.03);
}

TEST(SampleChest, SurfacesTakeTheVolumeOfTheFormulas) {
  for (std::size_t i = 0; i < 5; ++i) {
    const Domain& truth = *testing::chest().truth[i].domain;
    const SurfaceDomain made(*testing::chest().lobes[i].mesh);
    Random random(11);
    int inTruth = 0;
    int inBoth = 0;
    int inMade = 0;
    for (int n = 0; n < 200000; ++n) {
      const Vec3 p = randomPoint(random, truth.bounds());
      const bool isTrue = truth.contains(p);
      const bool isMade = made.contains(p);
      inTruth += isTrue ? 1 : 0;
      inMade += isMade ? 1 : 0;
      inBoth += isTrue && isMade ? 1 : 0;
    }
    EXPECT_NEAR(inMade, inTruth, 0.01 * inTruth) << testing::chest().lobes[i].name;
    EXPECT_GT(inBoth, 0.99 * inTruth) << testing::chest().lobes[i].name;
    const double counted = truth.bounds().volume() * inTruth / 200000.0;
    EXPECT_NEAR(truth.volumeMm3(), counted, 0.02 * counted) << testing::chest().lobes[i].name;
  }
}

TEST(SampleChest, LobesMeetInTheSamePointsAndDoNotOverlap) {
  constexpr std::array<std::array<Lobe, 2>, 4> neighbours = {{{Lobe::RightUpper, Lobe::RightMiddle},
                                                              {Lobe::RightUpper, Lobe::RightLower},
                                                              {Lobe::RightMiddle, Lobe::RightLower},
                                                              {Lobe::LeftUpper, Lobe::LeftLower}}};
  for (const auto& [one, other] : neighbours) {
    const auto key = [](const Vec3& p) { return std::array{p.x(), p.y(), p.z()}; };
    std::set<std::array<double, 3>> points;
    for (const Vec3& p : surface(one).points) points.insert(key(p));
    const auto shared = std::ranges::count_if(
        surface(other).points, [&](const Vec3& p) { return points.contains(key(p)); });
    EXPECT_GT(shared, 500) << shortName(one) << " " << shortName(other);

    const SurfaceDomain first(surface(one));
    const SurfaceDomain second(surface(other));
    Random random(5);
    int inFirst = 0;
    int inBoth = 0;
    for (int n = 0; n < 100000; ++n) {
      const Vec3 p = randomPoint(random, first.bounds());
      inFirst += first.contains(p) ? 1 : 0;
      inBoth += first.contains(p) && second.contains(p) ? 1 : 0;
    }
    EXPECT_LT(inBoth, 0.001 * inFirst) << shortName(one) << " " << shortName(other);
  }
}

TEST(SampleChest, FissuresPartTheLobesWhereTheFormulasSay) {
  // Straight down through the right lung: upper lobe, then middle, then lower.
  const auto lobeAt = [](const Vec3& p) {
    for (const LobeRegion& region : testing::chest().truth) {
      if (region.domain->contains(p)) return region.lobe;
    }
    return Lobe::Whole;
  };
  std::vector<Lobe> downTheRight;
  std::vector<Lobe> downTheLeft;
  for (double z = 120.0; z > -180.0; z -= 0.5) {
    const Lobe right = lobeAt({-90.0, -30.0, z});
    const Lobe left = lobeAt({90.0, -10.0, z});
    if (right != Lobe::Whole && (downTheRight.empty() || downTheRight.back() != right)) {
      downTheRight.push_back(right);
    }
    if (left != Lobe::Whole && (downTheLeft.empty() || downTheLeft.back() != left)) {
      downTheLeft.push_back(left);
    }
  }
  EXPECT_THAT(downTheRight,
              ::testing::ElementsAre(Lobe::RightUpper, Lobe::RightMiddle, Lobe::RightLower));
  EXPECT_THAT(downTheLeft, ::testing::ElementsAre(Lobe::LeftUpper, Lobe::LeftLower));
}

TEST(SampleChest, TruthNeverClaimsMoreDistanceThanThereIs) {
  for (const LobeRegion& region : testing::chest().truth) {
    Random random(3);
    for (int n = 0; n < 5000; ++n) {
      const Vec3 p = randomPoint(random, region.domain->bounds());
      const Vec3 towards = 2.0 * randomPoint(random, Box3(-Vec3::Ones(), Vec3::Ones()));
      const Vec3 near = p + 0.999 * region.domain->distanceToWall(p) * towards.normalized();
      if (!region.domain->bounds().contains(near)) continue;
      ASSERT_EQ(region.domain->contains(p), region.domain->contains(near)) << p.transpose();
    }
  }
}

TEST(SampleChest, EveryLobeHasOneBronchusThatEndsInIt) {
  EXPECT_THAT(problems(testing::chest().central), ::testing::IsEmpty());
  EXPECT_EQ(terminalCount(testing::chest().central), 5U);
  for (const bool made : {false, true}) {
    std::vector<LobeRegion> regions = testing::chest().truth;
    for (std::size_t i = 0; made && i < 5; ++i) {
      regions[i].domain = std::make_shared<SurfaceDomain>(*testing::chest().lobes[i].mesh);
    }
    AirwayTree central = testing::chest().central;
    const std::vector<Inlet> inlets = assignLobes(central, regions);
    ASSERT_EQ(inlets.size(), 5U);
    std::set<std::size_t> lobes;
    for (const Inlet& inlet : inlets) {
      lobes.insert(inlet.region);
      EXPECT_EQ(central[inlet.branch].lobe, regions[inlet.region].lobe);
      EXPECT_EQ(testing::chest().central[inlet.branch].lobe, regions[inlet.region].lobe);
      EXPECT_LT(lengthMm(central[inlet.branch]), 60.0) << "a lobar bronchus is short";
    }
    EXPECT_EQ(lobes.size(), 5U);
  }
}

TEST(SampleChest, LobesAreOnePieceOnEveryLattice) {
  // Without joining crumbs the middle lobe has some on these.
  for (const double cellMm : {3.0, 4.5, 6.0}) {
    for (const LobeSurface& lobe : sampleChest(cellMm).lobes) {
      EXPECT_TRUE(lobe.health.healthy()) << lobe.name << ", " << cellMm << " mm";
      EXPECT_EQ(lobe.health.components, 1U) << lobe.name << ", " << cellMm << " mm";
    }
  }
}

TEST(SampleChest, IsAsHealthyOnACoarseLattice) {
  const SampleChest coarse = sampleChest(4.0);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_TRUE(coarse.lobes[i].health.healthy()) << coarse.lobes[i].name;
    EXPECT_EQ(coarse.lobes[i].health.components, 1U) << coarse.lobes[i].name;
    const double fine = testing::chest().lobes[i].health.volumeMl;
    EXPECT_NEAR(coarse.lobes[i].health.volumeMl, fine, 0.01 * fine) << coarse.lobes[i].name;
  }
}

TEST(SampleChest, RefusesALatticeThatCannotBe) {
  EXPECT_THROW(sampleChest(0.01), InvalidOption);
  EXPECT_THROW(sampleChest(20.0), InvalidOption);
}

TEST(SampleChest, StopsWhenAsked) {
  testing::ProgressRecorder stopAtOnce(0.0);
  EXPECT_THROW(sampleChest(4.0, Progress(stopAtOnce)), Cancelled);
}

TEST(SampleChest, LobesChangeAtTheFissures) {
  // Below and above each fissure, one millimetre away, are the lobes that it parts.
  const auto holds = [](Lobe lobe, const Vec3& p) {
    return testing::chest().truth[static_cast<std::size_t>(lobe) - 1].domain->contains(p);
  };
  ASSERT_EQ(testing::chest().fissures.size(), 3U);
  Random random(11);
  for (const SampleFissure& fissure : testing::chest().fissures) {
    const bool right = fissure.name.starts_with("right");
    const bool horizontal = fissure.name == "right-horizontal";
    std::size_t crossings = 0;
    for (int i = 0; i < 2000; ++i) {
      const double x = random.uniform(20.0, 130.0) * (right ? -1.0 : 1.0);
      const double y = random.uniform(-100.0, 100.0);
      const Vec3 below(x, y, fissure.zAt(x, y) - 1.0);
      const Vec3 above(x, y, fissure.zAt(x, y) + 1.0);
      const Lobe lower = horizontal ? Lobe::RightMiddle
                         : right    ? Lobe::RightLower
                                    : Lobe::LeftLower;
      const bool lowerBelow = holds(lower, below);
      const bool upperAbove =
          right ? holds(Lobe::RightUpper, above) || (!horizontal && holds(Lobe::RightMiddle, above))
                : holds(Lobe::LeftUpper, above);
      EXPECT_FALSE(holds(lower, above)) << fissure.name;
      if (lowerBelow && upperAbove) ++crossings;
    }
    EXPECT_GT(crossings, 100U) << fissure.name;
  }
}

}  // namespace
}  // namespace pneuma
