#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "pipeline/recipe.h"

namespace pneuma {

/// One patient of a cohort, or one scan of a patient.
struct CohortCase {
  std::string name;          ///< of its folder among the results
  std::filesystem::path ct;  ///< absolute
  Recipe recipe;             ///< with the case's own series and fissures
  std::vector<std::pair<std::string, std::string>> columns;  ///< further ones, as they were given
};

struct Cohort {
  std::vector<CohortCase> cases;
  std::vector<std::string> methods;  ///< of the cases' recipes, in the order of the cases
  std::vector<std::string> notes;    ///< whole sentences: what was passed over or is ignored
};

/// Where the cases of a cohort stand.
struct CohortSource {
  std::filesystem::path cases;   ///< a table (.csv), or a folder of CTs
  std::filesystem::path recipe;  ///< of all cases that have none of their own; empty: the defaults
  bool namesOfFolders = false;   ///< cases of a folder are named as its entries, not by numbers
};

/// Reads the list of cases and every recipe, fissure file and file of corrections that it names. A
/// table has a column "ct" (or "path") and may have "case", "series", "fissures" and "recipe";
/// further columns go on into the table of results. Paths are relative to the table. Of a folder,
/// every entry that is a CT is a case: case-001, case-002, ...; volumes of 8 bits are labels. Lobes
/// are split and trees are grown also where a recipe says nothing of them.
/// @throws InputMissing, InvalidInput, InvalidOption: what is wrong with the table as a whole, or
/// with up to five of its lines: a path that does not exist, a name that is there twice or that no
/// folder can have, a recipe that cannot be
Cohort readCohort(const CohortSource& source, const Progress& progress = {});

}  // namespace pneuma
