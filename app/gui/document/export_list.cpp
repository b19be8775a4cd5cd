#include "document/export_list.h"

#include <QObject>

#include "document/breath.h"
#include "document/project_snapshot.h"

namespace pneuma {

namespace {

QString sentenceOf(ExportLack lack) {
  switch (lack) {
    case ExportLack::Nothing:
      return {};
    case ExportLack::Surfaces:
      return QObject::tr("Needs surfaces: open lobes or find the lungs of a CT.");
    case ExportLack::Labels:
      return QObject::tr("Needs labels: find the lungs of a CT, or split lungs into lobes.");
    case ExportLack::Tree:
      return QObject::tr("Needs airways: open a tree or grow one.");
    case ExportLack::FoundLungs:
      return QObject::tr("Needs lungs that were found in a CT.");
    case ExportLack::Breath:
      return QObject::tr("Needs a breath: make one in the step Breathing.");
    case ExportLack::Anything:
      break;
  }
  return QObject::tr("Needs surfaces or airways: open some first.");
}

ExportLack lackOfKind(ExportKind kind, const ProjectState& state) {
  if (const auto preset = presetOf(kind)) return lackOf(*preset, state);
  const bool lungs = kind == ExportKind::Report && state.model.lungs;
  return lungs ? ExportLack::Nothing : lackOf(ExportPreset::Paraview, state);
}

}  // namespace

std::optional<ExportPreset> presetOf(ExportKind kind) {
  switch (kind) {
    case ExportKind::Paraview:
      return ExportPreset::Paraview;
    case ExportKind::Print:
      return ExportPreset::Print;
    case ExportKind::Segmentation:
      return ExportPreset::Segmentation;
    case ExportKind::Tree:
      return ExportPreset::Tree;
    case ExportKind::Recipe:
      return ExportPreset::Recipe;
    case ExportKind::Share:
      return ExportPreset::Share;
    case ExportKind::Film:
      return ExportPreset::Film;
    case ExportKind::Figure:
    case ExportKind::Report:
      break;
  }
  return std::nullopt;
}

std::vector<ExportRow> exportRows(const Snapshot& snapshot) {
  const auto tr = [](const char* text) { return QObject::tr(text); };
  std::vector<ExportRow> rows = {
      {ExportKind::Paraview,
       "paraview",
       tr("ParaView"),
       snapshot.breath ? tr("All shapes and figures, and the breath: VTM, VTP, PVD.")
                       : tr("All shapes and figures: VTM, VTP. There is no breath yet."),
       {}},
      {ExportKind::Print,
       "print",
       tr("3-D print"),
       tr("Shapes alone, in mm: a file of every surface."),
       {}},
      {ExportKind::Segmentation,
       "segmentation",
       tr("Segmentation"),
       tr("Voxels with the lobes' numbers, no names."),
       {}},
      {ExportKind::Tree,
       "tree",
       tr("Airway tree"),
       tr("VTP, JSON: everything. SWC, CSV: points and radii."),
       {}},
      {ExportKind::Recipe,
       "recipe",
       tr("Recipe"),
       tr("Options and fissures, for 'pneuma run' to do all of it again; tells where the CT is."),
       {}},
      {ExportKind::Share,
       "share",
       tr("Animation in 3-D"),
       tr("Lungs that breathe, for web pages, slides: glTF. No figures."),
       {}},
      {ExportKind::Film,
       "film",
       tr("Film"),
       tr("One breath from where you look: OGV. Colours of lobes alone."),
       {}},
      {ExportKind::Figure, "figure", tr("Figure"), tr("The 3-D view as it is: PNG."), {}},
      {ExportKind::Report,
       "report",
       tr("Report"),
       tr("Volumes, checks, methods, no names: PDF, HTML; JSON has all."),
       {}},
  };
  const ProjectState state = stateOf(snapshot);
  for (ExportRow& row : rows) row.lack = sentenceOf(lackOfKind(row.kind, state));
  return rows;
}

}  // namespace pneuma
