#include "segmentation/segmentation_checks.h"

#include <regex>
#include <set>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

TEST(SegmentationChecks, AdviseOptionsThatThereAre) {
  std::set<std::string> names;
  forEachField<LungOptions>(
      [&](const auto& field) { names.insert("--" + std::string(field.name)); });
  std::size_t advised = 0;
  LungSegmentation found;
  found.airways.found = true;
  for (const SegmentationCheck& check : segmentationChecks(found)) {
    const std::regex option("--[a-z-]+");
    for (std::sregex_iterator name(check.advice.begin(), check.advice.end(), option), end;
         name != end; ++name, ++advised) {
      EXPECT_TRUE(names.contains(name->str())) << check.advice;
    }
    EXPECT_EQ(check.advice.find("raise wall"), std::string::npos);
  }
  EXPECT_EQ(advised, 6U);
}

}  // namespace
}  // namespace pneuma
