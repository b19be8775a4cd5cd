#include "pipeline/breathe.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/surface_domain.h"
#include "io/temp_folder.h"
#include "pipeline/breathe_files.h"
#include "pipeline/lobes_model.h"
#include "pipeline/sample_chest.h"
#include "pipeline/whole_lungs.h"

namespace pneuma {
namespace {

/// The sample's lobes with a tree grown in them.
const LungModel& grownChest() {
  static const LungModel made = [] {
    const SampleChest sample = sampleChest(6.0);
    LungModel model;
    model.surfaces = std::make_shared<const std::vector<LobeSurface>>(sample.lobes);
    model = withLobes(withWholeLungs(model, {}, 5.0), {});  // which share their triangles
    model.central = std::make_shared<const AirwayTree>(sample.central);
    CentroidSplittingOptions options;
    options.terminals = 300;
    return grow(model, options);
  }();
  return made;
}

BreathingLungs breathing(Breathing scenario, int frames = 8) {
  BreatheOptions options;
  options.scenario = scenario;
  options.frames = frames;
  return breathe(grownChest(), options);
}

const MovingSurface& surfaceOf(const BreathingLungs& lungs, Lobe lobe) {
  return *std::ranges::find_if(lungs.surfaces, [lobe](const MovingSurface& surface) {
    return surface.surface.lobe == lobe;
  });
}

TEST(Breathe, VolumesFollowTheCurveExactly) {
  for (const Breathing scenario : {Breathing::Quiet, Breathing::VitalCapacity, Breathing::Copd}) {
    const BreathingLungs lungs = breathing(scenario);
    double rest = 0.0;
    for (const auto& [side, motion] : lungs.motion) rest += motion.restMm3() / 1000.0;
    for (const BreathFrame& frame : lungs.frames) {
      double sum = 0.0;
      for (const MovingSurface& surface : lungs.surfaces) {
        sum += signedVolumeMm3(surfaceAt(surface, frame.scale.at(surface.side))) / 1000.0;
      }
      EXPECT_NEAR(sum, rest + 1000.0 * frame.breath.volume, 2e-6);
    }
    EXPECT_NEAR(lungs.frames[0].phase, 0.0, 0.0);
    EXPECT_NEAR(lungs.frames[3].phase, 3.0 / 8.0, 1e-15);
  }
}

TEST(Breathe, EachLungTakesItsShare) {
  const BreathingLungs lungs = breathing(Breathing::Quiet);
  const auto gained = [&](Side side) {
    return lungs.frames[3].volumeMl.at(side) - lungs.motion.at(side).restMm3() / 1000.0;
  };
  EXPECT_NEAR(gained(Side::Right) / gained(Side::Left),
              lungs.motion.at(Side::Right).restMm3() / lungs.motion.at(Side::Left).restMm3(), 1e-9);
}

TEST(Breathe, NoGapOpensBetweenLobes) {
  const BreathingLungs lungs = breathing(Breathing::VitalCapacity);
  const MovingSurface& upper = surfaceOf(lungs, Lobe::LeftUpper);
  const MovingSurface& lower = surfaceOf(lungs, Lobe::LeftLower);
  const auto key = [](const Vec3& p) { return std::array{p.x(), p.y(), p.z()}; };
  std::map<std::array<double, 3>, std::size_t> points;
  const TriangleMesh& above = *upper.surface.mesh;
  for (std::size_t n = 0; n < above.points.size(); ++n) points[key(above.points[n])] = n;
  const TriangleMesh& below = *lower.surface.mesh;
  std::size_t shared = 0;
  for (std::size_t n = 0; n < below.points.size(); ++n) {
    const auto found = points.find(key(below.points[n]));
    if (found == points.end()) continue;
    ++shared;
    EXPECT_EQ(lower.displacement[n], upper.displacement[found->second]);
  }
  EXPECT_GT(shared, 100U);
}

TEST(Breathe, NothingTurnsInsideOut) {
  for (const Breathing scenario : {Breathing::Quiet, Breathing::VitalCapacity,
                                   Breathing::Pneumothorax, Breathing::CopdSevere}) {
    const BreathingLungs lungs = breathing(scenario, 4);
    for (const auto& [side, determinant] : lungs.leastDeterminant) EXPECT_GT(determinant, 0.2);
    for (const BreathFrame& frame : lungs.frames) {
      for (const MovingSurface& surface : lungs.surfaces) {
        const TriangleMesh moved = surfaceAt(surface, frame.scale.at(surface.side));
        const TriangleMesh& rest = *surface.surface.mesh;
        for (const auto& [i, j, k] : rest.triangles) {
          const auto area = [&](const TriangleMesh& m) {
            return Vec3((m.points[j] - m.points[i]).cross(m.points[k] - m.points[i]));
          };
          ASSERT_GT(area(rest).dot(area(moved)), 0.0);
        }
      }
    }
  }
}

TEST(Breathe, VolumeChangeIsThatOfTheField) {
  const BreathingLungs lungs = breathing(Breathing::Quiet);
  const MovingSurface& surface = lungs.surfaces[0];
  const LungMotion& motion = lungs.motion.at(surface.side);
  const Vec3 middle = bounds(*surface.surface.mesh).center();
  for (std::size_t n = 0; n < surface.displacement.size(); n += 211) {
    const auto& c = surface.volumeChange[n];
    // Differences reach to both sides of a point: look a little below the wall.
    const Vec3& p = surface.surface.mesh->points[n];
    const std::array<Vec3, 1> below = {p + 2.0 * (middle - p).normalized()};
    EXPECT_NEAR(1.0 + c[0] + c[1] + c[2], leastDeterminant(motion, below, 1.0), 0.1) << n;
  }
}

TEST(Breathe, AirwaysFollowTheirLobeAndTheTracheaStays) {
  const BreathingLungs lungs = breathing(Breathing::VitalCapacity);
  const BreathFrame& full = *std::ranges::max_element(
      lungs.frames, {}, [](const BreathFrame& frame) { return frame.breath.volume; });
  const AirwayTree moved = treeAt(lungs, full);
  ASSERT_EQ(moved.size(), lungs.tree->size());
  EXPECT_EQ(moved[0].distal, (*lungs.tree)[0].distal);
  std::map<Lobe, std::unique_ptr<SurfaceDomain>> walls;
  for (const MovingSurface& surface : lungs.surfaces) {
    walls[surface.surface.lobe] =
        std::make_unique<SurfaceDomain>(surfaceAt(surface, full.scale.at(surface.side)));
  }
  std::size_t ends = 0;
  double moving = 0.0;
  for (std::size_t n = 0; n < moved.size(); ++n) {
    const Branch& branch = moved[n];
    if (branch.parent >= 0) {
      EXPECT_NEAR((branch.proximal - moved[static_cast<std::size_t>(branch.parent)].distal).norm(),
                  0.0, 1e-9);
    }
    if (branch.origin != Origin::Grown) continue;
    ++ends;
    moving = std::max(moving, (branch.distal - (*lungs.tree)[n].distal).norm());
    const SurfaceDomain& wall = *walls.at(branch.lobe);
    EXPECT_TRUE(wall.contains(branch.distal) || wall.distanceToWall(branch.distal) <= 1e-3) << n;
  }
  EXPECT_GT(ends, 300U);
  EXPECT_GT(moving, 10.0);
}

TEST(Breathe, ACollapsedLungIsSmallAndTakesLessOfTheBreath) {
  BreatheOptions options;
  options.scenario = Breathing::Pneumothorax;
  options.affected = AffectedLung::Right;
  const BreathingLungs lungs = breathe(grownChest(), options);
  const BreathingLungs healthy = breathing(Breathing::Quiet);
  EXPECT_NEAR(lungs.motion.at(Side::Right).restMm3() / healthy.motion.at(Side::Right).restMm3(),
              0.45, 1e-6);
  EXPECT_NEAR(lungs.motion.at(Side::Left).restMm3(), healthy.motion.at(Side::Left).restMm3(), 1e-3);
  EXPECT_FALSE(lungs.warnings.empty());
}

TEST(Breathe, HasAFrameForAnyMoment) {
  const BreathingLungs lungs = breathing(Breathing::CopdSevere, 1);
  for (const double phase : {0.0, 0.13, 0.4, 0.77, 1.2}) {
    const BreathFrame frame = frameAt(lungs, phase);
    EXPECT_NEAR(frame.phase, phase - std::floor(phase), 1e-15);
    for (const auto& [side, volume] : lungs.volume) {
      const double taken = lungs.share.at(side) * 1000.0 * lungs.cycle.at(phase).volume;
      EXPECT_NEAR(volume.at(frame.scale.at(side)) / 1000.0, volume.a[0] / 1000.0 + taken, 1e-6);
      EXPECT_NEAR(frame.volumeMl.at(side), volume.a[0] / 1000.0 + taken, 1e-6);
    }
  }
  EXPECT_EQ(lungs.frames[0].volumeMl, frameAt(lungs, 0.0).volumeMl);
  const double least = frameAt(lungs, emptiestPhase(lungs)).breath.volume;
  const double most = frameAt(lungs, fullestPhase(lungs)).breath.volume;
  EXPECT_NEAR(least, lungs.cycle.trapped, 1e-9);
  EXPECT_NEAR(most - least, lungs.cycle.tidal, 1e-9);
}

TEST(Breathe, TheChestWallStandsWhereTheCollapsedLungWasAndKeepsItsDistance) {
  const BreathingLungs lungs = breathing(Breathing::Pneumothorax);
  EXPECT_FALSE(breathing(Breathing::Quiet, 1).chestWall.has_value());
  ASSERT_TRUE(lungs.chestWall.has_value());
  const LungMotion& chest = *lungs.chestWall;
  EXPECT_EQ(chest.side(), Side::Left);
  const double healthyMl = breathing(Breathing::Quiet, 1).motion.at(Side::Left).restMm3() / 1000.0;
  EXPECT_NEAR(chest.restMm3() / 1000.0, healthyMl, 1e-3);
  EXPECT_NEAR(pleuralGapMl(lungs), 0.55 * healthyMl, 1.0);
  double moved = 0.0;
  for (const BreathFrame& frame : lungs.frames) {
    const double wallMl = chest.volume().at(frame.chestWallScale) / 1000.0;
    EXPECT_NEAR(wallMl - frame.volumeMl.at(Side::Left), pleuralGapMl(lungs), 1e-6);
    moved = std::max(moved, wallMl - healthyMl);
  }
  EXPECT_GT(moved, 10.0);
}

TEST(Breathe, RefusesWhatCannotBreathe) {
  EXPECT_THROW(breathe({}, {}), InvalidInput);
  LungModel apart = grownChest();
  auto tree = std::make_shared<AirwayTree>();
  for (Branch branch : *treeOf(apart)) {
    branch.proximal.x() += 1000.0;
    branch.distal.x() += 1000.0;
    tree->add(branch);
  }
  apart.growth = nullptr;
  apart.opened = std::move(tree);
  EXPECT_THROW(breathe(apart, {}), InvalidInput);
}

TEST(Breathe, IsTheSameForAnyNumberOfThreads) {
  const BreathingLungs many = breathing(Breathing::Quiet, 2);
  const ThreadLimit one(1);
  const BreathingLungs alone = breathing(Breathing::Quiet, 2);
  for (std::size_t n = 0; n < many.surfaces.size(); ++n) {
    EXPECT_EQ(many.surfaces[n].displacement, alone.surfaces[n].displacement);
    EXPECT_EQ(many.surfaces[n].volumeChange, alone.surfaces[n].volumeChange);
  }
}

/// Writes a breath of two frames and holds what is there to what was told. @returns what was told
std::vector<std::filesystem::path> expectTold(const LungModel& model, Breathing scenario,
                                              std::uint64_t largest) {
  BreatheOptions options;
  options.scenario = scenario;
  options.frames = 2;
  const BreathingLungs lungs = breathe(model, options);
  const testing::TempFolder folder;
  writeBreath(folder / "a b.pvd", lungs, Json::object(), {}, largest);
  std::vector<std::filesystem::path> written;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    if (!entry.is_regular_file()) continue;
    written.push_back(entry.path().lexically_relative(folder.path()));
    const bool small = entry.path().extension() != ".vtp" || entry.file_size() <= largest;
    EXPECT_TRUE(small) << entry.path();
  }
  auto told = breathOutputs(folder / "a b.pvd", lungs, largest);
  std::ranges::sort(written);
  std::ranges::sort(told);
  EXPECT_EQ(written, told);
  return told;
}

TEST(Breathe, WritesTheFilesThatItTells) {
  for (const Breathing scenario : {Breathing::Quiet, Breathing::Pneumothorax}) {
    const auto whole = expectTold(grownChest(), scenario, LargestFileBytes);
    const auto divided = expectTold(grownChest(), scenario, LeastFileBytes);
    EXPECT_GT(divided.size(), whole.size());
  }
}

TEST(Breathe, TellsBeforehandWhichFilesItWillWrite) {
  BreatheOptions options;
  options.frames = 2;
  const BreathingLungs lungs = breathe(grownChest(), options);
  for (const std::uint64_t largest : {LargestFileBytes, LeastFileBytes}) {
    EXPECT_EQ(breathOutputs("a.pvd", grownChest(), options, largest),
              breathOutputs("a.pvd", lungs, largest));
  }
}

}  // namespace
}  // namespace pneuma
