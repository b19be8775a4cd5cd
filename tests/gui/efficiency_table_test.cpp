#include "document/efficiency_table.h"

#include <QStringList>
#include <algorithm>

#include <gtest/gtest.h>

#include "sample_snapshot.h"

namespace pneuma {
namespace {

Snapshot grownSnapshot() {
  auto growth = std::make_shared<Growth>();
  growth->options = KitaokaOptions{};
  growth->result.tree = testing::threeBranches();
  growth->result.figures = {
      {"rescued_turned", 1200.0}, {"inlets", 7.0}, {"rescued_shortened", 34.0}};
  growth->result.warnings = {"one", "two"};
  Efficiency& e = growth->efficiency;
  e.branches = 54611;
  e.failed = 14;
  e.qf = 0.018;
  e.ca = 0.36;
  e.paper.vr = 0.027;
  e.paper.cn = 0.18;
  e.paper.el = 0.011;
  e.paper.pi = 0.596;
  e.today.vr = 0.05;
  e.today.el = 0.112;
  LungModel model = testing::twoLobes();
  model.growth = growth;
  return snapshotOf(model, QStringLiteral("test"));
}

const EfficiencyRow& rowOf(const EfficiencyTable& table, const char* name) {
  return *std::find_if(table.rows.begin(), table.rows.end(),
                       [&](const EfficiencyRow& row) { return row.name == QLatin1String(name); });
}

TEST(EfficiencyTable, IsEmptyWhereNothingWasGrown) {
  EXPECT_TRUE(efficiencyTable(testing::lobesAndTree()).rows.empty());
}

TEST(EfficiencyTable, HasTheSevenFunctionsInThePapersOrder) {
  const EfficiencyTable table = efficiencyTable(grownSnapshot());
  QStringList names;
  for (const EfficiencyRow& row : table.rows) {
    names << row.name;
    EXPECT_TRUE(row.meaning.endsWith(QLatin1Char('.'))) << row.name.toStdString();
  }
  EXPECT_EQ(names.join(QLatin1Char(' ')), QStringLiteral("N_T Q_f C_n C_a V_r EL PI"));
}

TEST(EfficiencyTable, ShowsBothDefinitionsAndADashForTheUnknown) {
  const EfficiencyTable table = efficiencyTable(grownSnapshot());
  EXPECT_EQ(rowOf(table, "N_T").paper, "54,611");
  EXPECT_EQ(rowOf(table, "Q_f").paper, "0.0180");
  EXPECT_EQ(rowOf(table, "Q_f").today, "0.0180");
  EXPECT_EQ(rowOf(table, "C_a").paper, "0.360");
  EXPECT_EQ(rowOf(table, "C_n").paper, "0.180");
  EXPECT_EQ(rowOf(table, "C_n").today, "-");
  EXPECT_EQ(rowOf(table, "V_r").paper, "0.0270");
  EXPECT_EQ(rowOf(table, "V_r").today, "0.0500");
  EXPECT_EQ(rowOf(table, "EL").today, "0.1120");
  EXPECT_EQ(rowOf(table, "PI").paper, "0.596");
}

TEST(EfficiencyTable, CountsFailuresRescuesAndWarnings) {
  EXPECT_EQ(efficiencyTable(grownSnapshot()).note, "14 failed, 1,234 rescues, 2 warnings");
}

}  // namespace
}  // namespace pneuma
