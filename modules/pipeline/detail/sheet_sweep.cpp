#include "pipeline/detail/sheet_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "core/units.h"

namespace pneuma {
namespace {

constexpr double StepMm = 0.5;
constexpr double EnoughStrength = 15.0;  ///< HU / mm^2; a vessel's wall counts for no more
constexpr double StepCost = 0.2;         ///< of a step of 1 mm from place to place
constexpr double MostStepCost = 2.0;
constexpr std::size_t MostSteps = 6;  ///< beyond which a step costs MostStepCost
constexpr double RefineMm = 1.5;      ///< about the matched offset
constexpr double DrawnToZero = 0.002;
constexpr int FillRounds = 600;

constexpr std::array<std::array<int, 2>, 8> Ways = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};

template <class F>
void forEachNeighbour(const SurfaceGrid& grid, int column, int row, F&& f) {
  for (const auto& [dx, dy] : Ways) {
    if (column + dx < 0 || column + dx >= grid.width || row + dy < 0 || row + dy >= grid.height)
      continue;
    const std::size_t next = grid.at(column + dx, row + dy);
    if (grid.inside[next] != 0) f(next);
  }
}

/// Costs of every offset at every place, and their sums along eight ways.
class Matching {
 public:
  Matching(const SheetSampler& sheets, const SurfaceGrid& grid, const SheetSearch& search,
           const Progress& progress)
      : grid_(grid), half_(static_cast<int>(std::lround(search.reachMm / StepMm))) {
    count_ = static_cast<std::size_t>(2 * half_ + 1);
    cost_.resize(grid.places.size() * count_);
    sum_.resize(cost_.size());
    for (std::size_t n = 0; n <= MostSteps; ++n) {
      const double mm = StepMm * static_cast<double>(n);
      stepCost_.push_back(static_cast<float>(std::min(StepCost * mm * mm, MostStepCost)));
    }
    const double cosine = std::cos(radians(search.angleDeg));
    parallelFor(grid.places.size(), [&](std::size_t i) {
      if (grid.inside[i] == 0) return;
      progress.throwIfStopped();
      for (std::size_t n = 0; n < count_; ++n) {
        const Vec3 p = grid.places[i] + offset(n) * grid.normals[i];
        const double strength = sheets.strength(p, grid.normals[i], cosine);
        cost_[i * count_ + n] =
            static_cast<float>(-std::min(strength, EnoughStrength) / EnoughStrength);
      }
    });
    for (const auto& [dx, dy] : Ways) {
      progress.throwIfStopped();
      addWay(dx, dy);
    }
  }

  /// The offset at place i that costs least, mm.
  double best(std::size_t i) const {
    const auto first = sum_.begin() + static_cast<std::ptrdiff_t>(i * count_);
    return offset(static_cast<std::size_t>(
        std::min_element(first, first + static_cast<std::ptrdiff_t>(count_)) - first));
  }

 private:
  double offset(std::size_t n) const { return StepMm * (static_cast<double>(n) - half_); }

  /// Adds what paths in one direction cost that end at each place; they begin anew beyond places
  /// outside.
  void addWay(int dx, int dy) {
    std::vector<float> path(cost_.size(), 0.0F);
    for (int r = 0; r < grid_.height; ++r) {
      const int row = dy < 0 ? grid_.height - 1 - r : r;
      for (int c = 0; c < grid_.width; ++c) {
        const int column = dx < 0 ? grid_.width - 1 - c : c;
        const std::size_t i = grid_.at(column, row);
        if (grid_.inside[i] == 0) continue;
        const bool first = !isInside(column - dx, row - dy);
        step(first ? nullptr : path.data() + grid_.at(column - dx, row - dy) * count_,
             cost_.data() + i * count_, path.data() + i * count_);
      }
    }
    for (std::size_t n = 0; n < path.size(); ++n) sum_[n] += path[n];
  }

  bool isInside(int column, int row) const {
    return column >= 0 && column < grid_.width && row >= 0 && row < grid_.height &&
           grid_.inside[grid_.at(column, row)] != 0;
  }

  void step(const float* from, const float* cost, float* to) const {
    if (from == nullptr) {
      std::copy(cost, cost + count_, to);
      return;
    }
    const float least = *std::min_element(from, from + count_);
    for (std::size_t n = 0; n < count_; ++n) {
      float cheapest = least + static_cast<float>(MostStepCost);
      for (std::size_t m = n > MostSteps ? n - MostSteps : 0; m < count_ && m <= n + MostSteps;
           ++m) {
        cheapest = std::min(cheapest, from[m] + stepCost_[m > n ? m - n : n - m]);
      }
      to[n] = cost[n] + cheapest - least;
    }
  }

