#include "anatomy/lobe.h"

#include <gtest/gtest.h>

namespace pneuma {
namespace {

TEST(Lobe, LabelsAreThoseOfLabelImages) {
  EXPECT_EQ(static_cast<int>(Lobe::RightUpper), 1);
  EXPECT_EQ(static_cast<int>(Lobe::RightMiddle), 2);
  EXPECT_EQ(static_cast<int>(Lobe::RightLower), 3);
  EXPECT_EQ(static_cast<int>(Lobe::LeftUpper), 4);
  EXPECT_EQ(static_cast<int>(Lobe::LeftLower), 5);
  EXPECT_EQ(static_cast<int>(Lobe::Central), 6);
  EXPECT_EQ(static_cast<int>(Lobe::RightLung), 10);
  EXPECT_EQ(static_cast<int>(Lobe::LeftLung), 20);
}

TEST(Lobe, LiesOnOneSide) {
  EXPECT_EQ(side(Lobe::RightMiddle), Side::Right);
  EXPECT_EQ(side(Lobe::RightLung), Side::Right);
  EXPECT_EQ(side(Lobe::LeftLower), Side::Left);
  EXPECT_EQ(side(Lobe::Central), Side::None);
  EXPECT_EQ(side(Lobe::Whole), Side::None);
  EXPECT_EQ(name(Side::Right), "right");
  EXPECT_EQ(name(Side::None), "none");
}

TEST(Lobe, ShortNamesReadBackInAnyCase) {
  for (const Lobe lobe : FiveLobes) EXPECT_EQ(lobeOfShortName(shortName(lobe)), lobe);
  EXPECT_EQ(lobeOfShortName("rul"), Lobe::RightUpper);
  EXPECT_EQ(lobeOfShortName("Central"), Lobe::Central);
  EXPECT_EQ(lobeOfShortName("RUX"), std::nullopt);
  EXPECT_EQ(lobeOfShortName(""), std::nullopt);
  EXPECT_EQ(longName(Lobe::LeftUpper), "left upper lobe");
}

struct FileNameCase {
  const char* name;
  std::optional<Lobe> lobe;
};

void PrintTo(const FileNameCase& item, std::ostream* out) { *out << item.name; }

class LobeOfFileName : public ::testing::TestWithParam<FileNameCase> {};

TEST_P(LobeOfFileName, IsTheWordInTheStem) {
  EXPECT_EQ(lobeOfFileName(GetParam().name), GetParam().lobe);
}

INSTANTIATE_TEST_SUITE_P(Names, LobeOfFileName,
                         ::testing::Values(FileNameCase{"rul.stl", Lobe::RightUpper},
                                           FileNameCase{"RML.STL", Lobe::RightMiddle},
                                           FileNameCase{"Case_1-RLL.stl", Lobe::RightLower},
                                           FileNameCase{"/data/rul/lul.vtp", Lobe::LeftUpper},
                                           FileNameCase{"C:\\lungs\\lll_v2.ply", Lobe::LeftLower},
                                           FileNameCase{"lll2.obj", Lobe::LeftLower},
                                           FileNameCase{"right_rul.stl", Lobe::RightUpper},
                                           FileNameCase{"Right.stl", Lobe::RightLung},
                                           FileNameCase{"lung-left.stl", Lobe::LeftLung},
                                           FileNameCase{"trulli.stl", std::nullopt},
                                           FileNameCase{"bright.stl", std::nullopt},
                                           FileNameCase{"central.vtp", std::nullopt},
                                           FileNameCase{"", std::nullopt}));

}  // namespace
}  // namespace pneuma
