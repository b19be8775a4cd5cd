#include "pipeline/breathe_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/multiblock_file.h"
#include "io/surface_file.h"
#include "io/tree_file.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr int SurfacePart = 0;
constexpr int TreePart = 1;

constexpr const char* SeriesEnding = ".vtp.series";
constexpr std::uint64_t DoubleBytes = 8;
constexpr ArrayBytes FrameArrays{6 * DoubleBytes, 1};  ///< displacement, F, volume_change, strain
constexpr ArrayBytes ChestWallArrays{3 * DoubleBytes, 0};

/// Where the files of a frame end, of every frame alike (piece_files.h).
struct FramePieces {
  std::vector<std::size_t> surfaces;
  std::vector<std::size_t> tree;       ///< empty without one
  std::vector<std::size_t> chestWall;  ///< empty without one
};

std::string number(int frame) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%04d", frame);
  return text.data();
}

fs::path surfaceFile(const fs::path& pvd, int frame) {
  return pvd.stem().string() + "_" + number(frame) + ".vtp";
}

fs::path treeFile(const fs::path& pvd, int frame) {
  return pvd.stem().string() + "_tree_" + number(frame) + ".vtp";
}

fs::path chestWallFile(const fs::path& pvd, int frame) {
  return pvd.stem().string() + "_chest_wall_" + number(frame) + ".vtp";
}

fs::path besides(const fs::path& pvd, const char* ending) { return pvd.stem().string() + ending; }

void append(TriangleMesh& together, const TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(together.points.size());
  together.points.insert(together.points.end(), mesh.points.begin(), mesh.points.end());
  for (const auto& [a, b, c] : mesh.triangles) {
    together.triangles.push_back({first + a, first + b, first + c});
  }
}

FramePieces framePieces(const BreathingLungs& lungs, std::uint64_t largestFileBytes) {
  TriangleMesh together;
  for (const MovingSurface& surface : lungs.surfaces) append(together, *surface.surface.mesh);
  FramePieces pieces;
  pieces.surfaces = pieceEnds(together, largestFileBytes, FrameArrays);
  if (lungs.tree) pieces.tree = pieceEnds(*lungs.tree, largestFileBytes);
  if (lungs.chestWall) {
    pieces.chestWall = pieceEnds(lungs.chestWall->wall(), largestFileBytes, ChestWallArrays);
  }
  return pieces;
}

/// The same before anything breathes, as far as it can be told.
FramePieces framePieces(const LungModel& model, const BreatheOptions& options,
                        std::uint64_t largestFileBytes) {
  TriangleMesh together;
  if (model.surfaces) {
    for (const LobeSurface& surface : *model.surfaces) append(together, *surface.mesh);
  }
  FramePieces pieces;
  pieces.surfaces = pieceEnds(together, largestFileBytes, FrameArrays);
  if (const auto tree = treeOf(model)) pieces.tree = pieceEnds(*tree, largestFileBytes);
  if (hasChestWall(options)) pieces.chestWall = {0};  // one file: it is not there yet
  return pieces;
}

/// All surfaces at a moment as one.
void writeFrame(const fs::path& path, const BreathingLungs& lungs, const BreathFrame& frame,
                const std::vector<std::size_t>& ends) {
  TriangleMesh together;
  SurfaceArrays arrays;
  std::vector<Vec3>& displacement = arrays.pointVectors["displacement"];
  std::vector<double>& force = arrays.pointValues["F"];
  std::vector<double>& change = arrays.pointValues["volume_change"];
  std::vector<double>& strain = arrays.pointValues["strain"];
  std::vector<std::uint8_t>& lobe = arrays.triangleMarks["lobe"];
  for (const MovingSurface& surface : lungs.surfaces) {
    const double s = frame.scale.at(surface.side);
    const TriangleMesh& mesh = *surface.surface.mesh;
    const std::size_t first = together.points.size();
    append(together, mesh);
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      const Vec3& u = surface.displacement[n];
      const auto& c = surface.volumeChange[n];
      const double determinant = 1.0 + s * (c[0] + s * (c[1] + s * c[2]));
      together.points[first + n] += s * u;
      displacement.push_back(s * u);
      force.push_back(u.norm());
      change.push_back(determinant);
      strain.push_back(std::cbrt(determinant) - 1.0);
    }
    lobe.resize(together.triangles.size(), static_cast<std::uint8_t>(surface.surface.lobe));
  }
  arrays.fieldValues["phase"] = frame.phase;
  writeSurfacePieces(path, together, ends, arrays);
}

void writeChestWall(const fs::path& path, const LungMotion& chest, const BreathFrame& frame,
                    const std::vector<std::size_t>& ends) {
  TriangleMesh moved = chest.wall();
  SurfaceArrays arrays;
  std::vector<Vec3>& displacement = arrays.pointVectors["displacement"];
  for (std::size_t n = 0; n < moved.points.size(); ++n) {
    displacement.push_back(frame.chestWallScale * chest.ofWall()[n]);
    moved.points[n] += displacement.back();
  }
  arrays.fieldValues["phase"] = frame.phase;
  writeSurfacePieces(path, moved, ends, arrays);
}

