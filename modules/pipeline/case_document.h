#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/json.h"
#include "pipeline/case_page.h"

namespace pneuma {

/// Throws now what caseDocument() would for the extension. @throws Unsupported
void requireCaseDocumentName(const std::filesystem::path& path);

/// True if the report at `path` would have pictures: all but .json.
bool hasPictures(const std::filesystem::path& path);

/// The report of a case as a file's content: HTML, PDF or JSON by the extension.
/// @param report by caseReport()
/// @throws Unsupported for another extension; as casePdf()
std::string caseDocument(const std::filesystem::path& path, const Json& report,
                         const std::vector<PagePicture>& pictures);

}  // namespace pneuma
