#include "pipeline/compare_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temp_folder.h"
#include "io/volume_file.h"

namespace pneuma {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::TempFolder;

/// A block of 10 x 10 x 10 mm with label 10, and one of label 6 unless left out.
LabelImage twoLabels(bool both) {
  LabelImage image;
  image.geometry.size = {30, 14, 14};
  image.voxels.assign(image.geometry.voxelCount(), 0);
  for (int k = 2; k < 12; ++k) {
    for (int j = 2; j < 12; ++j) {
      for (int i = 2; i < 12; ++i) {
        image.at(i, j, k) = 10;
        if (both) image.at(i + 13, j, k) = 6;
      }
    }
  }
  return image;
}

class CompareShapes : public ::testing::Test {
 protected:
  CompareShapes() {
    writeVolume(folder_ / "both.nrrd", twoLabels(true));
    writeVolume(folder_ / "one.nrrd", twoLabels(false));
  }

  ShapeComparison compared(const char* first, const char* second, const ShapeLimits& limits) {
    return compareShapes(folder_ / first, folder_ / second, limits);
  }

  TempFolder folder_;
};

TEST_F(CompareShapes, IsOverEveryLimitWhereALabelIsMissing) {
  // Limits so wide that only what is missing altogether can be over them.
  for (const ShapeLimits& limits :
       {ShapeLimits{.maxHd95Mm = 1e4}, ShapeLimits{.maxVolumePercent = 1e4}}) {
    const auto gone = compared("both.nrrd", "one.nrrd", limits);
    EXPECT_THAT(gone.failures, Contains(HasSubstr("label central: the second has none")));
    const auto come = compared("one.nrrd", "both.nrrd", limits);
    EXPECT_THAT(come.failures, Contains(HasSubstr("label central: the first has none")));
    EXPECT_TRUE(compared("both.nrrd", "both.nrrd", limits).failures.empty());
  }
  EXPECT_TRUE(compared("both.nrrd", "one.nrrd", {}).failures.empty());
}

TEST_F(CompareShapes, HasNoFiguresWhereALabelIsMissing) {
  const ShapeComparison comparison = compared("one.nrrd", "both.nrrd", {});
  const Json label = toJson(comparison, {}).at("labels").at(0);
  EXPECT_EQ(label.at("label"), 6);
  EXPECT_TRUE(label.at("volume_percent").is_null());
  EXPECT_TRUE(label.at("mean_mm").is_null());
  EXPECT_TRUE(label.at("hd95_mm").is_null());
  EXPECT_THAT(textOf(comparison), HasSubstr("the first has none"));
  EXPECT_THAT(textOf(compared("both.nrrd", "one.nrrd", {})), HasSubstr("the second has none"));
}

}  // namespace
}  // namespace pneuma
