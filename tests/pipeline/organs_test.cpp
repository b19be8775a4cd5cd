#include "pipeline/organs.h"

#include <cmath>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/segment.h"
#include "anatomy/validation.h"
#include "core/error.h"
#include "core/units.h"
#include "io/airway_table.h"

namespace pneuma {
namespace {

TEST(Organs, AllOpenWithAirwaysThatEndInside) {
  for (const std::string_view name : organNames()) {
    const LungModel model = openOrgan(name);
    EXPECT_THAT(problems(*model.central), ::testing::IsEmpty()) << name;
    EXPECT_EQ(outsideTheirLobe(*model.central, *model.regions).ends, 0U) << name;
  }
}

TEST(Organs, HaveTheSizeAskedFor) {
  for (const std::string_view name : organNames()) {
    const LungModel model = openOrgan(name, {.sizeMl = 2000.0});
    double sum = 0.0;
    for (const LobeRegion& region : *model.regions) sum += region.domain->volumeMm3();
    EXPECT_NEAR(millilitres(sum), 2000.0, 1.0) << name;
  }
}

TEST(Organs, SurfacesHoldWhatTheRegionsHold) {
  const LungModel lung = openOrgan("right-lung");
  const auto surfaces = surfacesOf(*lung.regions, 2.0);
  ASSERT_EQ(surfaces->size(), lung.regions->size());
  for (std::size_t i = 0; i < surfaces->size(); ++i) {
    const LobeSurface& surface = (*surfaces)[i];
    EXPECT_EQ(surface.lobe, (*lung.regions)[i].lobe);
    EXPECT_TRUE(surface.health.closed) << surface.name;
    const double volume = (*lung.regions)[i].domain->volumeMm3();
    // Smoothing over two cells rounds the edges.
    EXPECT_NEAR(signedVolumeMm3(*surface.mesh), volume, 0.03 * volume) << surface.name;
  }
}

TEST(Organs, ThoraxHasEveryNamedSegment) {
  const LungModel thorax = openOrgan("thorax");
  const AirwayTree& central = *thorax.central;
  EXPECT_EQ(central.size(), 35U);
  EXPECT_EQ(terminalCount(central), 18U);
  const Children children(central);
  std::set<std::uint8_t> ends;
  for (std::size_t i = 0; i < central.size(); ++i) {
    if (children.isTerminal(i)) ends.insert(central[i].segment);
  }
  for (const Segment& segment : segments()) EXPECT_TRUE(ends.contains(segment.number));
}

TEST(Organs, AirwaysGrowWithTheOrgan) {
  const LungModel whole = openOrgan("thorax");
  const LungModel eighth = openOrgan("thorax", {.sizeMl = 6388.5 / 8.0});
  const AirwayTree& own = *whole.central;
  const AirwayTree& half = *eighth.central;
  ASSERT_EQ(own.size(), half.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_NEAR((own[i].distal - 2.0 * half[i].distal).norm(), 0.0, 1e-6) << i;
    EXPECT_NEAR(own[i].radiusMm, 2.0 * half[i].radiusMm, 1e-6) << i;
  }
}

TEST(Organs, TakeATableOfTheirOwn) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "steeper.json";
  PredefinedAirways table = thoraxAirways();
  table.bifurcations[0].a.lengthToDiameter = 2.0;
  std::ofstream(path) << airwayTableText(table);
  const LungModel model = openOrgan("thorax", {.airwayTable = path});
  const Branch& rightMain = (*model.central)[1];
  EXPECT_NEAR(lengthMm(rightMain), 2.0 * 2.0 * rightMain.radiusMm, 1e-6);
  ASSERT_EQ(model.inputs.size(), 1U);
  EXPECT_EQ(model.inputs[0].path, path.string());
  std::filesystem::remove(path);
}

TEST(Organs, RefuseWhatCannotBe) {
  EXPECT_THROW(openOrgan("spleen"), InvalidOption);
  EXPECT_THROW(openOrgan("simple", {.sizeMl = -1.0}), InvalidOption);
  EXPECT_THROW(openOrgan("simple", {.sizeMl = std::nan("")}), InvalidOption);
  EXPECT_THROW(openOrgan("simple", {.sizeMl = 1e9}), InvalidOption);
  EXPECT_THROW(openOrgan("simple", {.sizeMl = 0.5}), InvalidInput);
  EXPECT_THROW(openOrgan("right-lung", {.sizeMl = 0.0, .airwayTable = "x.json"}), InvalidOption);
  EXPECT_THROW(openOrgan("thorax", {.sizeMl = 0.0, .airwayTable = "missing.json"}), InputMissing);
}

}  // namespace
}  // namespace pneuma
