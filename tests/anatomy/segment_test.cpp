#include "anatomy/segment.h"

#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

TEST(Segments, AreTenOnTheRightAndEightOnTheLeft) {
  std::map<Side, int> count;
  std::set<std::uint8_t> numbers;
  std::set<std::string_view> names;
  for (const Segment& segment : segments()) {
    ++count[side(segment.lobe)];
    numbers.insert(segment.number);
    names.insert(segment.name);
    EXPECT_EQ(segment.name.substr(0, 2), side(segment.lobe) == Side::Right ? "RB" : "LB");
    EXPECT_NE(segment.longName.find(longName(segment.lobe)), std::string_view::npos);
  }
  EXPECT_EQ(count[Side::Right], 10);
  EXPECT_EQ(count[Side::Left], 8);
  EXPECT_EQ(numbers.size(), 18U);
  EXPECT_EQ(names.size(), 18U);
}

TEST(Segments, AreNumberedByTheirNames) {
  EXPECT_EQ(segmentOfName("RB10"), 10);
  EXPECT_EQ(segmentOfName("LB1+2"), 11);
  EXPECT_EQ(segmentOfName("LB10"), 20);
  for (const Segment& segment : segments()) {
    EXPECT_EQ(segmentName(segment.number), segment.name);
    EXPECT_EQ(segmentOfName(segment.name), segment.number);
    if (segment.number == 11) continue;
    const int digits = std::stoi(std::string(segment.name.substr(2)));
    EXPECT_EQ(segment.number, side(segment.lobe) == Side::Left ? 10 + digits : digits);
  }
}

TEST(Segments, StandInTheirLobes) {
  std::map<Lobe, int> count;
  for (const Segment& segment : segments()) ++count[segment.lobe];
  EXPECT_EQ(count, (std::map<Lobe, int>{{Lobe::RightUpper, 3},
                                        {Lobe::RightMiddle, 2},
                                        {Lobe::RightLower, 5},
                                        {Lobe::LeftUpper, 4},
                                        {Lobe::LeftLower, 4}}));
}

TEST(Segments, OthersHaveNoName) {
  for (const std::uint8_t number : {0, 12, 17, 21, 255}) EXPECT_EQ(segmentName(number), "");
  for (const std::string_view name : {"", "LB7", "LB2", "RB11", "rb1", "RB1+2"}) {
    EXPECT_EQ(segmentOfName(name), std::nullopt) << name;
  }
}

}  // namespace
}  // namespace pneuma
