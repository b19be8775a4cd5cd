#pragma once

#include <QString>
#include <optional>
#include <vector>

#include "document/snapshot.h"
#include "pipeline/case_export.h"

namespace pneuma {

/// What the step "Export" offers.
enum class ExportKind { Paraview, Print, Segmentation, Tree, Recipe, Share, Film, Figure, Report };

inline constexpr int ExportKinds = 9;

/// The preset that makes it; none for a picture and a report.
std::optional<ExportPreset> presetOf(ExportKind kind);

/// One of them for people.
struct ExportRow {
  ExportKind kind = ExportKind::Paraview;
  const char* name = "";  ///< for objects and folders: "paraview"
  QString title;
  QString keeps;  ///< what goes into the files, and what gets lost
  QString lack;   ///< what the case does not have for it, and what to do; empty: it can be exported
};

/// In the order of ExportKind.
std::vector<ExportRow> exportRows(const Snapshot& snapshot);

}  // namespace pneuma
