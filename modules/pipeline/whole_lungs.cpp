#include "pipeline/whole_lungs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/units.h"
#include "geometry/surface_voxels.h"
#include "geometry/untangling.h"
#include "io/ct_file.h"
#include "io/input_files.h"
#include "io/volume_file.h"
#include "lobes/lobe_splitting.h"
#include "lobes/welding.h"
#include "pipeline/ct_model.h"
#include "pipeline/figure_table.h"
#include "segmentation/closing.h"
#include "segmentation/label_surface.h"
#include "segmentation/lung_labels.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr double GapRadiusMm = 3.0;
constexpr int MarginVoxels = 8;
/// Voxels that lobes have together differ from the sum of their volumes by less, unless they
/// overlap or have gaps.
constexpr double SameVolume = 1e-3;

/// Our labels of lungs from those of an image: lobes become the lungs they are of.
void renumber(LabelImage& image, const LungLabelOptions& options, const fs::path& path) {
  std::array<bool, 256> there{};
  for (const std::uint8_t label : image.voxels) there[label] = true;
  std::array<std::uint8_t, 256> becomes{};
  becomes[AirwayLabel] = AirwayLabel;
  becomes[RightLabel] = RightLabel;
  becomes[LeftLabel] = LeftLabel;
  const auto lung = [&](int label, std::uint8_t ours, const char* option) {
    if (label == 0) return;
    if (!there[static_cast<std::size_t>(label)]) {
      throw InvalidInput("'" + path.string() + "' has no voxel with the label " +
                         std::to_string(label) + " that " + option + " names");
    }
    becomes.fill(0);
    becomes[static_cast<std::size_t>(label)] = ours;
  };
  if (options.right == 0 && options.left == 0) {
    const bool rightLobes = there[1] && there[2] && there[3];
    if ((there[1] || there[2] || there[3]) && !rightLobes) {
      throw InvalidInput("'" + path.string() +
                         "' has some of the labels 1, 2 and 3 of the right lung's lobes and not "
                         "all; if they are whole lungs, say which with --right-label and "
                         "--left-label");
    }
    for (const Lobe lobe : FiveLobes) {
      becomes[static_cast<std::size_t>(lobe)] = side(lobe) == Side::Right ? RightLabel : LeftLabel;
    }
  } else {
    lung(options.right, RightLabel, "--right-label");
    const auto kept = becomes;
    lung(options.left, LeftLabel, "--left-label");
    if (options.right != 0)
      becomes[static_cast<std::size_t>(options.right)] =
          kept[static_cast<std::size_t>(options.right)];
  }
  for (std::uint8_t& label : image.voxels) label = becomes[label];
}

LungModel openLabels(const fs::path& path, const LungLabelOptions& options,
                     const Progress& progress) {
  LungModel model;
  LabelImage image = readLabelVolume(path, progress.part(0.0, 0.3, "reading labels"));
  renumber(image, options, path);
  model.inputs.push_back({path.string(), sha256OfFile(path)});
  model.labels = std::make_shared<const LabelImage>(std::move(image));
  return withSurfaces(model, {}, progress.part(0.3, 1.0, "drawing surfaces"));
}

const LobeSurface* surfaceOf(const LungModel& model, Lobe lobe) {
  const auto found = std::ranges::find(*model.surfaces, lobe, &LobeSurface::lobe);
  return found == model.surfaces->end() ? nullptr : &*found;
}

bool sound(const MeshReport& health) {
  return health.openEdges == 0 && health.nonManifoldEdges == 0 && health.misorientedEdges == 0 &&
         health.nonManifoldVertices == 0;
}

