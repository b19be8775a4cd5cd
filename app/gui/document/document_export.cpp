#include <utility>

#include "document/breath.h"
#include "document/document.h"
#include "document/project_snapshot.h"
#include "document/text.h"
#include "io/atomic_file.h"
#include "pipeline/case_document.h"
#include "render/picture.h"
#include "views/case_export.h"
#include "views/case_pictures.h"

// Writing what other programs and people read.
namespace pneuma {

std::vector<std::filesystem::path> Document::filesInTheWay(ExportPreset preset,
                                                           const std::filesystem::path& folder,
                                                           const std::string& format) const {
  std::vector<std::filesystem::path> there;
  for (const auto& file : presetOutputs(preset, stateOf(snapshot_), {format})) {
    std::error_code ignored;
    if (std::filesystem::exists(folder / file, ignored)) there.push_back(file);
  }
  return there;
}

void Document::exportCase(ExportPreset preset, const std::filesystem::path& folder,
                          const std::string& format, ViewDirection view) {
  if (waitsForLungs([=, this] { exportCase(preset, folder, format, view); })) return;
  touched_ = {folder};
  jobs_.push(
      JobKind::Exporting, tr("Exporting"),
      [this, preset, folder, format, view, state = stateOf(snapshot_),
       breath = snapshot_.breath](const Progress& progress) {
        MadeBreath made;
        if (breath) made = {&breath->lungs, &breath->report};
        pneuma::exportCase(folder, preset, state, view, Existing::Replace, progress, made,
                           {format});
        const std::size_t files = presetOutputs(preset, state, {format}).size();
        return JobQueue::Continuation([this, preset, folder, files, shown = treeOf(state.model)] {
          if (preset == ExportPreset::Tree) {
            saved_ = shown;
            emit treeWasSaved();
          }
          emit said(
              tr("Exported %1 to %2").arg(counted(files, "file", "files"), fileNameOf(folder)));
        });
      });
}

void Document::saveReport(const std::filesystem::path& path, const CaseReportOptions& options) {
  if (waitsForLungs([=, this] { saveReport(path, options); })) return;
  touched_ = {path};
  Project project;
  project.state = stateOf(snapshot_);
  jobs_.push(
      JobKind::Exporting, tr("Writing the report"),
      [this, path, options, project = std::move(project)](const Progress& progress) {
        requireCaseDocumentName(path);
        const Json report = caseReport(project, options, progress.part(0.0, 0.7, "measuring"));
        std::vector<PagePicture> pictures;
        const bool drawn = canRender() || !hasPictures(path);
        if (hasPictures(path) && drawn) {
          pictures = casePictures(project.state.model, progress.part(0.7, 1.0, "drawing"));
        }
        writeFile(path, caseDocument(path, report, pictures));
        return JobQueue::Continuation([this, path, drawn, checks = report.at("checks").size()] {
          const QString saved =
              tr("Saved %1: %2").arg(fileNameOf(path), counted(checks, "check", "checks"));
          emit said(drawn ? saved : tr("%1; without pictures, which need OpenGL 3.2").arg(saved));
        });
      });
}

}  // namespace pneuma
