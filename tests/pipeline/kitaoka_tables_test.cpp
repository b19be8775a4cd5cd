#include "pipeline/kitaoka_tables.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "pipeline/kitaoka_growth.h"

namespace pneuma {
namespace {

/// The paper prints three decimals, Table 3 and the thorax' parts two.
constexpr double Rounding = 0.0151;

TEST(KitaokaTables, HaveThePapersRows) {
  const std::vector<KitaokaTable> tables = kitaokaTables();
  ASSERT_EQ(tables.size(), 7U);
  const std::vector<std::size_t> rows = {11, 4, 5, 4, 3};
  std::vector<KitaokaCase> cases;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(tables[i].rows.size(), rows[i]) << tables[i].name;
    for (const KitaokaRow& row : tables[i].rows) {
      if (std::ranges::find(cases, row.grown) == cases.end()) cases.push_back(row.grown);
    }
  }
  EXPECT_EQ(cases.size(), 23U);
}

// The paper's PI is the plain sum of the other five: every digit that was typed in is checked.
TEST(KitaokaTables, PublishedPerformanceIndexIsTheSumOfItsParts) {
  int checked = 0;
  for (const KitaokaTable& table : kitaokaTables()) {
    for (const KitaokaRow& row : table.rows) {
      std::map<std::string_view, double> published;
      for (const KitaokaFigure& figure : row.figures) published[figure.quantity] = figure.published;
      if (!published.contains("PI") || !published.contains("C_n")) continue;
      const double sum = published["Q_f"] + published["C_n"] + published["C_a"] + published["V_r"] +
                         published["EL"];
      EXPECT_NEAR(published["PI"], sum, Rounding) << table.name << ", " << row.name;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 28);
}

TEST(KitaokaTables, TheModelWithAllRulesIsHeldToTheSameEverywhere) {
  std::vector<std::vector<KitaokaFigure>> found;
  for (const KitaokaTable& table : kitaokaTables()) {
    if (table.id == "claims") continue;
    for (const KitaokaRow& row : table.rows) {
      if (row.grown == KitaokaCase{}) found.push_back(row.figures);
    }
  }
  ASSERT_EQ(found.size(), 5U);
  for (const auto& figures : found) {
    for (std::size_t i = 0; i < 7; ++i) {
      EXPECT_EQ(figures[i].quantity, found[0][i].quantity);
      EXPECT_EQ(figures[i].published, found[0][i].published);
      EXPECT_EQ(figures[i].limit.most, found[0][i].limit.most);
    }
  }
}

TEST(KitaokaTables, WhatIsNotJudgedSaysWhy) {
  for (const KitaokaTable& table : kitaokaTables()) {
    for (const KitaokaRow& row : table.rows) {
      for (const KitaokaFigure& figure : row.figures) {
        EXPECT_TRUE(figure.limit.of != Limit::Of::Nothing || !figure.note.empty())
            << figure.quantity;
      }
    }
  }
}

KitaokaCase fewBranches() {
  KitaokaCase grown;
  grown.options.flowThreshold = 0.3;
  return grown;
}

// Two divisions into about equal halves end at a threshold of 0.3: seven branches, four acini of a
// quarter of the organ each.
TEST(KitaokaGrowth, MeasuresATreeThatCanBeCountedByHand) {
  const KitaokaGrowth growth = growCase(fewBranches());
  EXPECT_EQ(growth.figures.at("N"), 7.0);
  EXPECT_EQ(growth.figures.at("T"), 4.0);
  EXPECT_EQ(growth.figures.at("failed"), 0.0);
  EXPECT_EQ(growth.figures.at("generation"), 2.0);
  EXPECT_EQ(growth.figures.at("generation_sd"), 0.0);
  EXPECT_EQ(growth.figures.at("generation_max"), 2.0);
  EXPECT_NEAR(growth.figures.at("lung_volume_ml"), 3000.0 * std::numbers::pi, 1e-6);
  EXPECT_NEAR(growth.figures.at("acinus_ml"), 0.9 * 3000.0 * std::numbers::pi / 4.0, 1e-6);
  EXPECT_NEAR(growth.figures.at("terminal_diameter_mm"), 18.0 * std::pow(0.25, 1.0 / 2.8), 0.2);
  EXPECT_EQ(growth.model.opened->size(), 7U);
}

TEST(KitaokaGrowth, TurnsAndLengthensTheTrunk) {
  KitaokaCase grown = fewBranches();
  grown.trunkTurnLeftDeg = 5.0;
  grown.trunkLength = 1.1;
  const Branch left = (*growCase(grown).model.opened)[0];
  EXPECT_NEAR(lengthMm(left), 82.5, 1e-9);
  EXPECT_NEAR(left.distal.x(), 82.5 * std::sin(radians(5.0)), 1e-9);
  EXPECT_NEAR(left.distal.y(), 0.0, 1e-9);
  grown.trunkTurnLeftDeg = 0.0;
  grown.trunkTurnBackDeg = 5.0;
  grown.trunkLength = 1.0;
  const Branch back = (*growCase(grown).model.opened)[0];
  EXPECT_NEAR(back.distal.y(), 75.0 * std::sin(radians(5.0)), 1e-9);
  EXPECT_NEAR(back.distal.x(), 0.0, 1e-9);
}

TEST(KitaokaGrowth, CountsWhatRule6aCorrected) {
  KitaokaCase grown;
  grown.options.flowThreshold = 1e-3;
  const auto figures = growCase(grown).figures;
  EXPECT_GT(figures.at("corrected_by_6a"), figures.at("dividing_corrected_by_6a"));
  EXPECT_GT(figures.at("dividing_corrected_by_6a"), 0.0);
  EXPECT_LT(figures.at("corrected_by_6a_below_18_deg"), 1.0);
  grown.options.rule6a = Switch::Off;
  EXPECT_EQ(growCase(grown).figures.at("corrected_by_6a"), 0.0);
}

}  // namespace
}  // namespace pneuma
