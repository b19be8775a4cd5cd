#include "pipeline/stage_needs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.h"
#include "core/memory.h"
#include "core/options.h"

namespace pneuma {
namespace {

/// still + byVoxels n + byLungs m + bySurface m^(2/3), with n millions of voxels and m of lungs.
struct Law {
  double still;
  double byVoxels;
  double byLungs;
  double bySurface;
};

struct StageLaws {
  std::string_view stage;
  Law megabytes;
  Law seconds;
};

/// Millions of voxels.
struct VoxelCounts {
  double all = 0.0;
  double ofLungs = 0.0;  ///< at most
};

constexpr std::array<StageLaws, 10> Laws = {{
    {"info", {110.0, 2.7, 0.0, 0.0}, {0.5, 0.04, 0.0, 0.0}},
    {"import", {70.0, 2.1, 0.0, 0.0}, {0.3, 0.05, 0.0, 0.0}},
    {"segment", {100.0, 2.25, 15.5, 0.0}, {0.6, 0.05, 0.45, 0.0}},
    {"lobes", {140.0, 5.2, 10.5, 0.0}, {1.0, 0.1, 0.4, 0.0}},
    {"grow", {180.0, 0.0, 0.0, 41.0}, {3.5, 0.0, 0.0, 1.3}},
    {"measure", {180.0, 0.0, 0.0, 41.0}, {1.0, 0.0, 0.0, 0.9}},
    {"breathe", {170.0, 0.0, 0.0, 168.0}, {1.5, 0.0, 0.0, 5.2}},
    {"render", {460.0, 0.0, 0.0, 14.0}, {1.2, 0.0, 0.0, 1.0}},
    {"slices", {75.0, 3.0, 0.0, 0.0}, {0.5, 0.02, 0.0, 0.0}},
    {"report", {555.0, 0.0, 0.0, 30.0}, {3.5, 0.0, 0.0, 1.2}},
}};

constexpr double Million = 1e6;
/// Laws are rounded up: what takes less than this share of what they say may still fit.
constexpr double LeastShare = 0.85;
constexpr double LargestSideMm = 5.0;
constexpr double LargeLungsMm3 = 7e6;
/// Of a CT that is cropped to the lungs.
constexpr double MostOfACt = 0.5;
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

double valueOf(const Law& law, const VoxelCounts& voxels) {
  return law.still + law.byVoxels * voxels.all + law.byLungs * voxels.ofLungs +
         law.bySurface * std::cbrt(voxels.ofLungs * voxels.ofLungs);
}

VoxelCounts voxelCounts(const ImageGeometry& geometry, double sideMm) {
  const double all = voxelsAt(geometry, sideMm) / Million;
  const double voxelMm3 = sideMm > 0.0 ? sideMm * sideMm * sideMm : geometry.spacing.prod();
  return {all, std::min(MostOfACt * all, LargeLungsMm3 / voxelMm3 / Million)};
}

StageNeed needFor(const StageLaws& laws, const VoxelCounts& voxels) {
  return {laws.stage, static_cast<std::uint64_t>(valueOf(laws.megabytes, voxels) * Million),
          valueOf(laws.seconds, voxels),
          voxels.all < VoxelsForTwo    ? 1
          : voxels.all < VoxelsForFour ? 2
                                       : 4};
}

/// Where a stage reads and resamples the CT itself.
std::uint64_t bytesWithImport(std::string_view stage, const ImageGeometry& geometry,
                              double sideMm) {
  return std::max(stageNeed(stage, geometry, sideMm).bytes,
                  stageNeed("import", geometry, sideMm).bytes);
}

bool fits(std::uint64_t needed, std::uint64_t bytes) {
  return LeastShare * static_cast<double>(needed) <= static_cast<double>(bytes);
}

std::string sizeText(const ImageGeometry& geometry) {
  return std::to_string(geometry.size[0]) + " x " + std::to_string(geometry.size[1]) + " x " +
         std::to_string(geometry.size[2]) + " voxels";
}

}  // namespace

std::vector<StageNeed> stageNeeds(const ImageGeometry& geometry, double sideMm) {
  std::vector<StageNeed> needs;
  for (const StageLaws& laws : Laws) {
    VoxelCounts voxels = voxelCounts(geometry, sideMm);
    if (sideMm > 0.0 && laws.stage == "info") voxels = voxelCounts(geometry, 0.0);
    if (sideMm > 0.0 && laws.stage == "import") {
      voxels.all = voxelsMeanwhile(geometry, sideMm) / Million;
    }
    needs.push_back(needFor(laws, voxels));
  }
  return needs;
}

StageNeed stageNeed(std::string_view stage, const ImageGeometry& geometry, double sideMm) {
  for (const StageNeed& need : stageNeeds(geometry, sideMm)) {
    if (need.stage == stage) return need;
  }
  throw std::out_of_range("there is no stage " + std::string(stage));
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
    if (fits(bytesWithImport(stage, geometry, side), bytes)) return side;
  }
  return {};
}

void requireStageFits(std::string_view stage, const std::string& what,
                      const ImageGeometry& geometry, double sideMm) {
  const std::uint64_t available = availableMemoryBytes();
  const std::uint64_t needed = bytesWithImport(stage, geometry, sideMm);
  if (available == 0 || fits(needed, available)) return;
  const std::optional<double> side = sideThatFits(stage, geometry, available);
  std::string text = what + " takes about " + megabytes(needed) + " of memory for " +
                     sizeText(geometry) + ", and " + megabytes(available) + " are left; ";
  if (side) {
    text += "with voxels of " + textOf(*side) + " mm (--resample " + textOf(*side) +
            ") it fits; or " + adviceForMemory();
  } else {
    text += "no coarser voxels would fit either";
    if (!fits(stageNeed("import", geometry, 0.0).bytes, available)) {
      text += ", as it has to be read first";
    }
    text += "; " + adviceForMemory();
  }
  throw Error(ExitCode::OutOfMemory, text);
}

}  // namespace pneuma
