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

/// All surfaces at a moment as one.
void writeFrame(const fs::path& path, const BreathingLungs& lungs, const BreathFrame& frame) {
  TriangleMesh together;
  SurfaceArrays arrays;
  std::vector<Vec3>& displacement = arrays.pointVectors["displacement"];
  std::vector<double>& force = arrays.pointValues["F"];
  std::vector<double>& change = arrays.pointValues["volume_change"];
  std::vector<double>& strain = arrays.pointValues["strain"];
  std::vector<std::uint8_t>& lobe = arrays.triangleMarks["lobe"];
  for (const MovingSurface& surface : lungs.surfaces) {
    const double s = frame.scale.at(surface.side);
    const auto first = static_cast<std::uint32_t>(together.points.size());
    const TriangleMesh& mesh = *surface.surface.mesh;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      const Vec3& u = surface.displacement[n];
      const auto& c = surface.volumeChange[n];
      const double determinant = 1.0 + s * (c[0] + s * (c[1] + s * c[2]));
      together.points.push_back(mesh.points[n] + s * u);
      displacement.push_back(s * u);
      force.push_back(u.norm());
      change.push_back(determinant);
      strain.push_back(std::cbrt(determinant) - 1.0);
    }
    for (const auto& triangle : mesh.triangles) {
      together.triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
      lobe.push_back(static_cast<std::uint8_t>(surface.surface.lobe));
    }
  }
  arrays.fieldValues["phase"] = frame.phase;
  writeVtpSurface(path, together, arrays);
}

void writeChestWall(const fs::path& path, const LungMotion& chest, const BreathFrame& frame) {
  TriangleMesh moved = chest.wall();
  SurfaceArrays arrays;
  std::vector<Vec3>& displacement = arrays.pointVectors["displacement"];
  for (std::size_t n = 0; n < moved.points.size(); ++n) {
    displacement.push_back(frame.chestWallScale * chest.ofWall()[n]);
    moved.points[n] += displacement.back();
  }
  arrays.fieldValues["phase"] = frame.phase;
  writeVtpSurface(path, moved, arrays);
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

}  // namespace

std::vector<fs::path> breathOutputs(const fs::path& pvd, const BreatheOptions& options, bool tree) {
  std::vector<fs::path> files = {pvd.filename(), besides(pvd, ".csv"), besides(pvd, ".json"),
                                 besides(pvd, ".vtp.series")};
  for (int n = 0; n < options.frames; ++n) {
    files.push_back(surfaceFile(pvd, n));
    if (tree) files.push_back(treeFile(pvd, n));
    if (hasChestWall(options)) files.push_back(chestWallFile(pvd, n));
  }
  return files;
}

void writeBreath(const fs::path& pvd, const BreathingLungs& lungs, const Json& report,
                 const Progress& progress) {
  const fs::path folder = pvd.parent_path();
  std::vector<TimedFile> files;
  const auto count = static_cast<int>(lungs.frames.size());
  for (int n = 0; n < count; ++n) {
    const BreathFrame& frame = lungs.frames[static_cast<std::size_t>(n)];
    const double seconds = frame.phase * lungs.drive.period;
    writeFrame(folder / surfaceFile(pvd, n), lungs, frame);
    files.push_back({seconds, SurfacePart, surfaceFile(pvd, n)});
    if (lungs.tree) {
      writeTree(folder / treeFile(pvd, n), treeAt(lungs, frame));
      files.push_back({seconds, TreePart, treeFile(pvd, n)});
    }
    if (lungs.chestWall) {
      writeChestWall(folder / chestWallFile(pvd, n), *lungs.chestWall, frame);
      files.push_back({seconds, ChestWallPart, chestWallFile(pvd, n)});
    }
    progress.report(static_cast<double>(n + 1) / count);
  }
  files.push_back({lungs.drive.period, SurfacePart, surfaceFile(pvd, 0)});
  if (lungs.tree) files.push_back({lungs.drive.period, TreePart, treeFile(pvd, 0)});
  if (lungs.chestWall) {
    files.push_back({lungs.drive.period, ChestWallPart, chestWallFile(pvd, 0)});
  }
  writeFile(folder / besides(pvd, ".csv"), csvOf(lungs));
  writeFile(folder / besides(pvd, ".json"),
            report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  writeFileSeries(folder / besides(pvd, ".vtp.series"), files, SurfacePart);
  writeTimeCollection(pvd, files);
}

}  // namespace pneuma
