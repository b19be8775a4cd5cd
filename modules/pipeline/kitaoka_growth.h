#pragma once

#include <map>
#include <string>

#include "core/progress.h"
#include "pipeline/kitaoka_tables.h"

namespace pneuma {

/// A grown tree of the paper with all that is published of trees, by the names of the quantities.
struct KitaokaGrowth {
  LungModel model;  ///< the tree is its `opened`
  std::map<std::string, double> figures;
};

/// Grows one tree of the paper and measures it. Means and deviations of terminals (generation,
/// diameter, acinus) are over those that did not fail; the acinus is nine tenths of what a terminal
/// supplies, the parenchyma's share. @throws Cancelled
KitaokaGrowth growCase(const KitaokaCase& grown, const Progress& progress = {});

}  // namespace pneuma
