#include "segmentation/lung_air.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/units.h"
#include "segmentation/lung_labels.h"
#include "segmentation/lung_separation.h"

namespace pneuma {
namespace {

constexpr double MarginMm = 1.4;  ///< around airways, in plane: their walls are no lung
constexpr double LeastLungMl = 100.0;
constexpr double LeastShare = 0.15;  ///< of the smaller lung, to the larger
constexpr double CrumbMl = 1.0;      ///< smaller spaces of air do not count
constexpr double OneSidedMm = 20.0;  ///< the centre of a single lung lies this far from the middle

/// Marks what lies within the margin of the airways' voxels, and in the slices above and below.
void widen(const std::vector<std::uint32_t>& airways, LabelImage& labels) {
  const ImageGeometry& geometry = labels.geometry;
  const int reachX = static_cast<int>(MarginMm / geometry.spacing.x());
  const int reachY = static_cast<int>(MarginMm / geometry.spacing.y());
  std::vector<std::array<int, 3>> steps = {{0, 0, -1}, {0, 0, 1}};
  for (int dy = -reachY; dy <= reachY; ++dy) {
    for (int dx = -reachX; dx <= reachX; ++dx) {
      const double away = std::hypot(dx * geometry.spacing.x(), dy * geometry.spacing.y());
      if (away > 0.0 && away <= MarginMm) steps.push_back({dx, dy, 0});
    }
  }
  const std::size_t slice = geometry.sliceCount();
  for (const std::uint32_t v : airways) {
    const auto k = static_cast<int>(v / slice);
    const auto j = static_cast<int>(v % slice / static_cast<std::size_t>(geometry.size[0]));
    const auto i = static_cast<int>(v % slice % static_cast<std::size_t>(geometry.size[0]));
    for (const auto& [dx, dy, dz] : steps) {
      const int x = i + dx;
      const int y = j + dy;
      const int z = k + dz;
      if (x < 0 || y < 0 || z < 0 || x >= geometry.size[0] || y >= geometry.size[1] ||
          z >= geometry.size[2]) {
        continue;
      }
      labels.at(x, y, z) = 1;
    }
  }
}

/// The runs of the inner air without what is marked.
VoxelRuns unmarked(const VoxelRuns& air, const LabelImage& labels) {
  VoxelRuns rest{air.size, {}, {0}};
  rest.rowStart.reserve(air.rowStart.size());
  rest.runs.reserve(air.runs.size());
  for (std::size_t row = 0; row < air.rowCount(); ++row) {
    const std::uint8_t* marks = labels.voxels.data() + air.rowVoxel(row);
    for (std::uint32_t r = air.rowStart[row]; r < air.rowStart[row + 1]; ++r) {
      int i = air.runs[r].first;
      while (i < air.runs[r].end) {
        while (i < air.runs[r].end && marks[i] != 0) ++i;
        if (i == air.runs[r].end) break;
        VoxelRun run{i, i};
        while (i < air.runs[r].end && marks[i] == 0) ++i;
        run.end = i;
        rest.runs.push_back(run);
      }
    }
    rest.rowStart.push_back(static_cast<std::uint32_t>(rest.runs.size()));
  }
  return rest;
}

void paint(const VoxelRuns& runs, const VoxelComponents& parts, std::size_t part,
           std::uint8_t label, LabelImage& labels) {
  fillRuns(
      runs, [&](std::uint32_t r) { return parts.ofRun[r] == part; }, label, labels.voxels);
}

/// Cuts one part that is both lungs and returns the bridge's radius; none if it does not fall in
/// two.
std::optional<double> cutAndPaint(const VoxelRuns& runs, const VoxelComponents& parts,
                                  std::size_t part, double middle, LabelImage& labels,
                                  const Progress& progress) {
  const VoxelComponent& whole = parts.all[part];
  const VoxelBox box = within(boxAround(whole.low, whole.high), labels.geometry);
  std::vector<std::uint8_t> set(box.voxelCount(), 0);
  const auto rows = static_cast<std::size_t>(runs.size[1]);
  for (int k = whole.low.z(); k <= whole.high.z(); ++k) {
    forEachRun(runs, k, [&](std::size_t row, const VoxelRun& run, std::uint32_t r) {
      if (parts.ofRun[r] != part) return;
      const std::size_t at = box.index(run.first - box.low.x(),
                                       static_cast<int>(row % rows) - box.low.y(), k - box.low.z());
      std::fill_n(set.begin() + static_cast<std::ptrdiff_t>(at), run.end - run.first,
                  std::uint8_t{1});
    });
  }
  const Separation separation = separateLungs(box, labels.geometry.spacing, middle, set, progress);
  if (!separation.done) return std::nullopt;
  forEachRow(box, labels.geometry, [&](std::size_t at, std::size_t v, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (set[at + i] != 0) labels.voxels[v + i] = set[at + i] == 1 ? RightLabel : LeftLabel;
    }
  });
  return separation.radiusMm;
}

/// Air of all spaces but the lungs, at the height of the upper two thirds of the largest, and not
/// beside them: the foam of a table is air too.
double elsewhereMl(const VoxelComponents& parts, const std::vector<std::size_t>& order,
                   std::size_t second, double voxelMl) {
  const VoxelComponent& first = parts.all[order[0]];
  const double least = first.low.z() + (first.high.z() - first.low.z()) / 3.0;
  Eigen::AlignedBox2i across(first.low.head<2>(), first.high.head<2>());
  if (second > 0 && second < order.size()) {
    across.extend(parts.all[order[second]].low.head<2>());
    across.extend(parts.all[order[second]].high.head<2>());
  }
  double sum = 0.0;
  for (std::size_t n = 1; n < order.size(); ++n) {
    const VoxelComponent& part = parts.all[order[n]];
    const double ml = static_cast<double>(part.voxels) * voxelMl;
    if (ml < CrumbMl) break;
    const Vec3 centre = part.centre();
    if (n == second || centre.z() < least) continue;
    if (across.contains(centre.head<2>().cast<int>())) sum += ml;
  }
  return sum;
}

}  // namespace

