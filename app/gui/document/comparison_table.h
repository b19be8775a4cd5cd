#pragma once

#include <QString>
#include <QStringList>
#include <vector>

#include "pipeline/compare_methods.h"

namespace pneuma {

/// One figure of the compared trees as people read it.
struct ComparisonLine {
  QString label;
  QStringList values;           ///< one for each tree
  std::vector<BandSide> sides;  ///< likewise
  QString published;            ///< the band; empty if there is none
  QString source;
};

/// Short times to a hundredth of a second: "0.04 s", "12.3 s"
QString secondsText(double seconds);

/// Which figures a table has.
enum class ComparisonFigures { Main, All };

/// The figures of compared trees: what the growth told, then what was measured.
std::vector<ComparisonLine> comparisonLines(const MethodComparison& comparison,
                                            ComparisonFigures figures);

}  // namespace pneuma
