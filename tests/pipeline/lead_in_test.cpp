// Airways that end before a lobe: growth leads one into it, and says so.
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/lung_model.h"
#include "pipeline/sample_chest.h"

namespace pneuma {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The sample chest; its airways without those of `missing`, as if a CT did not show them.
LungModel chestWithout(std::optional<Lobe> missing) {
  SampleChest chest = sampleChest(4.0);
  AirwayTree central;
  std::vector<int> place;
  for (const Branch& branch : chest.central) {
    const bool kept = branch.lobe != missing &&
                      (branch.parent < 0 || place[static_cast<std::size_t>(branch.parent)] >= 0);
    place.push_back(kept ? static_cast<int>(central.size()) : -1);
    if (!kept) continue;
    Branch copy = branch;
    copy.origin = Origin::Measured;
    if (copy.parent >= 0) copy.parent = place[static_cast<std::size_t>(copy.parent)];
    central.add(std::move(copy));
  }
  LungModel model;
  model.surfaces = std::make_shared<const std::vector<LobeSurface>>(std::move(chest.lobes));
  model.central = std::make_shared<const AirwayTree>(std::move(central));
  return model;
}

TEST(LeadIn, AMissingBronchusIsMadeUpForAndTold) {
  for (const GrowthMethod& method : growthMethods()) {
    const LungModel model = chestWithout(Lobe::RightMiddle);
    const LungModel grown = grow(model, method.defaults);
    EXPECT_THAT(grown.growth->result.warnings,
                Contains(AllOf(HasSubstr("right middle lobe"), HasSubstr("template"))))
        << method.name;
    EXPECT_EQ(grown.central, model.central) << "what was measured stays as it is";
    const AirwayTree& tree = grown.growth->result.tree;
    EXPECT_EQ(std::ranges::count(tree, Origin::Template, &Branch::origin), 1) << method.name;
    EXPECT_GT(std::ranges::count_if(tree,
                                    [](const Branch& branch) {
                                      return branch.lobe == Lobe::RightMiddle &&
                                             branch.origin == Origin::Grown;
                                    }),
              100)
        << method.name;
  }
}

TEST(LeadIn, NothingIsAddedToAirwaysThatReachEveryLobe) {
  const LungModel grown = grow(chestWithout({}), KitaokaOptions{});
  EXPECT_THAT(grown.growth->result.warnings, IsEmpty());
  EXPECT_EQ(std::ranges::count(grown.growth->result.tree, Origin::Template, &Branch::origin), 0);
}

}  // namespace
}  // namespace pneuma
