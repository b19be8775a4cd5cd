#include "pipeline/ct_model.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.h"
#include "geometry/mesh_doctor.h"
#include "io/atomic_file.h"
#include "io/input_files.h"
#include "pipeline/segment_report.h"

namespace pneuma {

InputFile ctInput(const std::filesystem::path& path, const CtFile& file, const Progress& progress) {
  if (!file.series) return InputFile{path.string(), sha256OfFile(path, progress)};
  std::string hashes;
  const std::vector<DicomSlice>& slices = file.series->slices;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const auto part = [&](std::size_t n) {
      return static_cast<double>(n) / static_cast<double>(slices.size());
    };
    if (slices[i].frame != 0) continue;
    hashes += sha256OfFile(slices[i].file, progress.part(part(i), part(i + 1), "hashing"));
  }
  return {path.string(), sha256(hashes)};
}

LungModel modelOf(CtFile file, CtSource source) {
  source.series = keptSeries(source.series);
  LungModel model;
  model.inputs.push_back({source.path.string(), ""});
  model.ctSource = std::make_shared<const CtSource>(std::move(source));
  model.warnings = std::move(file.warnings);
  model.ct = std::make_shared<const CtImage>(std::move(file.image));
  return model;
}

LungModel openCt(const std::filesystem::path& path, const CtCorrections& corrections,
                 const Progress& progress, const SeriesChoice& choice) {
  return modelOf(readCt(path, corrections, progress, choice),
                 {path, corrections, choice.wanted, 0, {}});
}

LungModel withCt(const LungModel& model, const LungModel& ct, const std::filesystem::path& labels,
                 const Progress& progress) {
  const LungModel opened =
      labels.empty() ? withLungs(ct, {}, progress) : withLabels(ct, labels, progress);
  LungModel result = model;
  result.ct = opened.ct;
  result.ctSource = opened.ctSource;
  result.labels = opened.labels;
  result.inputs.insert(result.inputs.end(), opened.inputs.begin(), opened.inputs.end());
  result.warnings.insert(result.warnings.end(), opened.warnings.begin(), opened.warnings.end());
  return result;
}

LungModel withLungs(const LungModel& model, const LungOptions& options, const Progress& progress) {
  if (!model.ct) throw InvalidInput("there is no CT to find lungs in; open one first");
  LungModel result;
  result.ct = model.ct;
  result.ctSource = model.ctSource;
  result.inputs = model.inputs;
  result.warnings = model.warnings;
  result.readSeconds = model.readSeconds;
  const auto lungs =
      std::make_shared<const LungSegmentation>(segmentLungs(*model.ct, options, progress));
  result.lungs = lungs;
  result.labels = std::shared_ptr<const LabelImage>(lungs, &lungs->labels);
  if (!lungs->central.empty()) {
    result.central = std::shared_ptr<const AirwayTree>(lungs, &lungs->central);
  }
  for (const SegmentationCheck& check : lungs->checks) {
    if (!check.ok()) result.warnings.push_back(sentence(check));
  }
  return result;
}

LungModel withSurfaces(const LungModel& model, const SurfaceOptions& options,
                       const Progress& progress) {
  LungModel result = model;
  auto surfaces = std::make_shared<std::vector<LobeSurface>>();
  const std::array<Lobe, 2> both = {Lobe::RightLung, Lobe::LeftLung};
  for (std::size_t n = 0; n < both.size(); ++n) {
    const Lobe lobe = both[n];
    if (!model.labels || std::ranges::find(model.labels->voxels, static_cast<std::uint8_t>(lobe)) ==
                             model.labels->voxels.end()) {
      continue;
    }
    const Progress part = progress.part(0.5 * static_cast<double>(n),
                                        0.5 * static_cast<double>(n + 1), "drawing surfaces");
    LobeSurface surface;
    surface.lobe = lobe;
    surface.name = std::string(shortName(lobe));
    auto mesh = labelSurface(*model.labels, static_cast<std::uint8_t>(lobe), options,
                             part.part(0.0, 0.7, "drawing surfaces"));
    surface.health = examine(mesh, SelfIntersections::Skip, part.part(0.7, 1.0, "examining"));
    surface.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    surfaces->push_back(std::move(surface));
  }
  if (surfaces->empty()) throw InvalidInput("there are no labels of lungs to draw surfaces of");
  result.surfaces = std::move(surfaces);
  result.regions = nullptr;
  return result;
}

}  // namespace pneuma