std::string csvOf(const BreathingLungs& lungs) {
  std::string text = "frame,seconds,phase,pressure_cmH2O,flow_ml_per_s,volume_ml";
  for (const auto& [side, motion] : lungs.motion) {
    const std::string lung(name(side));
    text.append(",").append(lung).append("_ml,").append(lung).append("_scale");
  }
  if (lungs.chestWall) text += ",chest_wall_ml,pleural_gap_ml";
  text += "\n";
  const auto add = [&](double value) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), ",%.9g", value);
    text += digits.data();
  };
  for (std::size_t n = 0; n < lungs.frames.size(); ++n) {
    const BreathFrame& frame = lungs.frames[n];
    double volumeMl = 0.0;
    for (const auto& [side, ml] : frame.volumeMl) volumeMl += ml;
    text += std::to_string(n);
    for (const double value : {frame.phase * lungs.drive.period, frame.phase, frame.breath.pressure,
                               1000.0 * frame.breath.flow, volumeMl}) {
      add(value);
    }
    for (const auto& [side, ml] : frame.volumeMl) {
      add(ml);
      add(frame.scale.at(side));
    }
    if (lungs.chestWall) {
      const double wallMl = lungs.chestWall->volume().at(frame.chestWallScale) / 1000.0;
      add(wallMl);
      add(wallMl - frame.volumeMl.at(lungs.chestWall->side()));
    }
    text += "\n";
  }
  return text;
}

/// Something of a frame, in a file or in pieces.
struct FrameThing {
  int part = 0;  ///< in the collection
  std::string name;
  fs::path whole;
  const std::vector<std::size_t>* ends = nullptr;

  bool divided() const { return ends->size() > 1; }

  std::vector<fs::path> files() const { return pieceFiles(whole, ends->size()); }

  /// What the collection names: the file, or a .vtm of the pieces.
  fs::path named() const { return divided() ? fs::path(whole).replace_extension(".vtm") : whole; }
};

/// @param pieces must outlive what is returned
std::vector<FrameThing> thingsOf(const fs::path& pvd, int frame, const FramePieces& pieces) {
  std::vector<FrameThing> things = {
      {SurfacePart, "lungs", surfaceFile(pvd, frame), &pieces.surfaces},
      {TreePart, "airways", treeFile(pvd, frame), &pieces.tree},
      {ChestWallPart, "chest wall", chestWallFile(pvd, frame), &pieces.chestWall}};
  std::erase_if(things, [](const FrameThing& thing) { return thing.ends->empty(); });
  return things;
}

std::vector<fs::path> outputsOf(const fs::path& pvd, int frames, const FramePieces& pieces) {
  std::vector<fs::path> files = {pvd.filename(), besides(pvd, ".csv"), besides(pvd, ".json")};
  if (pieces.surfaces.size() == 1) files.push_back(besides(pvd, SeriesEnding));
  for (int n = 0; n < frames; ++n) {
    for (const FrameThing& thing : thingsOf(pvd, n, pieces)) {
      if (thing.divided()) files.push_back(thing.named());
      for (const fs::path& file : thing.files()) files.push_back(file);
    }
  }
  return files;
}

void writeThing(const fs::path& folder, const FrameThing& thing, const BreathingLungs& lungs,
                const BreathFrame& frame) {
  const fs::path file = folder / thing.whole;
  if (thing.part == SurfacePart) writeFrame(file, lungs, frame, *thing.ends);
  if (thing.part == TreePart) writeTreePieces(file, treeAt(lungs, frame), {}, *thing.ends);
  if (thing.part == ChestWallPart) writeChestWall(file, *lungs.chestWall, frame, *thing.ends);
  if (thing.divided()) writeMultiblock(folder / thing.named(), {{thing.name, thing.files()}});
}

}  // namespace

std::vector<fs::path> breathOutputs(const fs::path& pvd, const LungModel& model,
                                    const BreatheOptions& options, std::uint64_t largestFileBytes) {
  return outputsOf(pvd, options.frames, framePieces(model, options, largestFileBytes));
}

std::vector<fs::path> breathOutputs(const fs::path& pvd, const BreathingLungs& lungs,
                                    std::uint64_t largestFileBytes) {
  return outputsOf(pvd, static_cast<int>(lungs.frames.size()),
                   framePieces(lungs, largestFileBytes));
}

void requireNoOtherSeries(const fs::path& pvd, const std::vector<fs::path>& outputs) {
  const fs::path series = besides(pvd, SeriesEnding);
  std::error_code error;
  if (std::ranges::find(outputs, series) != outputs.end() ||
      !fs::exists(pvd.parent_path() / series, error)) {
    return;
  }
  throw OutputFailed("'" + (pvd.parent_path() / series).string() +
                     "' would stand beside this breath, which is in pieces, and open another; "
                     "remove it, or choose another name");
}

void writeBreath(const fs::path& pvd, const BreathingLungs& lungs, const Json& report,
                 const Progress& progress, std::uint64_t largestFileBytes) {
  const fs::path folder = pvd.parent_path();
  const FramePieces pieces = framePieces(lungs, largestFileBytes);
  std::vector<TimedFile> files;
  const auto add = [&](int n, double seconds) {
    for (const FrameThing& thing : thingsOf(pvd, n, pieces)) {
      files.push_back({seconds, thing.part, thing.named()});
    }
  };
  const auto count = static_cast<int>(lungs.frames.size());
  for (int n = 0; n < count; ++n) {
    const BreathFrame& frame = lungs.frames[static_cast<std::size_t>(n)];
    for (const FrameThing& thing : thingsOf(pvd, n, pieces)) {
      progress.throwIfStopped();
      writeThing(folder, thing, lungs, frame);
    }
    add(n, frame.phase * lungs.drive.period);
    progress.report(static_cast<double>(n + 1) / count);
  }
  add(0, lungs.drive.period);
  writeFile(folder / besides(pvd, ".csv"), csvOf(lungs));
  writeFile(folder / besides(pvd, ".json"),
            report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (pieces.surfaces.size() == 1) {
    writeFileSeries(folder / besides(pvd, SeriesEnding), files, SurfacePart);
  }
  writeTimeCollection(pvd, files);
}

}  // namespace pneuma
