#include "document/option_layout.h"

#include <map>
#include <variant>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

/// How often each option of the layout is shown.
std::map<std::string, int> shown(const OptionLayout& layout) {
  std::map<std::string, int> count;
  for (const auto& name : layout.usual) ++count[name];
  for (const OptionGroup& group : layout.groups) {
    for (const auto& name : group.names) ++count[name];
  }
  return count;
}

TEST(OptionLayout, ShowsEveryOptionOfEveryMethodOnce) {
  for (const GrowthMethod& method : growthMethods()) {
    std::map<std::string, int> count = shown(optionLayout(method));
    std::visit(
        [&](const auto& options) {
          forEachField<std::remove_cvref_t<decltype(options)>>([&](const auto& field) {
            EXPECT_EQ(count[std::string(field.name)], 1) << method.name << " " << field.name;
            count.erase(std::string(field.name));
          });
        },
        method.defaults);
    EXPECT_TRUE(count.empty()) << method.name << " has no " << count.begin()->first;
  }
}

TEST(OptionLayout, NoOptionOfKitaokaIsWithoutAGroup) {
  for (const OptionGroup& group : optionLayout(growthMethod("kitaoka")).groups) {
    EXPECT_NE(group.title, "Other") << group.names.front();
  }
}

TEST(OptionLayout, AMethodWithoutAnArrangementShowsAllItHas) {
  GrowthMethod method = growthMethod("centroid");
  method.name = "new";
  const OptionLayout layout = optionLayout(method);
  EXPECT_EQ(layout.usual, (std::vector<std::string>{"terminals", "containment", "seed"}));
  ASSERT_EQ(layout.groups.size(), 1U);
  EXPECT_TRUE(layout.groups.front().title.isEmpty());
}

TEST(OptionLayout, OnlyAMethodWhoseDefaultsGoBeyondItsPaperHasThePapersValues) {
  const auto paper = paperOptions(growthMethod("kitaoka"));
  ASSERT_TRUE(paper.has_value());
  EXPECT_EQ(std::get<KitaokaOptions>(*paper), kitaokaPaper());
  EXPECT_FALSE(paperOptions(growthMethod("centroid")).has_value());
}

}  // namespace
}  // namespace pneuma
