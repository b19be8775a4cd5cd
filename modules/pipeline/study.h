#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "anatomy/summary.h"
#include "core/progress.h"
#include "io/json.h"
#include "pipeline/variation.h"

namespace pneuma {

/// One grown individual of a study. What is not known of it is left out of `figures`.
struct StudyRow {
  std::uint64_t seed = 0;
  std::vector<std::pair<std::string, double>> figures;  ///< name, value; in report order
};

/// A quantity of a study over all individuals that have it.
struct StudyQuantity {
  std::string name;
  Summary summary;
};

/// The same growth with many seeds: how much trees of one kind differ from each other.
struct Study {
  GrowthOptions options;  ///< their seed was not used
  VariationOptions variation;
  std::vector<StudyRow> rows;  ///< in the order of the seeds
  std::vector<StudyQuantity> quantities;
  std::vector<std::string> warnings;
};

/// Grows one tree for every seed and keeps its figures: N (branches), T (terminals), failed, Q_f,
/// C_n, C_a, V_r, EL and PI by the paper's and, with "_today" behind the name, by today's
/// definitions (anatomy/efficiency.h), terminals' mean generation, diameter and path from the
/// trachea, and what the method itself reports. Seeds are grown side by side as far as cores and
/// memory allow; the result does not depend on it.
/// @throws InvalidOption unless there are 1 to 10,000 seeds; what varied() and grow() throw
Study study(const LungModel& model, const GrowthOptions& options, const VariationOptions& variation,
            const std::vector<std::uint64_t>& seeds, const Progress& progress = {});

/// "pneuma/study/1" (resources/schemas/study.schema.json).
Json toJson(const Study& study, const LungModel& model);

/// Tables for people: one line per seed, then mean and standard deviation of every quantity.
std::string studyText(const Study& study);

/// "seed,N,T,...", one line per seed; empty fields are not known.
std::string studyCsv(const Study& study);

}  // namespace pneuma
