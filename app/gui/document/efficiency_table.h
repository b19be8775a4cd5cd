#pragma once

#include <QString>
#include <vector>

#include "document/snapshot.h"

namespace pneuma {

/// One efficiency function of a grown tree (anatomy/efficiency.h) as people read it.
struct EfficiencyRow {
  QString symbol;   ///< rich text: "Q<sub>f</sub>"
  QString name;     ///< plain: "Q_f"
  QString paper;    ///< value by the paper's definition
  QString today;    ///< value by today's definition; the same where there is one only
  QString meaning;  ///< one sentence
};

/// The efficiency functions of the tree that is shown.
struct EfficiencyTable {
  std::vector<EfficiencyRow> rows;  ///< empty if nothing was grown
  QString paperMeaning;             ///< what "paper" stands for
  QString todayMeaning;
  QString note;  ///< failed terminals, rescues and warnings
};

EfficiencyTable efficiencyTable(const Snapshot& snapshot);

}  // namespace pneuma
