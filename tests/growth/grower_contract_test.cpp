// What every growth method promises, run over growthMethods(): a new method is tested by being
// there.

#include <algorithm>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/branch_order.h"
#include "anatomy/central_airways.h"
#include "anatomy/validation.h"
#include "core/parallel.h"
#include "growth/growth.h"
#include "support/progress_recorder.h"
#include "support/simple_domains.h"

namespace pneuma {

void PrintTo(const GrowthMethod& method, std::ostream* out) { *out << method.name; }

namespace {

using testing::ball;
using testing::box;
using testing::ProgressRecorder;

class GrowerContract : public ::testing::TestWithParam<GrowthMethod> {
 protected:
  GrowerContract()
      : lobes_({{Lobe::RightUpper, box({-120, -60, 0}, {-10, 60, 120})},
                {Lobe::RightLower, ball(55.0, {-65, 0, -62})}}),
        central_(templateAirways(lobes_)) {}

  GrowthResult grown(const Progress& progress = {}) const {
    return growAirways(central_, lobes_, GetParam().defaults, progress);
  }

  std::vector<LobeRegion> lobes_;
  AirwayTree central_;
};

void expectEqual(const AirwayTree& a, const AirwayTree& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].parent, b[i].parent) << i;
    ASSERT_EQ(a[i].distal, b[i].distal) << i;
    ASSERT_EQ(a[i].radiusMm, b[i].radiusMm) << i;
    ASSERT_EQ(a[i].suppliedMl, b[i].suppliedMl) << i;
  }
}

TEST_P(GrowerContract, FillsEveryLobe) {
  const AirwayTree tree = grown().tree;
  for (const LobeRegion& region : lobes_) {
    std::size_t branches = 0;
    for (const Branch& branch : tree) {
      branches += branch.origin == Origin::Grown && branch.lobe == region.lobe ? 1 : 0;
    }
    EXPECT_GT(branches, 1000U) << shortName(region.lobe);
  }
}

TEST_P(GrowerContract, KeepsTheCentralAirwaysUntouched) {
  const AirwayTree tree = grown().tree;
  ASSERT_GT(tree.size(), central_.size());
  for (std::size_t i = 0; i < central_.size(); ++i) {
    EXPECT_EQ(tree[i].parent, central_[i].parent);
    EXPECT_EQ(tree[i].proximal, central_[i].proximal);
    EXPECT_EQ(tree[i].distal, central_[i].distal);
    EXPECT_EQ(tree[i].radiusMm, central_[i].radiusMm);
    EXPECT_EQ(tree[i].origin, central_[i].origin);
  }
}

TEST_P(GrowerContract, GivesASoundTree) {
  EXPECT_THAT(problems(grown().tree), ::testing::IsEmpty());
}

TEST_P(GrowerContract, KeepsItsPromiseToStayInside) {
  const GrowthResult result = grown();
  const Outside outside = outsideTheirLobe(result.tree, lobes_);
  if (result.endsContained) {
    EXPECT_EQ(outside.ends, 0U);
  }
  if (result.branchesContained) {
    EXPECT_EQ(outside.segments, 0U);
  }
}

TEST_P(GrowerContract, NeverMakesAChildWiderThanItsParent) {
  const AirwayTree tree = grown().tree;
  for (const Branch& branch : tree) {
    if (branch.origin != Origin::Grown) continue;
    ASSERT_LE(branch.radiusMm, tree[static_cast<std::size_t>(branch.parent)].radiusMm);
  }
}

TEST_P(GrowerContract, SuppliesTheWholeVolume) {
  double supplied = 0.0;
  for (const Branch& branch : grown().tree) supplied += branch.suppliedMl;
  double volume = 0.0;
  for (const LobeRegion& region : lobes_) volume += region.domain->volumeMm3() / 1000.0;
  EXPECT_NEAR(supplied, volume, 1e-6 * volume);
}

TEST_P(GrowerContract, GivesTheSameTreeForTheSameOptions) {
  expectEqual(grown().tree, grown().tree);
}

TEST_P(GrowerContract, GivesTheSameTreeForAnyNumberOfThreads) {
  const GrowthResult many = grown();
  const ThreadLimit limit(1);
  expectEqual(grown().tree, many.tree);
}

TEST_P(GrowerContract, ReportsProgressThatRisesToOne) {
  ProgressRecorder recorder;
  grown(Progress(recorder));
  ASSERT_FALSE(recorder.fractions().empty());
  EXPECT_TRUE(std::ranges::is_sorted(recorder.fractions()));
  EXPECT_DOUBLE_EQ(recorder.fractions().back(), 1.0);
}

TEST_P(GrowerContract, StopsWhereverItIsAskedTo) {
  for (const double fraction : {0.0, 0.25, 0.5, 0.89}) {
    ProgressRecorder recorder(fraction);
    EXPECT_THROW(grown(Progress(recorder)), Cancelled) << fraction;
  }
}

TEST_P(GrowerContract, RefusesToGrowWithoutLobesOrAirways) {
  EXPECT_THROW(growAirways(central_, {}, GetParam().defaults), InvalidInput);
  EXPECT_THROW(growAirways(AirwayTree{}, lobes_, GetParam().defaults), InvalidInput);
}

TEST_P(GrowerContract, NamesTheLobeThatNoAirwayEntersAndSaysWhatToDo) {
  lobes_.push_back({Lobe::LeftLower, ball(30.0, {200, 0, 0})});
  try {
    grown();
    FAIL() << "grew without an inlet";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("left lower lobe"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("extend the airways"));
  }
}

TEST_P(GrowerContract, NamesAFieldThatIsOutOfRange) {
  std::visit(
      [&](auto options) {
        std::apply(
            [&](const auto& first, const auto&...) {
              options.*(first.member) = -1;
              try {
                growAirways(central_, lobes_, options);
                FAIL() << "accepted " << first.name << " = -1";
              } catch (const InvalidOption& error) {
                EXPECT_THAT(error.what(), ::testing::HasSubstr(std::string(first.name)));
              }
            },
            options.fields());
      },
      GetParam().defaults);
}

INSTANTIATE_TEST_SUITE_P(Methods, GrowerContract,
                         ::testing::ValuesIn(growthMethods().begin(), growthMethods().end()),
                         [](const ::testing::TestParamInfo<GrowthMethod>& method) {
                           return std::string(method.param.name);
                         });

TEST(GrowthMethods, SuggestTheNearestName) {
  try {
    growthMethod("centriod");
    FAIL() << "there is no such method";
  } catch (const InvalidOption& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("centroid"));
  }
}

TEST(GrowthMethods, AreFoundByTheirOptions) {
  for (const GrowthMethod& method : growthMethods()) {
    EXPECT_EQ(growthMethod(method.defaults).name, method.name);
  }
}

}  // namespace
}  // namespace pneuma
