#include "pipeline/compare_trees.h"

#include <algorithm>

#include "core/error.h"
#include "core/joint_progress.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "pipeline/trees_at_once.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

/// The last `folders` folders of a path and its file name, with or without the extension.
struct NameForm {
  std::size_t folders = 0;
  bool extension = false;

  std::string of(const fs::path& path) const {
    std::string name = (extension ? path.filename() : path.stem()).string();
    fs::path folder = path.parent_path();
    for (std::size_t i = 0; i < folders && folder.has_filename(); ++i) {
      name = folder.filename().string() + "/" + name;
      folder = folder.parent_path();
    }
    return name;
  }
};

/// True if no two different paths have one name.
bool tellsApart(const NameForm& form, const std::vector<fs::path>& paths) {
  std::map<std::string, fs::path> byName;
  return std::ranges::all_of(paths, [&](const fs::path& path) {
    return byName.try_emplace(form.of(path), path).first->second == path;
  });
}

/// The shortest form that tells paths apart. Whole paths always do.
NameForm shortestForm(const std::vector<fs::path>& paths) {
  NameForm form;
  while (!tellsApart(form, paths)) {
    form.folders += form.extension ? 1 : 0;
    form.extension = !form.extension;
  }
  return form;
}

/// @throws Unsupported for a surface, InvalidInput for a damaged one
void requireNoSurface(const fs::path& path) {
  if (!isSurfaceFileName(path) || isTreeFile(path)) return;
  const SurfaceFile surface = readSurface(path);
  throw Unsupported(std::string("'").append(path.string()) + "' is a surface of " +
                    std::to_string(surface.mesh.triangles.size()) +
                    " triangles; only airway trees are compared (VTP, VTU, SWC, CSV or JSON), and "
                    "'pneuma info' tells of surfaces");
}

OpenedTree openTree(const fs::path& path, std::string label) {
  requireNoSurface(path);
  TreeFile file = readTree(path);
  return {std::move(label),       {path.string(), sha256(readFile(path))},
          std::move(file.format), std::move(file.metadata),
          std::move(file.notes),  std::make_shared<const AirwayTree>(std::move(file.tree))};
}

}  // namespace

std::string OpenedTree::method() const {
  const auto found = metadata.find("method");
  return found == metadata.end() ? std::string() : found->second;
}

std::vector<std::string> shortNames(std::span<const fs::path> paths) {
  std::vector<fs::path> whole;
  std::map<fs::path, std::vector<fs::path>> byStem;
  for (const fs::path& path : paths) {
    whole.push_back(fs::absolute(path).lexically_normal());
    byStem[whole.back().stem()].push_back(whole.back());
  }
  std::map<fs::path, NameForm> forms;
  for (const auto& [stem, equal] : byStem) forms[stem] = shortestForm(equal);
  std::vector<std::string> names;
  for (const fs::path& path : whole) {
    const std::string name = forms.at(path.stem()).of(path);
    std::string unique = name;
    for (int copy = 2; std::ranges::find(names, unique) != names.end(); ++copy) {
      unique = name + " (" + std::to_string(copy) + ")";
    }
    names.push_back(unique);
  }
  return names;
}

std::vector<OpenedTree> openTrees(std::span<const fs::path> paths, const Progress& progress) {
  const std::vector<std::string> labels = shortNames(paths);
  std::vector<OpenedTree> trees;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    progress.report(static_cast<double>(i) / static_cast<double>(paths.size()));
    trees.push_back(openTree(paths[i], labels[i]));
  }
  progress.report(1.0);
  return trees;
}

TreeComparison compareTrees(std::vector<OpenedTree> trees, const LungModel& organ,
                            std::uint64_t seed, const Progress& progress) {
  if (trees.size() < 2) {
    throw InvalidOption("compare needs two trees or more, but " + std::to_string(trees.size()) +
                        " was given; 'pneuma measure' measures one");
  }
  progress.throwIfStopped();
  TreeComparison result;
  result.seed = seed;
  std::size_t largest = 1;
  for (OpenedTree& tree : trees) {
    largest = std::max(largest, tree.tree->size());
    result.trees.push_back({std::move(tree), {}});
  }
  const std::size_t count = result.trees.size();
  JointProgress joint(progress, count);
  const std::size_t atOnce = treesAtOnce(largest);
  for (std::size_t begin = 0; begin < count; begin += atOnce) {
    parallelFor(std::min(atOnce, count - begin), [&](std::size_t k) {
      ComparedTree& compared = result.trees[begin + k];
      compared.measured = measureTree(*compared.opened.tree, organ, seed, joint.task(begin + k));
    });
  }
  progress.report(1.0);
  return result;
}

}  // namespace pneuma
