#include "document/property_sheet.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "sample_snapshot.h"

namespace pneuma {
namespace {

QString valueOf(const PropertySheet& sheet, const char* label) {
  for (const PropertyRow& row : sheet.rows) {
    if (row.label == QLatin1String(label)) return row.value;
  }
  return QStringLiteral("(no such row)");
}

TEST(PropertySheet, ABranchSaysItsNumbers) {
  const PropertySheet sheet = branchSheet(testing::lobesAndTree(), 1);
  EXPECT_EQ(sheet.headline, "10.00 mm");
  EXPECT_EQ(valueOf(sheet, "Region"), "Right upper lobe");
  EXPECT_EQ(valueOf(sheet, "Generation"), "1");
  EXPECT_EQ(valueOf(sheet, "Horsfield order"), "1");
  EXPECT_EQ(valueOf(sheet, "Strahler order"), "1");
  EXPECT_EQ(valueOf(sheet, "Length"), "50.00 mm");
  EXPECT_EQ(valueOf(sheet, "Length / diameter"), "5.00");
  EXPECT_EQ(valueOf(sheet, "Angle to mother"), "90.0 deg");
  EXPECT_EQ(valueOf(sheet, "Flow share"), "50.000 %");
  EXPECT_EQ(valueOf(sheet, "Path from trachea"), "150.0 mm");
}

TEST(PropertySheet, ATerminalSaysWhyItEnded) {
  LungModel model = testing::twoLobes();
  AirwayTree tree = testing::threeBranches();
  tree.setEnding(1, Ending::Ratio);
  tree.setEnding(2, Ending::Flow);
  model.opened = std::make_shared<const AirwayTree>(tree);
  const Snapshot snapshot = snapshotOf(model, {});
  EXPECT_EQ(valueOf(branchSheet(snapshot, 0), "Ended"), "(no such row)");
  EXPECT_EQ(valueOf(branchSheet(snapshot, 1), "Ended"), "could not be divided");
  EXPECT_EQ(branchSheet(snapshot, 1).rows.back().kind, PropertyRow::Kind::Look);
  EXPECT_EQ(valueOf(branchSheet(snapshot, 2), "Ended"), "small enough");
}

TEST(PropertySheet, TheRootHasNoAngle) {
  const PropertySheet sheet = branchSheet(testing::lobesAndTree(), 0);
  EXPECT_EQ(valueOf(sheet, "Angle to mother"), "(no such row)");
  EXPECT_EQ(valueOf(sheet, "Strahler order"), "2");
}

TEST(PropertySheet, ALobeSaysItsVolumeShareAndBranches) {
  const PropertySheet sheet = surfaceSheet(testing::lobesAndTree(), 1);
  EXPECT_EQ(sheet.title, "Right upper lobe");
  EXPECT_EQ(sheet.headline, "300 mL");
  EXPECT_EQ(sheet.note, "75.0 % of lungs");
  EXPECT_EQ(valueOf(sheet, "Branches"), "1");
}

TEST(PropertySheet, AnOpenSurfaceIsMarkedToBeLookedAt) {
  LungModel model;
  LobeSurface open = testing::surfaceOf(Lobe::RightUpper, 0.0);
  open.health.closed = false;
  model.surfaces = std::make_shared<const std::vector<LobeSurface>>(std::vector{open});
  const PropertySheet sheet = surfaceSheet(snapshotOf(model, {}), 0);
  const auto row = std::find_if(sheet.rows.begin(), sheet.rows.end(), [](const PropertyRow& r) {
    return r.label == QLatin1String("Closed and manifold");
  });
  ASSERT_NE(row, sheet.rows.end());
  EXPECT_EQ(row->kind, PropertyRow::Kind::Look);
}

TEST(PropertySheet, OneLungIsTheSumOfItsLobes) {
  const Snapshot snapshot = testing::lobesAndTree();
  EXPECT_EQ(lungsSheet(snapshot, Side::None).headline, "400 mL");
  EXPECT_EQ(lungsSheet(snapshot, Side::Left).headline, "100 mL");
  EXPECT_EQ(lungsSheet(snapshot, Side::Left).note, "25.0 % of lungs");
}

TEST(PropertySheet, TheTreeSaysHowManyBranchesLeaveTheirLobe) {
  Growth growth;
  growth.options = growthMethods().front().defaults;
  growth.result.tree = testing::threeBranches();
  growth.outside = {1, 2};
  LungModel model = testing::twoLobes();
  model.growth = std::make_shared<const Growth>(growth);
  const Snapshot snapshot = snapshotOf(model, {});
  const PropertySheet sheet = treeSheet(snapshot);
  EXPECT_EQ(sheet.headline, "3");
  int toLookAt = 0;
  for (const PropertyRow& row : sheet.rows) toLookAt += row.kind == PropertyRow::Kind::Look ? 1 : 0;
  EXPECT_EQ(toLookAt, 2);
  EXPECT_EQ(warningsOf(snapshot).size(), 1U);
}

TEST(PropertySheet, FoundLungsSayTheirVolumesAndWhatToLookAt) {
  LungSegmentation lungs;
  lungs.right.volumeMl = 1966.4;
  lungs.left.volumeMl = 1745.2;
  lungs.checks = {
      {"LUNG-RATIO", "right lung to left", 1.13, 0.8, 1.6, "", "look"},
      {"LUNG-L-BORDER", "surface of the left lung at the border", 12.34, 0.0, 2.0, "cm2", "look"}};
  LungModel model;
  EXPECT_TRUE(foundLungsSheet(snapshotOf(model, {})).rows.empty());
  model.lungs = std::make_shared<const LungSegmentation>(lungs);
  const Snapshot snapshot = snapshotOf(model, {});
  const PropertySheet sheet = foundLungsSheet(snapshot);
  EXPECT_EQ(sheet.headline, "3,712 mL");
  EXPECT_EQ(valueOf(sheet, "Right lung"), "1,966 mL");
  EXPECT_EQ(valueOf(sheet, "Right to left"), "1.13");
  EXPECT_EQ(valueOf(sheet, "Airways"), "not found");
  EXPECT_EQ(valueOf(sheet, "Surface of the left lung at the border"), "12.3 cm²");
  EXPECT_EQ(sheet.rows.back().label, "1 of 2 checks passed");
  EXPECT_EQ(sheet.rows.back().kind, PropertyRow::Kind::Look);
}

}  // namespace
}  // namespace pneuma
