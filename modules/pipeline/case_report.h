#pragma once

#include <cstdint>

#include "core/progress.h"
#include "io/json.h"
#include "pipeline/project.h"

namespace pneuma {

struct CaseReportOptions {
  bool identify = false;   ///< names and paths of the case's files too; hashes alone without
  std::uint64_t seed = 1;  ///< of the random points that the airways' gap is measured with
};

/// Numbers the files of a report, so that hashes say which they were without telling whose: "file
/// 1" in place of their paths, and of their names in warnings.
void hideFileNames(Json& report);

/// Everything that is known of a person's lungs on one page ("pneuma/case/1",
/// resources/schemas/case.schema.json): volumes, checks with their limits, the airways' morphometry
/// beside published bands, the breath, what was done as a paragraph for a paper with its
/// references, options, versions, hashes.
/// @param project as it was read, or made from a model
/// @throws InvalidInput if it holds neither surfaces nor lungs nor airways; as measureTree() and
/// breathe()
Json caseReport(const Project& project, const CaseReportOptions& options = {},
                const Progress& progress = {});

}  // namespace pneuma