LungAir findLungAir(const CtImage& ct, const InnerAir& air, const AirwayMask& airways,
                    LabelImage& labels, const Progress& progress) {
  widen(airways.voxels, labels);
  const VoxelRuns runs = unmarked(air.runs, labels);
  const VoxelComponents parts = components(runs, Connection::InVolume);
  const std::vector<std::size_t> order = parts.bySize();
  const double voxelMl = millilitres(ct.geometry.voxelMm3());
  const auto ml = [&](std::size_t n) {
    return n < order.size() ? static_cast<double>(parts.all[order[n]].voxels) * voxelMl : 0.0;
  };
  if (ml(0) < LeastLungMl) {
    throw InvalidInput(
        "there are no lungs to be found: the largest space of air inside the body has " +
        std::to_string(static_cast<int>(ml(0))) +
        " ml; check that the CT shows a chest, in Hounsfield units, and the threshold");
  }
  std::fill(labels.voxels.begin(), labels.voxels.end(), std::uint8_t{0});
  progress.report(0.2);
  const double middle = airways.finding.found ? airways.tracheaCentre.x() : air.bodyCentre;
  const auto fromMiddleMm = [&](std::size_t n) {
    return (parts.all[order[n]].centre().x() - middle) * ct.geometry.spacing.x();
  };
  const auto labelOf = [&](std::size_t n) {
    return fromMiddleMm(n) < 0.0 ? RightLabel : LeftLabel;
  };

  const VoxelComponent& first = parts.all[order[0]];
  // Bowel may be larger than a share of a lung, but does not reach to its middle.
  std::size_t second = 1;
  while (second < order.size() && ml(second) >= LeastShare * ml(0) &&
         parts.all[order[second]].high.z() < first.centre().z()) {
    ++second;
  }
  const bool twoLungs = ml(second) >= std::max(LeastShare * ml(0), LeastLungMl) &&
                        std::abs(fromMiddleMm(0)) > OneSidedMm &&
                        std::abs(fromMiddleMm(second)) > OneSidedMm &&
                        labelOf(0) != labelOf(second);
  if (twoLungs) {
    paint(runs, parts, order[0], labelOf(0), labels);
    paint(runs, parts, order[second], labelOf(second), labels);
    return {.middle = middle, .elsewhereMl = elsewhereMl(parts, order, second, voxelMl)};
  }
  const double elsewhere = elsewhereMl(parts, order, 0, voxelMl);
  const std::optional<double> bridge =
      cutAndPaint(runs, parts, order[0], middle, labels, progress.part(0.2, 1.0, "separating"));
  if (bridge) return {.bridgeMm = *bridge, .middle = middle, .elsewhereMl = elsewhere};
  // One lung alone, or two that are one: then the middle has to do.
  const bool single = std::abs(fromMiddleMm(0)) > OneSidedMm &&
                      (first.low.x() - middle) * (first.high.x() - middle) > 0.0;
  paint(runs, parts, order[0], single ? labelOf(0) : LeftLabel, labels);
  if (single) return {.middle = middle, .elsewhereMl = elsewhere};
  const int cut = static_cast<int>(std::lround(middle));
  for (std::size_t v = 0; v < labels.voxels.size(); ++v) {
    const auto i = static_cast<int>(v % static_cast<std::size_t>(ct.geometry.size[0]));
    if (labels.voxels[v] == LeftLabel && i < cut) labels.voxels[v] = RightLabel;
  }
  return {.separated = false, .middle = middle, .elsewhereMl = elsewhere};
}

}  // namespace pneuma
