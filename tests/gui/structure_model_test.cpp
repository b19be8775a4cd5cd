#include "document/structure_model.h"

#include <QSignalSpy>

#include <gtest/gtest.h>

#include "sample_snapshot.h"

namespace pneuma {
namespace {

QStringList namesIn(const StructureModel& model) {
  QStringList names;
  for (int i = 0; i < model.rowCount(); ++i) names << model.structure(i).name;
  return names;
}

void setEye(StructureModel& model, int row, bool open) {
  model.setData(model.index(row), open ? Qt::Checked : Qt::Unchecked, Qt::CheckStateRole);
}

TEST(StructureModel, IsEmptyWithoutAModel) {
  StructureModel model;
  model.show(Snapshot{});
  EXPECT_EQ(model.rowCount(), 0);
  EXPECT_FALSE(model.rowOfAirways().has_value());
}

TEST(StructureModel, ListsRightBeforeLeftWithVolumes) {
  StructureModel model;
  model.show(testing::lobesAndTree());
  EXPECT_EQ(namesIn(model), QStringList({"Lungs", "Right lung", "Upper lobe", "Left lung",
                                         "Lower lobe", "Airways"}));
  EXPECT_EQ(model.structure(0).value, "400 mL");
  EXPECT_EQ(model.structure(1).value, "300 mL");
  EXPECT_EQ(model.structure(2).surface, 1U);
  EXPECT_EQ(model.structure(5).value, "3 branches");
}

TEST(StructureModel, ALungThatIsNotSplitIsNamedOnce) {
  LungModel model;
  model.surfaces = std::make_shared<const std::vector<LobeSurface>>(std::vector{
      testing::surfaceOf(Lobe::RightLung, 300.0), testing::surfaceOf(Lobe::LeftLung, 100.0)});
  StructureModel structures;
  structures.show(snapshotOf(model, {}));
  EXPECT_EQ(namesIn(structures), QStringList({"Lungs", "Right lung", "Left lung"}));
  EXPECT_EQ(structures.structure(1).depth, 1);
}

TEST(StructureModel, AParentMakesItsLobesDenserAndTheNextSnapshotKeepsIt) {
  StructureModel model;
  model.show(testing::lobesAndTree());
  QSignalSpy changed(&model, &StructureModel::visibilityChanged);
  EXPECT_TRUE(model.setData(model.index(1), 2.0, StructureModel::DensityRole));
  EXPECT_EQ(model.structure(2).density, 2.0);
  EXPECT_EQ(model.structure(4).density, 1.0);
  EXPECT_EQ(changed.count(), 1);
  // A parent tells what all below it have.
  EXPECT_EQ(model.data(model.index(1), StructureModel::DensityRole).toDouble(), 2.0);
  EXPECT_EQ(model.data(model.index(0), StructureModel::DensityRole).toDouble(), 1.0);
  EXPECT_FALSE(model.setData(model.index(2), 3.0, StructureModel::DensityRole));
  EXPECT_FALSE(model.setData(model.index(5), 2.0, StructureModel::DensityRole));
  model.show(testing::lobesAndTree());
  EXPECT_EQ(model.structure(2).density, 2.0);
  EXPECT_EQ(model.structure(4).density, 1.0);
}

TEST(StructureModel, AParentsEyeShutsAndOpensItsLobes) {
  StructureModel model;
  model.show(testing::lobesAndTree());
  QSignalSpy changed(&model, &StructureModel::visibilityChanged);
  setEye(model, 0, false);
  EXPECT_FALSE(model.structure(2).visible);
  EXPECT_FALSE(model.structure(4).visible);
  EXPECT_TRUE(model.structure(5).visible);
  setEye(model, 4, true);
  EXPECT_TRUE(model.structure(3).visible);
  EXPECT_TRUE(model.structure(0).visible);
  EXPECT_FALSE(model.structure(2).visible);
  EXPECT_EQ(changed.count(), 2);
}

TEST(StructureModel, EyesStayAsTheyWereInTheNextSnapshot) {
  StructureModel model;
  model.show(testing::lobesAndTree());
  setEye(model, 2, false);
  model.show(snapshotOf(testing::twoLobes(), {}));
  EXPECT_FALSE(model.structure(*model.rowOfSurface(1)).visible);
  EXPECT_TRUE(model.structure(*model.rowOfSurface(0)).visible);
}

}  // namespace
}  // namespace pneuma
