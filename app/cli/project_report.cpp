#include "cli/project_report.h"

#include <algorithm>
#include <vector>

#include "cli/text.h"

namespace pneuma::cli {
namespace {

std::string joinedNames(const std::vector<LobeSurface>& surfaces) {
  std::string names;
  for (const LobeSurface& surface : surfaces) {
    names += (names.empty() ? "" : ", ") + std::string(shortName(surface.lobe));
  }
  return names;
}

Json ctOf(const Project& project) {
  const LungModel& model = project.state.model;
  Json json = {{"found", model.ct != nullptr}, {"packed", project.ctStorage == CtStorage::Packed}};
  if (model.ctSource) {
    json["path"] = model.ctSource->path.string();
    json["bytes"] = model.ctSource->bytes;
    json["sha256"] = model.ctSource->sha256;
  }
  return json;
}

std::string ctText(const Project& project) {
  const LungModel& model = project.state.model;
  const std::string where =
      model.ctSource ? "'" + model.ctSource->path.string() + "'" : std::string();
  if (project.ctStorage == CtStorage::Packed)
    return "packed in" + (where.empty() ? "" : ", from " + where);
  return where + (model.ct ? "" : " (not found)");
}

}  // namespace

Json projectJson(const Project& project) {
  const ProjectState& state = project.state;
  const LungModel& model = state.model;
  const auto tree = treeOf(model);
  Json surfaces = Json::array();
  if (model.surfaces) {
    for (const LobeSurface& surface : *model.surfaces) {
      surfaces.push_back({{"lobe", shortName(surface.lobe)},
                          {"triangles", surface.mesh->triangles.size()},
                          {"volume_ml", surface.health.volumeMl}});
    }
  }
  Json json = {{"kind", "project"},
               {"format", "Pneuma"},
               {"name", state.name},
               {"labels", model.labels != nullptr},
               {"surfaces", surfaces},
               {"fissures_set", state.lobeEdits.fissures.size()},
               {"breathes", state.breath.has_value()},
               {"steps_to_undo", project.undo.size()},
               {"steps_to_redo", project.redo.size()},
               {"complaints", project.notes},
               {"notes", model.warnings}};
  if (model.ctSource || model.ct) json["ct"] = ctOf(project);
  if (tree) json["branches"] = tree->size();
  if (model.growth) json["grown_by"] = growthMethod(model.growth->options).name;
  return json;
}

std::string projectText(const Project& project) {
  const ProjectState& state = project.state;
  const LungModel& model = state.model;
  const auto tree = treeOf(model);
  std::vector<std::vector<std::string>> rows;
  if (model.ctSource || model.ct) rows.push_back({"CT", ctText(project)});
  if (model.labels) rows.push_back({"labels", "of lungs and airways"});
  if (model.surfaces) rows.push_back({"surfaces", joinedNames(*model.surfaces)});
  if (!model.organ.empty()) rows.push_back({"organ", model.organ});
  if (!state.lobeEdits.fissures.empty()) {
    rows.push_back({"fissures set", std::to_string(state.lobeEdits.fissures.size())});
  }
  if (tree) {
    rows.push_back(
        {"airways",
         grouped(static_cast<double>(tree->size())) + " branches" +
             (model.growth ? ", grown by " + std::string(growthMethod(model.growth->options).name)
                           : "")});
  }
  if (state.breath) rows.push_back({"breathing", textOf(state.breath->scenario)});
  rows.push_back({"steps to undo", std::to_string(project.undo.size())});
  if (!project.redo.empty()) {
    rows.push_back({"steps to redo", std::to_string(project.redo.size())});
  }
  std::string text;
  for (const auto& row : rows) {
    constexpr std::size_t Width = 16;
    text +=
        "  " + row[0] + std::string(Width - std::min(Width, row[0].size()), ' ') + row[1] + "\n";
  }
  for (const auto* sentences : {&model.warnings, &project.notes}) {
    for (const std::string& sentence : *sentences) text += "  ! " + sentence + "\n";
  }
  return text;
}

}  // namespace pneuma::cli
