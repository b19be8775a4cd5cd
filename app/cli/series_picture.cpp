#include "cli/series_picture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/error.h"
#include "io/multiblock_file.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "pipeline/breathe_files.h"
#include "pipeline/lobe_parts.h"
#include "views/model_scene.h"

namespace pneuma::cli {
namespace {

double sizeOf(const LungModel& model) {
  Box3 box;
  for (const LobeSurface& surface : *model.surfaces) box.extend(bounds(*surface.mesh));
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

}  // namespace

std::size_t Series::nearestTo(double seconds) const {
  const auto distance = [&](const SeriesMoment& m) { return std::abs(m.seconds - seconds); };
  return static_cast<std::size_t>(std::ranges::min_element(moments, {}, distance) -
                                  moments.begin());
}

std::size_t Series::nearestInBreaths(double seconds) const {
  if (!(periodSeconds > 0.0)) return 0;
  const double first = moments.front().seconds;
  const double into = std::fmod(seconds - first, periodSeconds);
  const double inBreath = first + (into < 0.0 ? into + periodSeconds : into);
  const std::size_t nearest = nearestTo(inBreath);
  // The first moment comes again.
  const bool again =
      first + periodSeconds - inBreath < std::abs(moments[nearest].seconds - inBreath);
  return again ? 0 : nearest;
}

int Series::rate() const {
  if (!(periodSeconds > 0.0)) return 1;
  const double perSecond = static_cast<double>(moments.size()) / periodSeconds;
  return static_cast<int>(std::lround(std::clamp(perSecond, 1.0, 120.0)));
}

bool isSeries(const std::filesystem::path& path) { return path.extension() == ".pvd"; }

Series readSeries(const std::filesystem::path& pvd) {
  Series series;
  for (const TimedFile& file : readTimeCollection(pvd)) {
    if (series.moments.empty() || series.moments.back().seconds != file.seconds) {
      series.moments.push_back({file.seconds, {}, {}});
    }
    if (file.file.extension() == ".vtm") {
      throw Unsupported("'" + pvd.string() + "' names '" + file.file.string() +
                        "', a frame in pieces for ParaView; to draw it here, breathe again with a "
                        "larger --largest-file");
    }
    SeriesMoment& moment = series.moments.back();
    (file.part == ChestWallPart ? moment.chestWalls : moment.files)
        .push_back(pvd.parent_path() / file.file);
  }
  const SeriesMoment& first = series.moments.front();
  const SeriesMoment& last = series.moments.back();
  series.periodSeconds = last.seconds - first.seconds;
  if (series.moments.size() > 1 && last.files == first.files) {
    series.moments.pop_back();
  } else if (series.moments.size() > 1) {
    series.periodSeconds *=
        static_cast<double>(series.moments.size()) / static_cast<double>(series.moments.size() - 1);
  }
  return series;
}

LungModel openMoment(const SeriesMoment& moment) {
  auto surfaces = std::make_shared<std::vector<LobeSurface>>();
  LungModel model;
  for (const std::filesystem::path& path : moment.files) {
    if (isTreeFile(path)) {
      model.opened = std::make_shared<const AirwayTree>(readTree(path).tree);
      continue;
    }
    SurfaceFile file = readSurface(path);
    std::map<Lobe, TriangleMesh> parts = lobeParts(file.mesh, file.lobes);
    if (parts.empty()) parts.emplace(Lobe::Whole, std::move(file.mesh));
    for (auto& [lobe, mesh] : parts) {
      surfaces->push_back({lobe,
                           path.filename().string(),
                           std::make_shared<const TriangleMesh>(std::move(mesh)),
                           {}});
    }
  }
  for (const std::filesystem::path& path : moment.chestWalls) {
    auto wall = std::make_shared<const TriangleMesh>(readSurface(path).mesh);
    surfaces->push_back({Lobe::Whole, ChestWallName, std::move(wall), {}});
  }
  model.surfaces = std::move(surfaces);
  return model;
}

void drawSeries(const std::vector<SeriesMoment>& moments, Scene& scene, ViewDirection view,
                const std::function<void(const LungModel& model)>& show,
                const std::function<void()>& draw, const Progress& progress) {
  const double steps = static_cast<double>(2 * moments.size());
  double done = 0.0;
  double largest = -1.0;
  for (const SeriesMoment& moment : moments) {
    const LungModel model = openMoment(moment);
    if (const double size = sizeOf(model); size > largest) {
      largest = size;
      show(model);
      scene.look(view);
    }
    progress.report(++done / steps);
  }
  for (const SeriesMoment& moment : moments) {
    show(openMoment(moment));
    draw();
    progress.report(++done / steps);
  }
}

}  // namespace pneuma::cli
