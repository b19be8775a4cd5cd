#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "acceptance/dice_table.h"
#include "core/parallel.h"
#include "geometry/surface_domain.h"
#include "io/surface_file.h"
#include "lobes/contact_sampling.h"
#include "lobes/fissure_fit.h"
#include "support/lobe_dice.h"

// Points upon the true fissures of a real subject, 1 mm noise, and how much of the lobes comes
// back.
namespace pneuma::testing {
namespace {

constexpr std::size_t Draws = 40;
constexpr double NoiseMm = 1.0;
constexpr double VoxelMm = 2.0;

/// The five lobes of lobes_airways_chaste, which share their triangles.
struct RealLobes {
  std::map<Fissure, FissureContact> contacts;
  std::map<Side, LungVoxels> lungs;
  std::map<Side, std::vector<Lobe>> truth;
};

std::map<Lobe, TriangleMesh> surfaces(const std::filesystem::path& folder) {
  std::map<Lobe, TriangleMesh> lobes;
  lobes[Lobe::RightUpper] = readSurface(folder / "rul.stl").mesh;
  lobes[Lobe::RightMiddle] = readSurface(folder / "rml.stl").mesh;
  lobes[Lobe::RightLower] = readSurface(folder / "rll.stl").mesh;
  lobes[Lobe::LeftUpper] = readSurface(folder / "lul.stl").mesh;
  lobes[Lobe::LeftLower] = readSurface(folder / "lll.stl").mesh;
  return lobes;
}

RealLobes realLobes(const std::filesystem::path& folder) {
  const std::map<Lobe, TriangleMesh> lobes = surfaces(folder);
  RealLobes real;
  for (const Fissure fissure : ThreeFissures) {
    real.contacts[fissure] = fissureContact(fissure, lobes);
  }
  for (const Side lung : {Side::Right, Side::Left}) {
    std::map<Lobe, std::unique_ptr<SurfaceDomain>> domains;
    Box3 box;
    for (const Lobe lobe : lobesOf(lung)) {
      domains[lobe] = std::make_unique<SurfaceDomain>(lobes.at(lobe));
      box.extend(domains[lobe]->bounds());
    }
    const auto lobeAt = [&](const Vec3& p) {
      for (const auto& [lobe, domain] : domains) {
        if (domain->bounds().contains(p) && domain->contains(p)) return lobe;
      }
      return Lobe::Whole;
    };
    std::vector<Lobe>& truth = real.truth[lung];
    real.lungs[lung] = lungVoxels(lung, box, VoxelMm, [&](const Vec3& p) {
      const Lobe lobe = lobeAt(p);
      if (lobe != Lobe::Whole) truth.push_back(lobe);
      return lobe != Lobe::Whole;
    });
  }
  return real;
}

std::map<Lobe, double> fiveDice(const RealLobes& real, const FissureSurfaces& fissures) {
  std::map<Lobe, double> all;
  for (const auto& [lung, voxels] : real.lungs) {
    all.merge(dice(real.truth.at(lung), lobesBy(fissures, voxels)));
  }
  return all;
}

/// Fissures made of points, from another draw each time, and their Dice.
template <class F>
void tryWay(const RealLobes& real, DiceTable& table, const std::string& way, std::size_t points,
            const F& surfaceOf) {
  std::vector<std::map<Lobe, double>> results(Draws);
  parallelFor(Draws, [&](std::size_t draw) {
    Random random(1000 * points + draw);
    FissureSurfaces fissures;
    for (const Fissure fissure : ThreeFissures) {
      const std::vector<Vec3> spread = spreadPoints(real.contacts.at(fissure), points, random);
      fissures[fissure] = surfaceOf(withNoise(spread, NoiseMm, random));
    }
    results[draw] = fiveDice(real, fissures);
  });
  for (const auto& result : results) table.add(way, result);
}

TEST(RealLobes, ComeBackFromPointsUponTheirFissures) {
  const char* data = std::getenv("PNEUMA_TEST_DATA");
  if (data == nullptr || *data == '\0') GTEST_SKIP() << "PNEUMA_TEST_DATA is not set";
  const std::filesystem::path folder = std::filesystem::path(data) / "lobes_airways_chaste";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "there is no " << folder;
  const RealLobes real = realLobes(folder);
  const auto spline = [](const std::vector<Vec3>& points) { return fitFissure(points); };
  DiceTable table;
  FissureSurfaces proposed;
  for (const Fissure fissure : ThreeFissures) {
    proposed[fissure] = proposedFissure(fissure, boxOf(real.lungs.at(side(fissure))));
  }
  table.add("proposal", fiveDice(real, proposed));
  tryWay(real, table, "planes of 12", 12, planeThrough);
  tryWay(real, table, "6 points", 6, spline);
  tryWay(real, table, "12 points", 12, spline);
  tryWay(real, table, "25 points", 25, spline);
  table.print("lobes_airways_chaste");

  double mean = 0.0;
  for (const Lobe lobe : FiveLobes) {
    const bool middle = lobe == Lobe::RightMiddle;
    mean += table.worst("proposal", lobe) / 5.0;
    EXPECT_GE(table.worst("proposal", lobe), 0.75) << shortName(lobe);
    EXPECT_GE(table.worst("planes of 12", lobe), middle ? 0.85 : 0.93) << shortName(lobe);
    EXPECT_GE(table.worst("12 points", lobe), middle ? 0.93 : 0.97) << shortName(lobe);
    EXPECT_GE(table.worst("25 points", lobe), 0.97) << shortName(lobe);
  }
  EXPECT_GE(mean, 0.85);
}

}  // namespace
}  // namespace pneuma::testing
