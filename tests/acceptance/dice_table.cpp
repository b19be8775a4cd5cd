#include "acceptance/dice_table.h"

#include <cstdio>

#include "support/lobe_dice.h"

namespace pneuma::testing {

void DiceTable::add(const std::string& way, const std::map<Lobe, double>& dice) {
  if (!trials_.contains(way)) ways_.push_back(way);
  for (const auto& [lobe, value] : dice) trials_[way][lobe].push_back(value);
}

double DiceTable::median(const std::string& way, Lobe lobe) const {
  return quantile(trials_.at(way).at(lobe), 0.5);
}

double DiceTable::tenthPercentile(const std::string& way, Lobe lobe) const {
  return quantile(trials_.at(way).at(lobe), 0.1);
}

double DiceTable::worst(const std::string& way, Lobe lobe) const {
  return quantile(trials_.at(way).at(lobe), 0.0);
}

void DiceTable::print(const std::string& title) const {
  std::printf("%s: median (10th percentile, worst)\n%-32s", title.c_str(), "");
  for (const Lobe lobe : FiveLobes) std::printf(" %-20s", std::string(shortName(lobe)).c_str());
  for (const std::string& way : ways_) {
    std::printf("\n%-32s", way.c_str());
    for (const Lobe lobe : FiveLobes) {
      std::printf(" %.3f (%.3f, %.3f)", median(way, lobe), tenthPercentile(way, lobe),
                  worst(way, lobe));
    }
  }
  std::printf("\n");
}

}  // namespace pneuma::testing
