#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// One figure of a paper beside ours.
struct ReproducedRow {
  std::string row;       ///< as in the paper's table, for example "0.41"
  std::string quantity;  ///< for example "terminals"
  double published = 0.0;
  double measured = 0.0;
  double relative = 0.0;  ///< measured / published - 1
  double limit = 0.0;     ///< of |relative|, or of |measured - published| where `absolute`
  bool absolute = false;
  bool ok = false;
};

struct ReproducedTable {
  std::string name;
  std::vector<ReproducedRow> rows;
};

struct Reproduction {
  std::string paper;  ///< "huang-2004"
  std::string citation;
  std::vector<ReproducedTable> tables;
  LungModel model;  ///< the grown organ, for the pictures

  bool ok() const;
};

/// Names of the papers that can be reproduced.
std::span<const std::string_view> reproduciblePapers();

/// @throws InvalidOption for an unknown paper; Cancelled
Reproduction reproduce(std::string_view paper, const Progress& progress = {});

/// "pneuma/reproduce/1"
Json toJson(const Reproduction& reproduction);

/// Tables for people.
std::string textOf(const Reproduction& reproduction);

}  // namespace pneuma
