#include "lobes/lobe_splitting.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/test_surfaces.h"
#include "lobes/egg_lung.h"
#include "lobes/fissure_proposal.h"

namespace pneuma {
namespace {

constexpr double SpacingMm = 4.0;

FissureSurfaces proposals(const TriangleMesh& lung, Side side) {
  FissureSurfaces fissures;
  for (const Fissure fissure : fissuresOf(side)) {
    fissures[fissure] = proposedFissure(fissure, lungBox(lung));
  }
  return fissures;
}

double share(const SplitLung& split, Lobe lobe) {
  double sum = 0.0;
  for (const Lobe each : lobesOf(split.side)) {
    sum += volumeMm3(split.complex, static_cast<RegionId>(each));
  }
  return volumeMm3(split.complex, static_cast<RegionId>(lobe)) / sum;
}

TEST(LungBox, LeavesHalfAPercentOutsideAtEachEnd) {
  TriangleMesh ball = testing::sphere(100.0, Vec3(10.0, -20.0, 30.0), 5);
  const LungBox box = lungBox(ball);
  // Of a ball the cap beyond h holds (1 - h)^2 (2 + h) / 4 of it: half a percent at h = 0.918.
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.high[axis] - Vec3(10.0, -20.0, 30.0)[axis], 91.8, 2.5);
    EXPECT_NEAR(Vec3(10.0, -20.0, 30.0)[axis] - box.low[axis], 91.8, 2.5);
  }
}

TEST(LungBox, RefusesWhatIsNoLung) {
  EXPECT_THROW(lungBox(testing::sphere(5e5)), InvalidInput);
  EXPECT_THROW(lungBox(testing::sphere(0.1)), InvalidInput);
}

TEST(LobeSplitting, ProposalsGiveLobesInTheirPlaces) {
  const TriangleMesh lung = eggLung();
  for (const Side side : {Side::Right, Side::Left}) {
    const SplitLung split = splitLung(lung, side, proposals(lung, side), SpacingMm);
    for (const Lobe lobe : lobesOf(side)) EXPECT_GT(share(split, lobe), 0.05) << shortName(lobe);
  }
  const SplitLung right = splitLung(lung, Side::Right, proposals(lung, Side::Right), SpacingMm);
  const auto middle = [&](Lobe lobe) {
    return bounds(surfaceOf(right.complex, static_cast<RegionId>(lobe)).mesh).center().eval();
  };
  EXPECT_GT(middle(Lobe::RightUpper).z(), middle(Lobe::RightLower).z());
  EXPECT_LT(middle(Lobe::RightMiddle).y(), middle(Lobe::RightLower).y());  // in front
  EXPECT_GT(middle(Lobe::RightUpper).z(), middle(Lobe::RightMiddle).z());
}

TEST(LobeSplitting, ReachesWantedShares) {
  const TriangleMesh lung = eggLung();
  const LobeShares wanted = {0.36, 0.18, 0.46};  // Huang 2004
  const FissureSurfaces fissures =
      withShares(lung, Side::Right, proposals(lung, Side::Right), wanted, SpacingMm);
  const SplitLung split = splitLung(lung, Side::Right, fissures, SpacingMm);
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    EXPECT_NEAR(share(split, lobesOf(Side::Right)[n]), wanted[n], 1e-6);
  }
}

TEST(LobeSplitting, ReachesWantedSharesOfACoarseLung) {
  // Of large triangles the cut's volume jumps by more than a share may be off.
  TriangleMesh lung = testing::sphere(1.0, Vec3::Zero(), 3);
  for (Vec3& p : lung.points) p = p.cwiseProduct(Vec3(55.0, 80.0, 115.0));
  for (int trial = 0; trial < 5; ++trial) {
    const double lower = 0.40 + 0.02 * trial;
    const LobeShares wanted = {0.87 - lower, 0.13, lower};
    const FissureSurfaces fissures =
        withShares(lung, Side::Right, proposals(lung, Side::Right), wanted, SpacingMm);
    const SplitLung split = splitLung(lung, Side::Right, fissures, SpacingMm);
    for (std::size_t n = 0; n < wanted.size(); ++n) {
      EXPECT_NEAR(share(split, lobesOf(Side::Right)[n]), wanted[n], 1e-6) << trial;
    }
  }
}

TEST(LobeSplitting, RefusesSharesThatCannotBe) {
  const TriangleMesh lung = eggLung();
  const FissureSurfaces fissures = proposals(lung, Side::Left);
  EXPECT_THROW(withShares(lung, Side::Left, fissures, {0.5, 0.6}, SpacingMm), InvalidInput);
  EXPECT_THROW(withShares(lung, Side::Left, fissures, {1.0}, SpacingMm), InvalidInput);
  EXPECT_THROW(withShares(lung, Side::Left, fissures, {1.2, -0.2}, SpacingMm), InvalidInput);
  EXPECT_THROW(splitLung(lung, Side::Right, fissures, SpacingMm), InvalidInput);
}

}  // namespace
}  // namespace pneuma
