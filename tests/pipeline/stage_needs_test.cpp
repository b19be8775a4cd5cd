#include "pipeline/stage_needs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace pneuma {
namespace {

/// 512 x 512 x 400 voxels of 0.7 x 0.7 x 0.75 mm: a thin chest CT.
ImageGeometry thinChest() {
  ImageGeometry geometry;
  geometry.size = {512, 512, 400};
  geometry.spacing = Vec3(0.7, 0.7, 0.75);
  return geometry;
}

TEST(StageNeeds, GrowWithTheVoxelsAndHoldAtLeastTheImage) {
  const double voxels = voxelsAt(thinChest(), 0.0);
  EXPECT_EQ(voxels, 512.0 * 512.0 * 400.0);
  const std::vector<StageNeed> few = stageNeeds(voxels / 8.0);
  const std::vector<StageNeed> many = stageNeeds(voxels);
  ASSERT_EQ(few.size(), many.size());
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_LT(few[i].bytes, many[i].bytes) << few[i].stage;
    EXPECT_LT(few[i].seconds, many[i].seconds) << few[i].stage;
  }
  for (const char* stage : {"info", "import", "segment", "lobes", "slices"}) {
    EXPECT_GT(static_cast<double>(stageNeed(stage, voxels).bytes), 2.0 * voxels) << stage;
  }
  EXPECT_THROW(stageNeed("nothing", voxels), std::out_of_range);
}

TEST(StageNeeds, AreToldAsJson) {
  const Json json = toJson(stageNeeds(1e8));
  EXPECT_EQ(json.at("segment").at("memory_mb"), 525.0);
  EXPECT_EQ(json.at("segment").at("threads"), 1);
  EXPECT_EQ(toJson(stageNeeds(2e8)).at("segment").at("threads"), 2);
}

TEST(StageNeeds, KnowTheVoxelsOfAResampledCt) {
  EXPECT_EQ(voxelsAt(thinChest(), 1.0), 358.0 * 358.0 * 300.0);
  EXPECT_EQ(voxelsAt(thinChest(), 1000.0), 1.0);
}

TEST(StageNeeds, HoldTheCtAsItWasReadWhileItIsResampled) {
  const ImageGeometry chest = thinChest();
  EXPECT_GT(stageNeed("import", chest, 1.5).bytes, stageNeed("import", chest, 0.0).bytes);
  EXPECT_EQ(stageNeed("info", chest, 1.5).bytes, stageNeed("info", chest, 0.0).bytes);
  EXPECT_LT(stageNeed("segment", chest, 1.5).bytes, stageNeed("segment", chest, 0.0).bytes / 4);
}

TEST(StageNeeds, NameTheFinestVoxelsThatFit) {
  const ImageGeometry chest = thinChest();
  const std::uint64_t asItIs = stageNeed("lobes", voxelsAt(chest, 0.0)).bytes;
  const std::optional<double> side = sideThatFits("lobes", chest, asItIs / 10 * 7);
  ASSERT_TRUE(side);
  EXPECT_LE(stageNeed("lobes", voxelsAt(chest, *side)).bytes, asItIs / 10 * 7);
  EXPECT_GT(stageNeed("lobes", voxelsAt(chest, *side - 0.1)).bytes, asItIs / 10 * 7);
  // It has to be read before it can be made coarser.
  EXPECT_FALSE(sideThatFits("lobes", chest, stageNeed("import", voxelsAt(chest, 0.0)).bytes));
}

TEST(StageNeeds, RefuseWhatNoMachineHolds) {
  requireStageFits("segment", "finding the lungs", thinChest(), 8.0);
  ImageGeometry huge = thinChest();
  huge.size = {30000, 30000, 30000};
  try {
    requireStageFits("segment", "finding the lungs", huge, 0.0);
    FAIL() << "118 TB are there";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::OutOfMemory);
    EXPECT_THAT(error.what(),
                ::testing::StartsWith("finding the lungs takes about 118800085 MB of memory for "
                                      "30000 x 30000 x 30000 voxels, and "));
  }
}

}  // namespace
}  // namespace pneuma
