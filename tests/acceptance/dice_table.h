#pragma once

#include <map>
#include <string>
#include <vector>

#include "anatomy/lobe.h"

namespace pneuma::testing {

/// Dice of the five lobes in many trials of each way to find fissures, printed when a test is done.
class DiceTable {
 public:
  void add(const std::string& way, const std::map<Lobe, double>& dice);

  double median(const std::string& way, Lobe lobe) const;
  double tenthPercentile(const std::string& way, Lobe lobe) const;
  double worst(const std::string& way, Lobe lobe) const;

  /// Per way the medians, in brackets the least.
  void print(const std::string& title) const;

 private:
  std::vector<std::string> ways_;
  std::map<std::string, std::map<Lobe, std::vector<double>>> trials_;
};

}  // namespace pneuma::testing
