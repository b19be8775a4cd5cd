#pragma once

#include <string>
#include <vector>

#include "io/json.h"

namespace pneuma {

/// A picture of a report.
struct PagePicture {
  std::string caption;
  std::string png;  ///< the file's content
};

/// The report of a case as one HTML file that needs nothing beside it: no script, no link to
/// anywhere, pictures within. It prints on one or two sheets of A4.
/// @param report by caseReport()
std::string casePage(const Json& report, const std::vector<PagePicture>& pictures);

}  // namespace pneuma
