#include "segmentation/airway_wavefront.h"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <queue>

#include "core/units.h"

namespace pneuma {
namespace {

// A step of the front.
constexpr double LeastStepMm = 1.5;
// A leak: the front grows over its narrowest by this factor and this much.
constexpr double LeakRatio = 1.6;
constexpr double LeakMm2 = 6.0;
constexpr double LeakMl = 5.0;  ///< no single step may add more
// A branch is followed again under a threshold lower by this, down to that.
constexpr double ThresholdStepHu = 25.0;
constexpr double LowestThresholdHu = -950.0;
constexpr int RingVoxels = 2;  ///< around the front, in plane, where the wall is looked for

enum State : std::uint8_t { Free = 0, Base = 1, Followed = 2, OfBase = 3 };

struct Front {
  float distance = 0.0F;  ///< geodesic, from the root, mm
  std::uint32_t voxel = 0;

  bool operator>(const Front& other) const {
    return distance != other.distance ? distance > other.distance : voxel > other.voxel;
  }
};

/// What waits to be reached, nearest on top.
using Heap = std::priority_queue<Front, std::vector<Front>, std::greater<>>;

/// Where a branch begins.
struct Start {
  std::vector<Front> heap;
  double narrowestMm2 = std::numeric_limits<double>::infinity();
};

struct Neighbour {
  std::array<int, 3> step{};
  std::ptrdiff_t offset = 0;
  float lengthMm = 0.0F;
};

class Follower {
 public:
  Follower(const CtImage& ct, const WavefrontOptions& options, std::vector<std::uint8_t>& state,
           const Progress& progress)
      : ct_(ct),
        geometry_(ct.geometry),
        options_(options),
        progress_(progress),
        state_(state),
        stepMm_(std::max(ct.geometry.spacing.z(), LeastStepMm)),
        width_(static_cast<std::size_t>(geometry_.size[0])),
        slice_(geometry_.sliceCount()) {
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (dx == 0 && dy == 0 && dz == 0) continue;
          const Vec3 step = Vec3(dx, dy, dz).cwiseProduct(geometry_.spacing);
          neighbours_.push_back({{dx, dy, dz},
                                 dx + static_cast<std::ptrdiff_t>(width_) * dy +
                                     static_cast<std::ptrdiff_t>(slice_) * dz,
                                 static_cast<float>(step.norm())});
        }
      }
    }
  }

  Wavefront follow(const std::vector<std::uint32_t>& top) {
    topSlice_ = static_cast<int>(top.front() / slice_);
    Start first;
    for (const std::uint32_t v : top) first.heap.push_back({0.0F, v});
    starts_.push_back(std::move(first));
    while (!starts_.empty()) {
      const Start start = std::move(starts_.front());
      starts_.pop_front();
      followBranch(start);
    }
    return std::move(result_);
  }

 private:
  enum class Trip { None, Leak, NoWall };

  void followBranch(const Start& start) {
    double threshold = options_.thresholdHu;
    while (true) {
      const bool last = threshold - ThresholdStepHu < LowestThresholdHu;
      const Trip trip = tryBranch(start, threshold, last);
      if (trip == Trip::None) return;
      ++(trip == Trip::Leak ? result_.leaksUndone : result_.wallsMissed);
      if (last) return;
      threshold -= ThresholdStepHu;
    }
  }

  /// Follows a branch to its end, or to where it falls into parts, which become starts. Unless it
  /// is the `last` attempt a branch that trips is taken back whole.
  Trip tryBranch(const Start& start, double threshold, bool last) {
    Heap heap(std::greater<>{}, start.heap);
    double narrowest = start.narrowestMm2;
    std::vector<Front> branch;
    while (true) {
      progress_.throwIfStopped();
      const std::vector<Front> front = takeStep(heap, threshold);
      if (front.empty()) break;
      const Trip trip = examine(front, narrowest);
      if (trip != Trip::None) {
        release(front);
        if (last) {
          keep(branch);
        } else {
          release(branch);
        }
        return trip;
      }
      branch.insert(branch.end(), front.begin(), front.end());
      std::vector<Start> parts = split(front, heap, narrowest);
      if (parts.size() > 1) {
        starts_.insert(starts_.end(), std::make_move_iterator(parts.begin()),
                       std::make_move_iterator(parts.end()));
        break;
      }
    }
    keep(branch);
    return Trip::None;
  }

  bool isAir(std::size_t voxel, double threshold) const {
    return state_[voxel] == Base || (state_[voxel] == Free && ct_.voxels[voxel] < threshold &&
                                     ct_.voxels[voxel] >= PaddingBelowHu);
  }

  template <class F>
  void forEachNeighbour(std::uint32_t voxel, F&& f) const {
    const auto k = static_cast<int>(voxel / slice_);
    const std::size_t inSlice = voxel % slice_;
    const auto j = static_cast<int>(inSlice / width_);
    const auto i = static_cast<int>(inSlice % width_);
    const auto& size = geometry_.size;
    for (const Neighbour& n : neighbours_) {
      const int x = i + n.step[0];
      const int y = j + n.step[1];
      const int z = k + n.step[2];
      if (x < 0 || y < 0 || z < 0 || x >= size[0] || y >= size[1] || z > topSlice_) continue;
      f(static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(voxel) + n.offset), n);
    }
  }

  /// All that is reached within one step; it is marked as taken.
  std::vector<Front> takeStep(Heap& heap, double threshold) {
    std::vector<Front> front;
    float until = -1.0F;
    while (!heap.empty()) {
      const Front next = heap.top();
      if (!isAir(next.voxel, threshold)) {
        heap.pop();
        continue;
      }
      if (until < 0.0F) until = next.distance + static_cast<float>(stepMm_);
      if (next.distance >= until) break;
      heap.pop();
      state_[next.voxel] = state_[next.voxel] == Base ? OfBase : Followed;
      front.push_back(next);
      forEachNeighbour(next.voxel, [&](std::uint32_t v, const Neighbour& n) {
        if (isAir(v, threshold)) heap.push({next.distance + n.lengthMm, v});
      });
    }
    return front;
  }

  Trip examine(const std::vector<Front>& front, double& narrowest) {
    std::size_t beyond = 0;
    double lumen = 0.0;
    for (const Front& f : front) {
      if (state_[f.voxel] == Followed) ++beyond;
      lumen += ct_.voxels[f.voxel];
    }
    const double volume = static_cast<double>(front.size()) * geometry_.voxelMm3();
    const double area = volume / stepMm_;
    if (2 * beyond < front.size()) {
      narrowest = std::min(narrowest, area);
      return Trip::None;  // what flooded needs no guard
    }
    const double ml = millilitres(volume);
    if (area > LeakRatio * narrowest + LeakMm2 || ml > LeakMl) return Trip::Leak;
    lumen /= static_cast<double>(front.size());
    if (ringHu(front) - lumen < options_.wallContrastHu) return Trip::NoWall;
    narrowest = std::min(narrowest, area);
    ++result_.stepsFollowed;
    result_.largestStepMl = std::max(result_.largestStepMl, ml);
    return Trip::None;
  }

  /// Mean density around the front in its slices.
  double ringHu(const std::vector<Front>& front) {
    ring_.clear();
    for (const Front& f : front) {
      const std::size_t inSlice = f.voxel % slice_;
      const auto j = static_cast<int>(inSlice / width_);
      const auto i = static_cast<int>(inSlice % width_);
      for (int dy = -RingVoxels; dy <= RingVoxels; ++dy) {
        for (int dx = -RingVoxels; dx <= RingVoxels; ++dx) {
          if (i + dx < 0 || j + dy < 0 || i + dx >= geometry_.size[0] ||
              j + dy >= geometry_.size[1]) {
            continue;
          }
          const auto v = static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(f.voxel) + dx +
                                                    static_cast<std::ptrdiff_t>(width_) * dy);
          if (state_[v] == Free) ring_.push_back(v);
        }
      }
    }
    std::sort(ring_.begin(), ring_.end());
    ring_.erase(std::unique(ring_.begin(), ring_.end()), ring_.end());
    double sum = 0.0;
    for (const std::uint32_t v : ring_) sum += ct_.voxels[v];
    return ring_.empty() ? 0.0 : sum / static_cast<double>(ring_.size());
  }

  /// The parts of a front that do not touch each other, each with what waits beside it.
  std::vector<Start> split(const std::vector<Front>& front, const Heap& heap, double narrowest) {
    std::vector<std::uint32_t> voxels;
    voxels.reserve(front.size());
    for (const Front& f : front) voxels.push_back(f.voxel);
    std::sort(voxels.begin(), voxels.end());
    const auto indexOf = [&](std::uint32_t v) -> std::ptrdiff_t {
      const auto at = std::lower_bound(voxels.begin(), voxels.end(), v);
      return at != voxels.end() && *at == v ? at - voxels.begin() : -1;
    };
    std::vector<int> part(voxels.size(), -1);
    int parts = 0;
    std::vector<std::size_t> stack;
    for (std::size_t n = 0; n < voxels.size(); ++n) {
      if (part[n] >= 0) continue;
      part[n] = parts;
      stack.assign(1, n);
      while (!stack.empty()) {
        const std::size_t at = stack.back();
        stack.pop_back();
        forEachNeighbour(voxels[at], [&](std::uint32_t v, const Neighbour&) {
          const std::ptrdiff_t other = indexOf(v);
          if (other < 0 || part[static_cast<std::size_t>(other)] >= 0) return;
          part[static_cast<std::size_t>(other)] = parts;
          stack.push_back(static_cast<std::size_t>(other));
        });
      }
      ++parts;
    }
    std::vector<Start> starts(static_cast<std::size_t>(parts));
    if (parts < 2) return starts;
    for (Start& start : starts) start.narrowestMm2 = narrowest;
    Heap rest = heap;
    for (; !rest.empty(); rest.pop()) {
      int owner = -1;
      forEachNeighbour(rest.top().voxel, [&](std::uint32_t v, const Neighbour&) {
        const std::ptrdiff_t at = owner < 0 ? indexOf(v) : -1;
        if (at >= 0) owner = part[static_cast<std::size_t>(at)];
      });
      starts[static_cast<std::size_t>(std::max(owner, 0))].heap.push_back(rest.top());
    }
    std::erase_if(starts, [](const Start& start) { return start.heap.empty(); });
    return starts;
  }

  void keep(const std::vector<Front>& branch) {
    for (const Front& f : branch) result_.voxels.push_back(f.voxel);
  }

  void release(const std::vector<Front>& branch) {
    for (const Front& f : branch) {
      state_[f.voxel] = state_[f.voxel] == OfBase ? Base : Free;
    }
  }

  const CtImage& ct_;
  const ImageGeometry& geometry_;
  WavefrontOptions options_;
  Progress progress_;
  std::vector<std::uint8_t>& state_;
  double stepMm_;
  std::size_t width_;
  std::size_t slice_;
  int topSlice_ = 0;
  std::vector<Neighbour> neighbours_;
  std::deque<Start> starts_;
  std::vector<std::uint32_t> ring_;
  Wavefront result_;
};

}  // namespace

Wavefront followAirways(const CtImage& ct, const AirwayBase& base,
                        const std::vector<std::uint32_t>& top, const WavefrontOptions& options,
                        std::vector<std::uint8_t>& state, const Progress& progress) {
  Wavefront result = Follower(ct, options, state, progress).follow(top);
  // What flooded and was not reached again belongs to the airways all the same.
  for (const std::uint32_t v : base.voxels) {
    if (state[v] == Base) result.voxels.push_back(v);
    state[v] = Base;
  }
  return result;
}

}  // namespace pneuma
