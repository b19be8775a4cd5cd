#include "pipeline/stage_needs.h"

#include <array>
#include <utility>

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
  ImageGeometry coarse = thinChest();
  coarse.size = {256, 256, 200};
  coarse.spacing *= 2.0;
  const std::vector<StageNeed> few = stageNeeds(coarse, 0.0);
  const std::vector<StageNeed> many = stageNeeds(thinChest(), 0.0);
  ASSERT_EQ(few.size(), many.size());
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_LT(few[i].bytes, many[i].bytes) << few[i].stage;
    EXPECT_LT(few[i].seconds, many[i].seconds) << few[i].stage;
  }
  for (const char* stage : {"info", "import", "segment", "lobes", "slices"}) {
    EXPECT_GT(static_cast<double>(stageNeed(stage, thinChest(), 0.0).bytes), 2.0 * voxels) << stage;
  }
  EXPECT_THROW(stageNeed("nothing", thinChest(), 0.0), std::out_of_range);
}

TEST(StageNeeds, AreToldAsJson) {
  ImageGeometry chest;
  chest.size = {500, 500, 400};
  const Json json = toJson(stageNeeds(chest, 0.0));
  // 100 million voxels of 1 mm, 7 of them of lungs.
  EXPECT_EQ(json.at("segment").at("memory_mb"), 100.0 + 225.0 + 109.0);
  EXPECT_EQ(json.at("segment").at("threads"), 1);
  chest.size = {500, 500, 800};
  EXPECT_EQ(toJson(stageNeeds(chest, 0.0)).at("segment").at("threads"), 2);
}

/// What was measured of real CTs, MB (docs/cohort-plan.md).
TEST(StageNeeds, LieAboveWhatRealCtsTook) {
  struct Measured {
    const char* name;
    std::array<int, 3> size;
    Vec3 spacing;
    std::array<std::pair<const char*, double>, 5> megabytes;
  };

  const std::array<Measured, 3> all = {{
      {"a chest of 2.5 mm",
       {512, 512, 133},
       {0.703, 0.703, 2.5},
       {{{"info", 174}, {"segment", 246}, {"lobes", 353}, {"grow", 272}, {"breathe", 562}}}},
      {"cropped to the lungs",
       {436, 312, 261},
       {0.682, 0.682, 1.25},
       {{{"info", 203}, {"segment", 355}, {"lobes", 402}, {"grow", 356}, {"breathe", 905}}}},
      {"a chest of 5 mm",
       {512, 512, 64},
       {0.842, 0.842, 5.0},
       {{{"info", 114}, {"segment", 161}, {"lobes", 215}, {"grow", 242}, {"breathe", 429}}}},
  }};
  for (const Measured& ct : all) {
    ImageGeometry geometry;
    geometry.size = ct.size;
    geometry.spacing = ct.spacing;
    for (const auto& [stage, megabytes] : ct.megabytes) {
      const double stated = static_cast<double>(stageNeed(stage, geometry, 0.0).bytes) / 1e6;
      EXPECT_GE(stated, megabytes) << ct.name << ", " << stage;
      EXPECT_LE(stated, 1.4 * megabytes) << ct.name << ", " << stage;
    }
  }
}

TEST(StageNeeds, KnowTheVoxelsOfAResampledCt) {
  EXPECT_EQ(voxelsAt(thinChest(), 1.0), 358.0 * 358.0 * 300.0);
  EXPECT_EQ(voxelsAt(thinChest(), 1000.0), 1.0);
}

TEST(StageNeeds, HoldTheCtAsItWasReadWhileItIsResampled) {
  const ImageGeometry chest = thinChest();
  EXPECT_GT(stageNeed("import", chest, 1.5).bytes, stageNeed("import", chest, 0.0).bytes);
  EXPECT_EQ(stageNeed("info", chest, 1.5).bytes, stageNeed("info", chest, 0.0).bytes);
  EXPECT_LT(stageNeed("segment", chest, 2.0).bytes, stageNeed("segment", chest, 0.0).bytes / 4);
}

TEST(StageNeeds, NameTheFinestVoxelsThatFit) {
  const ImageGeometry chest = thinChest();
  const std::uint64_t asItIs = stageNeed("lobes", chest, 0.0).bytes;
  const std::optional<double> side = sideThatFits("lobes", chest, asItIs / 10 * 7);
  ASSERT_TRUE(side);
  // Laws are rounded up, by up to 15 % here.
  const double least = 0.85 * static_cast<double>(stageNeed("lobes", chest, *side).bytes);
  EXPECT_LE(least, 0.7 * static_cast<double>(asItIs));
  const double finer = 0.85 * static_cast<double>(stageNeed("lobes", chest, *side - 0.1).bytes);
  EXPECT_GT(finer, 0.7 * static_cast<double>(asItIs));
  // It has to be read before it can be made coarser.
  EXPECT_FALSE(sideThatFits("lobes", chest, stageNeed("import", chest, 0.0).bytes / 10 * 7));
}

TEST(StageNeeds, RefuseWhatNoMachineHolds) {
  requireStageFits("segment", "finding the lungs", thinChest(), 8.0);
  ImageGeometry huge = thinChest();
  huge.size = {30000, 30000, 30000};
  try {
    requireStageFits("segment", "finding the lungs", huge, 0.0);
    FAIL() << "61 TB are there";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::OutOfMemory);
    EXPECT_THAT(error.what(),
                ::testing::StartsWith("finding the lungs takes about 60750395 MB of memory for "
                                      "30000 x 30000 x 30000 voxels, and "));
  }
}

}  // namespace
}  // namespace pneuma