/// A lung drawn anew from the voxels of its lobes.
TriangleMesh fromVoxels(std::span<const LobeSurface* const> lobes, Lobe lung, double voxelMm,
                        const Progress& progress) {
  Box3 box;
  double sum = 0.0;
  for (const LobeSurface* lobe : lobes) {
    box.extend(bounds(*lobe->mesh));
    sum += signedVolumeMm3(*lobe->mesh);
  }
  LabelImage image;
  image.geometry = geometryAround(box, voxelMm, MarginVoxels);
  image.voxels.assign(image.geometry.voxelCount(), 0);
  for (const LobeSurface* lobe : lobes) {
    const std::vector<std::uint8_t> inside = voxelsInside(*lobe->mesh, image.geometry, progress);
    for (std::size_t v = 0; v < inside.size(); ++v) image.voxels[v] |= inside[v];
  }
  const auto voxels = static_cast<double>(std::ranges::count(image.voxels, 1));
  const double unionMm3 = voxels * image.geometry.voxelMm3();
  progress.report(0.2);
  closeByBall(image.voxels, image.geometry.size, image.geometry.spacing, GapRadiusMm, progress);
  const auto label = static_cast<std::uint8_t>(lung);
  for (std::uint8_t& voxel : image.voxels) voxel = voxel != 0 ? label : std::uint8_t{0};
  TriangleMesh mesh = labelSurface(image, label, {}, progress.part(0.4, 1.0, "drawing a surface"));
  // Lobes that overlap have less volume than their sum.
  restoreVolume(mesh, std::abs(sum / unionMm3 - 1.0) < SameVolume ? sum : unionMm3);
  return mesh;
}

LobeSurface joined(std::span<const LobeSurface* const> lobes, Lobe lung, double voxelMm,
                   std::vector<std::string>& warnings, const Progress& progress) {
  std::vector<std::pair<RegionId, const TriangleMesh*>> surfaces;
  for (const LobeSurface* lobe : lobes) {
    if (!lobe->health.closed || !(lobe->health.volumeMl > 0.0)) {
      throw InvalidInput("'" + lobe->name +
                         "' is not closed, so that it cannot be joined with the other lobes of its "
                         "lung; mend it with 'pneuma repair'");
    }
    surfaces.emplace_back(static_cast<RegionId>(lobe->lobe), lobe->mesh.get());
  }
  LobeSurface result;
  result.lobe = lung;
  result.name = std::string(shortName(lung));
  const Welding welding = weld(surfaces);
  TriangleMesh mesh = outerSurface(welding.complex);
  result.health = examine(mesh, SelfIntersections::Ask, progress.part(0.0, 0.2, "joining lobes"));
  const bool welded = welding.conflicts == 0 && sound(result.health) &&
                      result.health.components == 1 && result.health.fitToGrow();
  if (!welded) {
    mesh = fromVoxels(lobes, lung, voxelMm, progress.part(0.2, 0.9, "joining lobes"));
    result.health = examine(mesh, SelfIntersections::Ask, progress.part(0.9, 1.0, "joining lobes"));
    warnings.push_back("the lobes of the " + std::string(longName(lung)) +
                       (welding.sharedTriangles == 0
                            ? " share no triangles"
                            : " share triangles and leave a surface that touches itself") +
                       "; the lung was drawn anew from voxels of " + fixed(voxelMm, 0) +
                       " mm, with their volume");
  }
  result.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return result;
}

}  // namespace

LungModel openLungs(std::span<const fs::path> paths, const LungLabelOptions& labels,
                    const Progress& progress) {
  requireValid(labels);
  LungModel model;
  if (paths.size() == 1 && isCtPath(paths[0])) {
    const bool isLabels =
        isVolumeFile(paths[0]) && readVolumeHeader(paths[0]).scalarType == "uint8";
    if (isLabels) {
      model = openLabels(paths[0], labels, progress.part(0.0, 0.8, "reading labels"));
    } else {
      CtFile file = readCt(paths[0], {}, progress.part(0.0, 0.2, "reading"));
      const InputFile input = ctInput(paths[0], file, progress.part(0.2, 0.25, "hashing"));
      model = modelOf(std::move(file), {paths[0], {}, {}, 0, {}});
      model.inputs = {input};
      model = withLungs(model, {}, progress.part(0.25, 0.7, "finding the lungs"));
      model = withSurfaces(model, {}, progress.part(0.7, 0.8, "drawing surfaces"));
    }
  } else {
    model = openLobes(paths, progress.part(0.0, 0.5, "reading surfaces"));
    model = withWholeLungs(model, progress.part(0.5, 0.8, "joining lobes"));
  }
  model = untangled(model, progress.part(0.8, 1.0, "examining"));
  requireSides(model);
  return model;
}

