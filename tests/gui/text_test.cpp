#include "document/text.h"

#include <gtest/gtest.h>

namespace pneuma {
namespace {

TEST(WithCommands, SaysWhichCommandHasAnOption) {
  EXPECT_EQ(withCommands("2 slices are missing; let them be interpolated (--fill-gaps)"),
            "2 slices are missing; let them be interpolated by 'pneuma import --fill-gaps'");
  EXPECT_EQ(withCommands("the ball (R) is fine (-1)"), "the ball (R) is fine (-1)");
}

TEST(Text, NumbersAreGroupedAndCarryTheirUnit) {
  EXPECT_EQ(grouped(29953), "29,953");
  EXPECT_EQ(withUnit(1234.56, 1, "mm"), "1,234.6 mm");
  EXPECT_EQ(counted(1, "branch", "branches"), "1 branch");
  EXPECT_EQ(counted(0, "branch", "branches"), "0 branches");
}

TEST(Text, FoldersAreLeftOut) {
  EXPECT_EQ(fileNameOf("/data/SMITH_JOHN/rul.stl"), "rul.stl");
  EXPECT_EQ(fileNameOf("/data/lobes/"), "lobes");
  EXPECT_EQ(withoutFolders("'/data/SMITH_JOHN/rul.stl' is empty", {"/data/SMITH_JOHN/rul.stl"}),
            "'rul.stl' is empty");
}

TEST(Text, AFolderThatWasOpenedIsNotNamedEither) {
  const auto folder = std::filesystem::temp_directory_path() / "pneuma_SMITH_JOHN";
  std::filesystem::create_directories(folder);
  const QString sentence = "the folder '" + qtText(folder.string()) + "' holds no lobe surface";
  EXPECT_EQ(withoutFolders(sentence, {folder}), "the folder '...' holds no lobe surface");
  std::filesystem::remove(folder);
}

}  // namespace
}  // namespace pneuma
