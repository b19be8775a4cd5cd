#pragma once

#include <string_view>

namespace pneuma::detail {

// The files below resources/workflows/cohort.
extern const std::string_view CohortSnakefile;
extern const std::string_view CohortConfig;
extern const std::string_view CohortReadme;
extern const std::string_view CohortStage;
extern const std::string_view CohortGather;
extern const std::string_view CohortTable;
extern const std::string_view CohortPlots;
extern const std::string_view CohortPage;
extern const std::string_view CohortLocalProfile;
extern const std::string_view CohortSlurmProfile;
extern const std::string_view CohortSlurmStatus;
extern const std::string_view CohortSlurmResume;

}  // namespace pneuma::detail
