#include "pipeline/stage_needs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "core/memory.h"
#include "core/options.h"

namespace pneuma {
namespace {

/// megabytes = still + byVoxels n + bySurface n^(2/3), with n in millions of voxels; seconds alike.
struct Law {
  std::string_view stage;
  double stillMb;
  double byVoxelsMb;
  double bySurfaceMb;
  double stillSeconds;
  double byVoxelsSeconds;
  double bySurfaceSeconds;
};

constexpr std::array<Law, 10> Laws = {{
    {"info", 110.0, 2.2, 0.0, 0.5, 0.02, 0.0},
    {"import", 70.0, 2.1, 0.0, 0.3, 0.03, 0.0},
    {"segment", 85.0, 4.4, 0.0, 0.5, 0.06, 0.0},
    {"lobes", 130.0, 8.2, 0.0, 1.0, 0.14, 0.0},
    {"grow", 150.0, 0.0, 11.5, 3.0, 0.0, 0.25},
    {"measure", 150.0, 0.0, 11.5, 1.0, 0.0, 0.15},
    {"breathe", 80.0, 0.0, 42.0, 1.0, 0.0, 0.9},
    {"render", 460.0, 0.0, 5.0, 1.0, 0.0, 0.15},
    {"slices", 75.0, 3.0, 0.0, 0.5, 0.01, 0.0},
    {"report", 480.0, 0.0, 12.0, 3.0, 0.0, 0.2},
}};

constexpr double Million = 1e6;
/// Laws are rounded up: what takes less than this share of what they say may still fit.
constexpr double LeastShare = 0.85;
constexpr double LargestSideMm = 5.0;
/// Below these many millions of voxels a second thread gains less than a second case does.
constexpr double VoxelsForTwo = 150.0;
constexpr double VoxelsForFour = 400.0;

std::string megabytes(std::uint64_t bytes) {
  return std::to_string(static_cast<std::uint64_t>(static_cast<double>(bytes) / Million)) + " MB";
}

/// Voxels along each axis after it was resampled.
std::array<double, 3> sizeAt(const ImageGeometry& geometry, double sideMm) {
  std::array<double, 3> size{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double length = geometry.size[a] * geometry.spacing[static_cast<Eigen::Index>(a)];
    size[a] = sideMm > 0.0 ? std::max(1.0, std::round(length / sideMm)) : geometry.size[a];
  }
  return size;
}

/// Voxels that are there at once while a CT is resampled axis by axis, as resampled() does it.
double voxelsMeanwhile(const ImageGeometry& geometry, double sideMm) {
  const std::array<double, 3> to = sizeAt(geometry, sideMm);
  std::array<double, 3> shares{};
  for (std::size_t a = 0; a < 3; ++a) shares[a] = to[a] / geometry.size[a];
  std::ranges::sort(shares);
  const double asRead = static_cast<double>(geometry.voxelCount());
  double most = 0.0;
  double before = 0.0;
  double after = asRead;
  for (const double share : shares) {
    after *= share;
    most = std::max(most, before + after);
    before = after;
  }
  return asRead + most;
}

StageNeed needOf(std::span<const StageNeed> needs, std::string_view stage) {
  const auto need = std::ranges::find(needs, stage, &StageNeed::stage);
  if (need == needs.end()) throw std::out_of_range("there is no stage " + std::string(stage));
  return *need;
}

/// Where a stage reads and resamples the CT itself.
std::uint64_t bytesWithImport(std::string_view stage, const ImageGeometry& geometry,
                              double sideMm) {
  return std::max(stageNeed(stage, geometry, sideMm).bytes,
                  stageNeed("import", geometry, sideMm).bytes);
}

std::string sizeText(const ImageGeometry& geometry) {
  return std::to_string(geometry.size[0]) + " x " + std::to_string(geometry.size[1]) + " x " +
         std::to_string(geometry.size[2]) + " voxels";
}

}  // namespace

std::vector<StageNeed> stageNeeds(double voxels) {
  const double volume = std::max(voxels, 0.0) / Million;
  const double surface = std::cbrt(volume * volume);
  std::vector<StageNeed> needs;
  for (const Law& law : Laws) {
    const double mb = law.stillMb + law.byVoxelsMb * volume + law.bySurfaceMb * surface;
    needs.push_back(
        {law.stage, static_cast<std::uint64_t>(mb * Million),
         law.stillSeconds + law.byVoxelsSeconds * volume + law.bySurfaceSeconds * surface,
         volume < VoxelsForTwo    ? 1
         : volume < VoxelsForFour ? 2
                                  : 4});
  }
  return needs;
}

StageNeed stageNeed(std::string_view stage, double voxels) {
  return needOf(stageNeeds(voxels), stage);
}

std::vector<StageNeed> stageNeeds(const ImageGeometry& geometry, double sideMm) {
  std::vector<StageNeed> needs = stageNeeds(voxelsAt(geometry, sideMm));
  if (sideMm <= 0.0) return needs;
  for (StageNeed& need : needs) {
    if (need.stage == "info") need = stageNeed("info", voxelsAt(geometry, 0.0));
    if (need.stage == "import") need = stageNeed("import", voxelsMeanwhile(geometry, sideMm));
  }
  return needs;
}

StageNeed stageNeed(std::string_view stage, const ImageGeometry& geometry, double sideMm) {
  return needOf(stageNeeds(geometry, sideMm), stage);
}

Json toJson(std::span<const StageNeed> needs) {
  Json json = Json::object();
  for (const StageNeed& need : needs) {
    json[std::string(need.stage)] = {
        {"memory_mb", std::ceil(static_cast<double>(need.bytes) / Million)},
        {"seconds", std::ceil(need.seconds)},
        {"threads", need.threads}};
  }
  return json;
}

double voxelsAt(const ImageGeometry& geometry, double sideMm) {
  const std::array<double, 3> size = sizeAt(geometry, sideMm);
  return size[0] * size[1] * size[2];
}

std::optional<double> sideThatFits(std::string_view stage, const ImageGeometry& geometry,
                                   std::uint64_t bytes) {
  for (int tenths = 1; tenths <= static_cast<int>(LargestSideMm * 10.0); ++tenths) {
    const double side = tenths / 10.0;
    if (voxelsAt(geometry, side) >= voxelsAt(geometry, 0.0)) continue;
    if (bytesWithImport(stage, geometry, side) <= bytes) return side;
  }
  return {};
}

void requireStageFits(std::string_view stage, const std::string& what,
                      const ImageGeometry& geometry, double sideMm) {
  const std::uint64_t available = availableMemoryBytes();
  const std::uint64_t needed = bytesWithImport(stage, geometry, sideMm);
  if (available == 0 ||
      LeastShare * static_cast<double>(needed) <= static_cast<double>(available)) {
    return;
  }
  const std::optional<double> side = sideThatFits(stage, geometry, available);
  std::string text = what + " takes about " + megabytes(needed) + " of memory for " +
                     sizeText(geometry) + ", and " + megabytes(available) + " are left; ";
  if (side) {
    text += "with voxels of " + textOf(*side) + " mm (--resample " + textOf(*side) +
            ") it fits, or use a machine with more";
  } else {
    text +=
        "no coarser voxels would fit either, as it has to be read first; use a machine with more";
  }
  throw Error(ExitCode::OutOfMemory, text);
}

}  // namespace pneuma