  const SurfaceGrid& grid_;
  int half_;
  std::size_t count_ = 0;
  std::vector<float> stepCost_;  ///< of 0, 1, 2 ... steps
  std::vector<float> cost_;
  std::vector<float> sum_;
};

/// Takes places off the sheet that hang together with few others, or lie away from them.
void dropSmall(const SurfaceGrid& grid, double coherenceMm, std::size_t leastTogether,
               Sweep& sweep) {
  DisjointSets sets(grid.places.size());
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const std::size_t i = grid.at(column, row);
      if (sweep.onSheet[i] == 0) continue;
      forEachNeighbour(grid, column, row, [&](std::size_t next) {
        if (sweep.onSheet[next] == 0) return;
        if (std::abs(sweep.offsetMm[next] - sweep.offsetMm[i]) > coherenceMm) return;
        sets.join(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(next));
      });
    }
  }
  std::map<std::uint32_t, std::size_t> size;
  for (std::size_t i = 0; i < grid.places.size(); ++i)
    ++size[sets.find(static_cast<std::uint32_t>(i))];
  for (std::size_t i = 0; i < grid.places.size(); ++i) {
    if (size[sets.find(static_cast<std::uint32_t>(i))] < leastTogether) sweep.onSheet[i] = 0;
  }
}

/// Gives places without a sheet what those around have: a membrane held where there is one, and
/// drawn a little towards zero everywhere else.
void fill(const SurfaceGrid& grid, Sweep& sweep) {
  for (std::size_t i = 0; i < grid.places.size(); ++i) {
    if (sweep.onSheet[i] == 0) sweep.offsetMm[i] = 0.0;
  }
  for (int round = 0; round < FillRounds; ++round) {
    for (int row = 0; row < grid.height; ++row) {
      for (int column = 0; column < grid.width; ++column) {
        const std::size_t i = grid.at(column, row);
        if (sweep.onSheet[i] != 0 || grid.inside[i] == 0) continue;
        double sum = 0.0;
        double count = DrawnToZero;
        forEachNeighbour(grid, column, row, [&](std::size_t next) {
          sum += sweep.offsetMm[next];
          count += 1.0;
        });
        sweep.offsetMm[i] = sum / count;
      }
    }
  }
}

}  // namespace

SurfaceGrid gridUpon(const HeightSurface& surface, const Box3& box, double spacingMm,
                     double reachMm, const FissureRegion& region) {
  Eigen::AlignedBox2d extent;
  for (int corner = 0; corner < 8; ++corner) {
    extent.extend(surface.planar(box.corner(static_cast<Box3::CornerType>(corner))));
  }
  SurfaceGrid grid;
  grid.width = static_cast<int>(extent.sizes().x() / spacingMm) + 1;
  grid.height = static_cast<int>(extent.sizes().y() / spacingMm) + 1;
  const auto rows = static_cast<std::size_t>(grid.height);
  const std::size_t count = static_cast<std::size_t>(grid.width) * rows;
  grid.places.resize(count);
  grid.normals.resize(count);
  grid.inside.resize(count);
  parallelFor(rows, [&](std::size_t row) {
    for (int column = 0; column < grid.width; ++column) {
      const std::size_t i = grid.at(column, static_cast<int>(row));
      const Vec2 uv = extent.min() + spacingMm * Vec2(column, static_cast<double>(row));
      grid.places[i] = surface.at(uv);
      grid.normals[i] = surface.normalAt(uv);
      for (double away = -reachMm; away <= reachMm && grid.inside[i] == 0; away += 1.0) {
        grid.inside[i] = region(grid.places[i] + away * grid.normals[i]) ? 1 : 0;
      }
    }
  });
  return grid;
}

Sweep sweepForSheet(const SheetSampler& sheets, const SurfaceGrid& grid, const SheetSearch& search,
                    std::size_t leastTogether, const Progress& progress) {
  Sweep sweep;
  sweep.offsetMm.assign(grid.places.size(), 0.0);
  sweep.onSheet.assign(grid.places.size(), 0);
  const Matching matching(sheets, grid, search, progress);
  SheetSearch close = search;
  close.reachMm = RefineMm;
  parallelFor(grid.places.size(), [&](std::size_t i) {
    if (grid.inside[i] == 0) return;
    progress.throwIfStopped();
    const double matched = matching.best(i);
    const Vec3 p = grid.places[i] + matched * grid.normals[i];
    const std::optional<double> found = coherentSheet(sheets, p, grid.normals[i], close);
    if (!found) return;
    sweep.offsetMm[i] = matched + *found;
    sweep.onSheet[i] = 1;
  });
  dropSmall(grid, search.coherenceMm, leastTogether, sweep);
  fill(grid, sweep);
  return sweep;
}

}  // namespace pneuma
