#include "growth/dla.h"

#include <algorithm>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/central_airways.h"
#include "anatomy/validation.h"
#include "core/error.h"
#include "growth/growth.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::ball;
using testing::box;
using ::testing::HasSubstr;

class Dla : public ::testing::Test {
 protected:
  Dla()
      : lobes({{Lobe::RightUpper, box({-120, -60, 0}, {-10, 60, 120})},
               {Lobe::RightLower, ball(55.0, {-65, 0, -62})}}),
        central(templateAirways(lobes)) {}

  GrowthResult grown(const DlaOptions& options) const { return growByDla(central, lobes, options); }

  static double figure(const GrowthResult& result, const std::string& name) {
    const auto found =
        std::ranges::find(result.figures, name, [](const auto& f) { return f.first; });
    return found == result.figures.end() ? -1.0 : found->second;
  }

  std::string refusal(const DlaOptions& options) const {
    try {
      grown(options);
    } catch (const InvalidOption& error) {
      return error.what();
    }
    return "";
  }

  std::vector<LobeRegion> lobes;
  AirwayTree central;
};

TEST_F(Dla, PlacesTheParticlesThatAreWanted) {
  const GrowthResult result = grown({.particles = 20000});
  EXPECT_EQ(result.aggregate.size(), 20000U);
  EXPECT_THAT(result.warnings, ::testing::IsEmpty());
  for (const AggregatePoint& point : result.aggregate) {
    const LobeRegion& region = lobes[point.lobe == Lobe::RightUpper ? 0 : 1];
    ASSERT_TRUE(region.domain->contains(point.position));
  }
}

TEST_F(Dla, SharesFollowTheVolumesUnlessGiven) {
  const double upper = lobes[0].domain->volumeMm3();
  const double both = upper + lobes[1].domain->volumeMm3();
  const GrowthResult byVolume = grown({.particles = 5000});
  EXPECT_NEAR(figure(byVolume, "particles_share_RUL"), upper / both, 1e-3);
  const GrowthResult given = grown({.particles = 5000, .shareRul = 0.25, .shareRll = 0.75});
  EXPECT_DOUBLE_EQ(figure(given, "particles_share_RUL"), 0.25);
}

TEST_F(Dla, LobesTakeTurnsInTheOrderOfArrival) {
  const GrowthResult result = grown({.particles = 4000, .shareRul = 0.25, .shareRll = 0.75});
  std::size_t upper = 0;
  for (std::size_t i = 0; i < result.aggregate.size(); ++i) {
    upper += result.aggregate[i].lobe == Lobe::RightUpper ? 1 : 0;
    ASSERT_NEAR(static_cast<double>(upper), 0.25 * static_cast<double>(i + 1), 1.5);
  }
}

TEST_F(Dla, AimsAtTheTerminalsAskedFor) {
  const GrowthResult result = grown({.terminals = 1500});
  const auto grownTerminals = static_cast<double>(terminalCount(result.tree));
  EXPECT_NEAR(grownTerminals, 1500.0, 0.05 * 1500.0);
}

TEST_F(Dla, ChoosesVoxelsThatTheParticlesJustFill) {
  for (const std::uint64_t particles : {5000, 40000}) {
    const GrowthResult result = grown({.particles = particles});
    // From wall to wall: every octant of the box has its share of the particles.
    std::array<int, 8> octants = {};
    for (const AggregatePoint& point : result.aggregate) {
      if (point.lobe != Lobe::RightUpper) continue;
      const Vec3 from = point.position - Vec3(-65, 0, 60);
      ++octants[(from.x() > 0 ? 1U : 0U) + (from.y() > 0 ? 2U : 0U) + (from.z() > 0 ? 4U : 0U)];
    }
    const int all = std::accumulate(octants.begin(), octants.end(), 0);
    EXPECT_GT(*std::ranges::min_element(octants), all / 40) << particles;
  }
}

TEST_F(Dla, SaysWhenALobeIsSaturated) {
  const GrowthResult result = grown({.particles = 8000, .voxelMm = 6.0});
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_THAT(result.warnings.front(), HasSubstr("saturated"));
  EXPECT_THAT(result.warnings.front(), HasSubstr("choose smaller voxels"));
  EXPECT_THAT(problems(result.tree), ::testing::IsEmpty());
}

TEST_F(Dla, WidthsFollowMurraysLawFromTheTips) {
  const GrowthResult result = grown({.particles = 20000, .diameterExponent = 3.0});
  const Children children(result.tree);
  std::size_t checked = 0;
  for (std::size_t i = 0; i < result.tree.size(); ++i) {
    const Branch& branch = result.tree[i];
    if (branch.origin != Origin::Grown || children.isTerminal(i)) continue;
    double cubes = 0.0;
    for (const int child : children.of(i)) {
      const double radius = result.tree[static_cast<std::size_t>(child)].radiusMm;
      cubes += radius * radius * radius;
    }
    ASSERT_NEAR(cubes, branch.radiusMm * branch.radiusMm * branch.radiusMm, 1e-9 * cubes);
    ++checked;
  }
  EXPECT_GT(checked, 500U);
}

TEST_F(Dla, TellsSharesThatDoNotSum) {
  EXPECT_THAT(refusal({.shareRul = 0.5, .shareRll = 0.3}), HasSubstr("sum to 0.8"));
  EXPECT_THAT(refusal({.shareRul = 0.5, .shareLll = 0.5}), HasSubstr("lobes that are there"));
}

TEST_F(Dla, TellsWhenTheParticlesDoNotFit) {
  const std::string sentence = refusal({.particles = 100000, .voxelMm = 15.0});
  EXPECT_THAT(sentence, HasSubstr("voxels of 15 mm"));
  EXPECT_THAT(sentence, HasSubstr("choose smaller voxels or fewer particles"));
}

TEST_F(Dla, TellsHowMuchMemoryIsNeededAndWhatWouldFit) {
  const std::string sentence = refusal({.particles = 1000, .voxelMm = 0.004});
  EXPECT_THAT(sentence, HasSubstr("voxels of 0.004 mm need"));
  EXPECT_THAT(sentence, HasSubstr("mm would fit"));
}

TEST_F(Dla, AbsorbingWallsWorkToo) {
  const GrowthResult result =
      grown({.particles = 1500, .voxelMm = 4.0, .wall = Wall::Absorb, .mostSteps = 1e5});
  EXPECT_EQ(result.aggregate.size(), 1500U);
  EXPECT_GT(figure(result, "walkers"), 5.0 * 1500.0);
}

}  // namespace
}  // namespace pneuma
