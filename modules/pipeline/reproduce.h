#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// What a measured figure is held to beside the published one.
struct Limit {
  enum class Of {
    Relative,    ///< |measured / published - 1|
    Difference,  ///< |measured - published|
    Range,       ///< measured between `low` and `high`
    Nothing,     ///< shown, not judged
  };

  Of of = Of::Nothing;
  double most = 0.0;  ///< of what `of` says
  double low = 0.0;
  double high = 0.0;

  static Limit relative(double share) { return {Of::Relative, share, 0.0, 0.0}; }

  static Limit difference(double most) { return {Of::Difference, most, 0.0, 0.0}; }

  static Limit range(double low, double high) { return {Of::Range, 0.0, low, high}; }

  bool holds(double published, double measured) const;
};

/// Of a figure that the paper does not print: ours is held to what it must be.
inline constexpr double NotPublished = std::numeric_limits<double>::quiet_NaN();

/// Of a figure that cannot be measured again.
inline constexpr double NotMeasured = std::numeric_limits<double>::quiet_NaN();

/// One figure of a paper beside ours.
struct ReproducedRow {
  std::string row;         ///< as in the paper's table, for example "0.41"
  std::string quantity;    ///< for example "terminals"
  double published = 0.0;  ///< or NotPublished, with a limit of Range or Nothing
  double measured = 0.0;   ///< or NotMeasured, with the limit Nothing and a note
  Limit limit;
  std::string note;  ///< why the limit is wide, or what the paper says in words; may be empty
  std::optional<double> sd = std::nullopt;  ///< of what `measured` is the mean of

  /// measured / published - 1; 0 if the published figure is 0
  double relative() const { return published != 0.0 ? measured / published - 1.0 : 0.0; }

  bool isPublished() const { return !std::isnan(published); }

  bool ok() const { return limit.holds(published, measured); }
};

struct ReproducedTable {
  std::string id;    ///< by which it is asked for: "1", "thorax"
  std::string name;  ///< its heading
  std::vector<ReproducedRow> rows;
};

/// An organ that a figure of the paper shows.
struct ReproducedFigure {
  std::string name;  ///< "6a"
  LungModel model;
};

struct Reproduction {
  std::string paper;  ///< "huang-2004"
  std::string citation;
  std::vector<ReproducedTable> tables;
  std::vector<ReproducedFigure> figures;

  bool ok() const;
};

struct ReproduceOptions {
  std::string table;                ///< only this one; empty: all
  bool figures = false;             ///< keep the organs that the paper's figures show
  std::filesystem::path data = {};  ///< folder of people's data, for those that need it
};

/// Names of the papers that can be reproduced.
std::vector<std::string_view> reproduciblePapers();

/// The tables of a paper that can be asked for. @throws InvalidOption for an unknown paper
std::vector<std::string_view> reproducibleTables(std::string_view paper);

/// @throws InvalidOption for an unknown paper, or a table that it does not have; empty: all tables
void requireReproducible(std::string_view paper, std::string_view table);

/// True if the paper's experiments need people's data.
/// @throws InvalidOption for an unknown paper
bool needsData(std::string_view paper);

/// Repeats the experiments of a paper. Whatever can be grown at the same time is; the result does
/// not depend on the number of threads.
/// @throws InvalidOption for an unknown paper, or a table that it does not have; InputMissing,
/// InvalidInput if data are needed and are not there or damaged; Cancelled
Reproduction reproduce(std::string_view paper, const ReproduceOptions& options = {},
                       const Progress& progress = {});

/// "pneuma/reproduce/1" (resources/schemas/reproduce.schema.json)
Json toJson(const Reproduction& reproduction);

/// Tables for people.
std::string textOf(const Reproduction& reproduction);

}  // namespace pneuma
