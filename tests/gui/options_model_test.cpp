#include "document/options_model.h"

#include <QSignalSpy>

#include <gtest/gtest.h>

#include "growth/centroid_splitting.h"

namespace pneuma {
namespace {

QModelIndex valueOf(const OptionsModel& model, std::string_view name) {
  return model.index(*model.rowOf(name), OptionsModel::ValueColumn);
}

TEST(OptionsModel, HasARowForEveryField) {
  OptionsModel model;
  model.bind(CentroidSplittingOptions{});
  int fields = 0;
  forEachField<CentroidSplittingOptions>([&](const auto& field) {
    ASSERT_TRUE(model.rowOf(field.name).has_value());
    ++fields;
  });
  EXPECT_EQ(model.rowCount(), fields);
}

TEST(OptionsModel, ShowsValueUnitRangeAndHelp) {
  OptionsModel model;
  model.bind(CentroidSplittingOptions{});
  const int row = *model.rowOf("min-angle");
  const auto text = [&](int column) {
    return model.data(model.index(row, column), Qt::DisplayRole).toString();
  };
  EXPECT_EQ(text(OptionsModel::ValueColumn), "20");
  EXPECT_EQ(text(OptionsModel::UnitColumn), "deg");
  EXPECT_EQ(text(OptionsModel::RangeColumn), "0 to 90");
  EXPECT_FALSE(text(OptionsModel::HelpColumn).isEmpty());
}

TEST(OptionsModel, AnEditReachesTheOptions) {
  OptionsModel model;
  model.bind(CentroidSplittingOptions{});
  QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
  EXPECT_TRUE(model.setData(valueOf(model, "ratio"), "0.35", Qt::EditRole));
  EXPECT_TRUE(model.setData(valueOf(model, "terminals"), "3000", Qt::EditRole));
  EXPECT_TRUE(model.setData(valueOf(model, "containment"), "ends", Qt::EditRole));
  const auto options = model.options<CentroidSplittingOptions>();
  EXPECT_DOUBLE_EQ(options.ratio, 0.35);
  EXPECT_EQ(options.terminals, 3000U);
  EXPECT_EQ(options.containment, Containment::Ends);
  EXPECT_EQ(changed.count(), 3);
}

TEST(OptionsModel, AValueOutOfRangeIsRefusedWithTheRange) {
  OptionsModel model;
  model.bind(CentroidSplittingOptions{});
  QSignalSpy refused(&model, &OptionsModel::refused);
  EXPECT_FALSE(model.setData(valueOf(model, "ratio"), "7", Qt::EditRole));
  ASSERT_EQ(refused.count(), 1);
  EXPECT_TRUE(refused.at(0).at(0).toString().contains("ratio"));
  EXPECT_EQ(model.options<CentroidSplittingOptions>(), CentroidSplittingOptions{});
}

TEST(OptionsModel, OnlyValuesCanBeEdited) {
  OptionsModel model;
  model.bind(CentroidSplittingOptions{});
  EXPECT_TRUE(model.flags(valueOf(model, "seed")).testFlag(Qt::ItemIsEditable));
  EXPECT_FALSE(model.flags(model.index(0, OptionsModel::HelpColumn)).testFlag(Qt::ItemIsEditable));
  EXPECT_FALSE(model.setData(model.index(0, OptionsModel::NameColumn), "x", Qt::EditRole));
}

}  // namespace
}  // namespace pneuma