LungModel untangled(const LungModel& model, const Progress& progress) {
  LungModel result = model;
  auto surfaces = std::make_shared<std::vector<LobeSurface>>(*model.surfaces);
  for (LobeSurface& lung : *surfaces) {
    if (!lung.health.selfIntersectionsCounted) {
      lung.health = examine(*lung.mesh, SelfIntersections::Ask, progress);
    }
    if (lung.health.selfIntersections == 0 || !lung.health.fitToGrow()) continue;
    TriangleMesh mesh = *lung.mesh;
    const Untangled parted = untangle(mesh, progress);
    if (parted.pairsAfter > 0) {
      throw InvalidInput("'" + lung.name +
                         "' cannot be split: " + std::to_string(parted.pairsBefore) +
                         " pairs of its triangles cut each other; mend it with 'pneuma repair'");
    }
    result.warnings.push_back(lung.name + ": " + std::to_string(parted.pairsBefore) +
                              " pairs of triangles cut each other; " +
                              std::to_string(parted.movedPoints) + " points were moved by up to " +
                              fixed(parted.farthestMm, 2) + " mm to part them");
    lung.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    lung.health = examine(*lung.mesh, SelfIntersections::Skip, progress);
    lung.health.selfIntersectionsCounted = true;
  }
  result.surfaces = std::move(surfaces);
  result.regions = nullptr;
  return result;
}

LungModel withWholeLungs(const LungModel& model, const Progress& progress, double voxelMm) {
  LungModel result = model;
  auto surfaces = std::make_shared<std::vector<LobeSurface>>();
  double from = 0.0;
  for (const Lobe lung : {Lobe::RightLung, Lobe::LeftLung}) {
    const Progress part = progress.part(from, from + 0.5, "joining lobes");
    from = 0.5;
    if (const LobeSurface* whole = surfaceOf(model, lung)) {
      surfaces->push_back(*whole);
      continue;
    }
    std::vector<const LobeSurface*> lobes;
    std::string missing;
    for (const Lobe lobe : lobesOf(side(lung))) {
      const LobeSurface* surface = surfaceOf(model, lobe);
      if (surface != nullptr) lobes.push_back(surface);
      if (surface == nullptr) missing += " " + std::string(shortName(lobe));
    }
    if (lobes.empty()) continue;
    if (!missing.empty()) {
      throw InvalidInput("to join the lobes of the " + std::string(longName(lung)) +
                         " all of them are needed;" + missing + " is missing");
    }
    surfaces->push_back(joined(lobes, lung, voxelMm, result.warnings, part));
  }
  if (!surfaces->empty()) result.surfaces = std::move(surfaces);
  result.regions = nullptr;
  return result;
}

void requireSides(const LungModel& model) {
  if (!model.surfaces) return;
  const LobeSurface* right = surfaceOf(model, Lobe::RightLung);
  const LobeSurface* left = surfaceOf(model, Lobe::LeftLung);
  if (right == nullptr || left == nullptr) return;
  const double rightX = bounds(*right->mesh).center().x();
  const double leftX = bounds(*left->mesh).center().x();
  if (rightX < leftX) return;
  throw InvalidInput("'" + right->name + "' lies to the left of '" + left->name + "' (at L " +
                     fixed(rightX, 0) + " and " + fixed(leftX, 0) +
                     " mm); the files are named the wrong way round, or not in LPS");
}

}  // namespace pneuma
