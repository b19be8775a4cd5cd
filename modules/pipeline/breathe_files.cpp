#include "pipeline/breathe_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/atomic_file.h"
#include "io/multiblock_file.h"
#include "io/surface_file.h"
#include "io/tree_file.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr int SurfacePart = 0;
constexpr int TreePart = 1;
constexpr int FirstOtherPiece = ChestWallPart + 1;  ///< the part of a second piece, of anything

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

/// The same before anything breathes.
FramePieces framePieces(const LungModel& model, const BreatheOptions& options,
                        std::uint64_t largestFileBytes) {
  TriangleMesh together;
  if (model.surfaces) {
    for (const LobeSurface& surface : *model.surfaces) append(together, *surface.mesh);
  }
  FramePieces pieces;
  pieces.surfaces = pieceEnds(together, largestFileBytes, FrameArrays);
  if (const auto tree = treeOf(model)) pieces.tree = pieceEnds(*tree, largestFileBytes);
  if (!hasChestWall(options)) return pieces;
  // Joining lobes takes as long as half of a breath; a wall is smaller than both lungs' lobes.
  pieces.chestWall = {1};
  if (pieces.surfaces.size() > 1) {
    pieces.chestWall = pieceEnds(chestWallOf(model, options), largestFileBytes, ChestWallArrays);
  }
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

/// The files of a frame, as the collection names them.
std::vector<TimedFile> filesOf(const fs::path& pvd, int frame, double seconds,
                               const FramePieces& pieces) {
  std::vector<TimedFile> files;
  int other = FirstOtherPiece;
  const auto add = [&](const fs::path& whole, int part, const std::vector<std::size_t>& ends) {
    if (ends.empty()) return;
    for (const fs::path& file : pieceFiles(whole, ends.size())) {
      files.push_back({seconds, part, file});
      part = other++;
    }
    --other;
  };
  add(surfaceFile(pvd, frame), SurfacePart, pieces.surfaces);
  add(treeFile(pvd, frame), TreePart, pieces.tree);
  add(chestWallFile(pvd, frame), ChestWallPart, pieces.chestWall);
  return files;
}

}  // namespace

std::vector<fs::path> breathOutputs(const fs::path& pvd, const LungModel& model,
                                    const BreatheOptions& options, std::uint64_t largestFileBytes) {
  const FramePieces pieces = framePieces(model, options, largestFileBytes);
  std::vector<fs::path> files = {pvd.filename(), besides(pvd, ".csv"), besides(pvd, ".json")};
  if (pieces.surfaces.size() == 1) files.push_back(besides(pvd, ".vtp.series"));
  for (int n = 0; n < options.frames; ++n) {
    for (const TimedFile& file : filesOf(pvd, n, 0.0, pieces)) files.push_back(file.file);
  }
  return files;
}

void writeBreath(const fs::path& pvd, const BreathingLungs& lungs, const Json& report,
                 const Progress& progress, std::uint64_t largestFileBytes) {
  const fs::path folder = pvd.parent_path();
  const FramePieces pieces = framePieces(lungs, largestFileBytes);
  std::vector<TimedFile> files;
  const auto add = [&](int n, double seconds) {
    const std::vector<TimedFile> more = filesOf(pvd, n, seconds, pieces);
    files.insert(files.end(), more.begin(), more.end());
  };
  const auto count = static_cast<int>(lungs.frames.size());
  for (int n = 0; n < count; ++n) {
    const BreathFrame& frame = lungs.frames[static_cast<std::size_t>(n)];
    writeFrame(folder / surfaceFile(pvd, n), lungs, frame, pieces.surfaces);
    if (lungs.tree) {
      writeTreePieces(folder / treeFile(pvd, n), treeAt(lungs, frame), {}, pieces.tree);
    }
    if (lungs.chestWall) {
      writeChestWall(folder / chestWallFile(pvd, n), *lungs.chestWall, frame, pieces.chestWall);
    }
    add(n, frame.phase * lungs.drive.period);
    progress.report(static_cast<double>(n + 1) / count);
  }
  add(0, lungs.drive.period);
  writeFile(folder / besides(pvd, ".csv"), csvOf(lungs));
  writeFile(folder / besides(pvd, ".json"),
            report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  if (pieces.surfaces.size() == 1) {
    writeFileSeries(folder / besides(pvd, ".vtp.series"), files, SurfacePart);
  }
  writeTimeCollection(pvd, files);
}

}  // namespace pneuma
