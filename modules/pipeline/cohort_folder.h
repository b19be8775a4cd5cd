#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "io/json.h"
#include "pipeline/cohort_cases.h"

namespace pneuma {

/// What a workflow is written for.
struct CohortWorkflow {
  Cohort cohort;
  std::string program = "pneuma";  ///< as a shell calls it
  std::string again;               ///< the command that writes all of it once more
};

/// The cases with the options of every command ("pneuma/cohort/1",
/// resources/schemas/cohort.schema.json).
Json toJson(const Cohort& cohort);

/// What writeCohort() left as it was.
struct WrittenCohort {
  std::vector<std::string> files;  ///< relative to the folder
  std::vector<std::string> kept;   ///< files for people to edit that were there already
};

/// Writes a Snakemake workflow with everything it needs into a folder, which is made if it is not
/// there. Results that are there stay. With Existing::Replace the workflow is written anew, but for
/// config.yaml and the profiles, which people edit.
/// @throws OutputFailed: nothing was changed
WrittenCohort writeCohort(const std::filesystem::path& folder, const CohortWorkflow& workflow,
                          Existing existing);

}  // namespace pneuma
