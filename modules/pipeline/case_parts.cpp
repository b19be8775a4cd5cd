#include "pipeline/case_parts.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "io/fissure_file.h"
#include "io/surface_file.h"
#include "io/volume_file.h"
#include "pipeline/case_recipe.h"

namespace pneuma {
namespace {

std::string inSmallLetters(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

}  // namespace

std::vector<CasePart> partsOf(const ProjectState& state) {
  const LungModel& model = state.model;
  std::vector<CasePart> parts;
  for (const auto& surfaces : {model.surfaces, model.wholeLungs}) {
    if (!surfaces) continue;
    for (const LobeSurface& surface : *surfaces) {
      const std::string stem = inSmallLetters(shortName(surface.lobe));
      if (std::ranges::find(parts, stem, &CasePart::stem) != parts.end()) continue;
      parts.push_back({stem, surface.mesh, nullptr, {}, {}});
    }
  }
  const auto tree = treeOf(model);
  if (tree && tree != model.central) parts.push_back({"tree", nullptr, tree, {}, {}});
  if (model.central) parts.push_back({"central", nullptr, model.central, {}, {}});
  if (model.labels) {
    parts.push_back({"labels", nullptr, nullptr, "labels.nii.gz",
                     [labels = model.labels](const std::filesystem::path& file) {
                       writeVolume(file, *labels);
                     }});
  }
  if (const GivenFissures given = givenOf(state.lobeEdits); !given.empty()) {
    parts.push_back(
        {"fissures", nullptr, nullptr, "fissures.json",
         [given](const std::filesystem::path& file) { writeGivenFissures(file, given); }});
  }
  return parts;
}

Project openCase(const std::vector<std::filesystem::path>& paths, const Progress& progress) {
  if (paths.size() == 1 && isProjectFileName(paths.front())) {
    return readProject(paths.front(), progress);
  }
  Project project;
  project.state.name = paths.front().filename().string();
  project.state.model = openFiles(paths, progress);
  return project;
}

}  // namespace pneuma
