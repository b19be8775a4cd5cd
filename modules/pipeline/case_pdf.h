#pragma once

#include <string>
#include <vector>

#include "io/json.h"
#include "pipeline/case_page.h"

namespace pneuma {

/// The report of a case as a PDF of A4, one page for most: what casePage() shows, but for the
/// sources of published bands and the options, which are in the HTML and JSON forms.
/// @param report by caseReport()
/// @throws Error if the PDF cannot be made
std::string casePdf(const Json& report, const std::vector<PagePicture>& pictures);

}  // namespace pneuma
