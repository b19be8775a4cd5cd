#pragma once

#include <string>

#include "io/json.h"
#include "pipeline/figure_table.h"

// How figures of a case's report are written on its pages; unknown ones are left blank.
namespace pneuma {

inline std::string caseNumber(const Json& value, int decimals, const char* unit = "") {
  return value.is_number() ? fixed(value.get<double>(), decimals) + unit : std::string();
}

inline std::string casePercent(const Json& share) {
  return share.is_number() ? fixed(100.0 * share.get<double>(), 1) + " %" : std::string();
}

}  // namespace pneuma
