#include "growth/aggregation.h"

#include <algorithm>
#include <numeric>

namespace pneuma {
namespace {

// A jump near a reflecting wall may reach farther than the wall; if it ends outside it is refused.
// Parts of the lattice's longest side, and cells at most; docs/algorithms/dla.md.
constexpr int PartsOfTheSide = 5;
constexpr int LargestReflectReach = 64;
// Where that many in a row were refused there is less room than that: each further one halves it.
constexpr int RefusalsAtFullReach = 3;

constexpr std::uint64_t MostLaunchesInVain = 100000;
constexpr int MostTouchesWithoutLink = 1000;
constexpr std::uint64_t MovesBetweenQuestions = 1 << 14;
constexpr std::size_t ParticlesBetweenReports = 256;

/// Which group the next walker starts from, and where: groups by their share among those that still
/// have an open site, sites of a group alike.
template <int D>
class Launcher {
 public:
  explicit Launcher(std::vector<LaunchGroup<D>> groups) : groups_(std::move(groups)) {}

  /// Draws a site; false if none is open any more.
  bool draw(const AggregationLattice<D>& lattice, Random& random) {
    while (true) {
      double total = 0.0;
      for (const LaunchGroup<D>& group : groups_) total += group.sites.empty() ? 0.0 : group.share;
      if (!(total > 0.0)) return false;
      double at = total * random.uniform();
      group_ = 0;
      for (std::size_t i = 0; i < groups_.size(); ++i) {
        if (groups_[i].sites.empty() || !(groups_[i].share > 0.0)) continue;
        group_ = i;
        at -= groups_[i].share;
        if (at < 0.0) break;
      }
      std::vector<LatticeCell<D>>& sites = groups_[group_].sites;
      const std::size_t index = random.below(sites.size());
      if (lattice.open(sites[index])) {
        site_ = sites[index];
        return true;
      }
      sites[index] = sites.back();  // it has become cluster
      sites.pop_back();
    }
  }

  std::size_t group() const { return group_; }

  double sticking() const { return groups_[group_].sticking; }

  const LatticeCell<D>& site() const { return site_; }

 private:
  std::vector<LaunchGroup<D>> groups_;
  std::size_t group_ = 0;
  LatticeCell<D> site_ = LatticeCell<D>::Zero();
};

/// All displacements of length 1 to `reach`, shorter ones first.
template <int D>
std::vector<LatticeCell<D>> within(int reach) {
  std::vector<LatticeCell<D>> ways;
  const int side = 2 * reach + 1;
  for (int k = 0; k < (D == 2 ? side * side : side * side * side); ++k) {
    LatticeCell<D> way;
    int digits = k;
    for (int axis = 0; axis < D; ++axis, digits /= side) way[axis] = digits % side - reach;
    if (way.squaredNorm() > 0 && way.squaredNorm() <= reach * reach) ways.push_back(way);
  }
  std::ranges::stable_sort(ways, {}, [](const auto& way) { return way.squaredNorm(); });
  return ways;
}

}  // namespace

template <int D>
const CubeWalk<D>& cubeWalk() {
  static const CubeWalk<D> table;
  return table;
}

template const CubeWalk<2>& cubeWalk<2>();
template const CubeWalk<3>& cubeWalk<3>();

template <int D>
Aggregation<D>::Aggregation(AggregationLattice<D>& lattice, const AggregationRules& rules,
                            Link link)
    : lattice_(lattice),
      rules_(rules),
      link_(std::move(link)),
      nearby_(within<D>(rules.reach)),
      coarse_(rules.step > 1 || rules.reach > 1),
      reflectReach_(
          std::clamp(lattice.size().maxCoeff() / PartsOfTheSide, 1, LargestReflectReach)) {
  unreachable_ = lattice_.keepReachable();
  lattice_.findWalls();
  if (rules_.wall == Wall::Absorb) lattice_.keepOffWalls();
}

/// Finds the nearest cluster cells within reach that a particle here may hang on.
template <int D>
bool Aggregation<D>::touch(const Cell& cell) {
  touched_.clear();
  int distance = 0;
  for (const Cell& way : nearby_) {
    if (!touched_.empty() && way.squaredNorm() > distance) break;
    const Cell other = cell + way;
    if (!lattice_.inCluster(other) || (link_ && !link_(cell, other))) continue;
    touched_.push_back(other);
    distance = way.squaredNorm();
  }
  return !touched_.empty();
}

template <int D>
void Aggregation<D>::stick(const Cell& cell, Random& random) {
  const Cell parent = touched_.size() == 1 ? touched_[0] : touched_[random.below(touched_.size())];
  newest_ = {lattice_.number(cell), lattice_.number(parent)};
  lattice_.addToCluster(cell);
}

template <int D>
auto Aggregation<D>::walk(Cell cell, double sticking, Random& random, const Progress& progress)
    -> Fate {
  const CubeWalk<D>& jumps = cubeWalk<D>();
  const bool absorb = rules_.wall == Wall::Absorb;
  double steps = 0.0;
  int notLinked = 0;
  int refused = 0;  // in a row
  auto view = lattice_.look(cell);
  for (std::uint64_t move = 1;; ++move) {
    if (move % MovesBetweenQuestions == 0) progress.throwIfStopped();
    // In steps: within this many nothing is touched.
    int radius = view.free;
    if (coarse_) radius = (radius - (rules_.reach - 1)) / rules_.step;
    if (radius <= 1) {
      if (touch(cell)) {
        if (sticking >= 1.0 || random.uniform() < sticking) {
          stick(cell, random);
          return Fate::Stuck;
        }
      } else if (link_ && ++notLinked > MostTouchesWithoutLink) {
        return Fate::Lost;
      }
      radius = 1;
    }
    if (!absorb) {
      const int halvings = std::max(refused - RefusalsAtFullReach, 0);
      const int reach = std::max(reflectReach_ >> std::min(halvings, 8), 1);
      radius = std::min(radius, std::max(view.wall / rules_.step, reach));
    }
    Cell way = jumps.exit(radius, random);
    if (coarse_) way *= rules_.step;
    const Cell next = cell + way;
    if (rules_.mostSteps > 0.0) {
      steps += jumps.meanSteps(radius);
      if (steps > rules_.mostSteps) return Fate::Lost;
    }
    const auto nextView = lattice_.look(next);
    if (nextView.free == 0) {
      if (absorb && !lattice_.inCluster(next)) return Fate::Lost;
      ++refused;
      continue;
    }
    // Not across what is outside, from one part of the organ to another.
    if (radius > 1 && radius * rules_.step > view.wall && lattice_.look(cell + way / 2).free == 0) {
      ++refused;
      continue;
    }
    refused = 0;
    cell = next;
    view = nextView;
  }
}

template <int D>
AggregationResult Aggregation<D>::run(std::size_t count, std::vector<LaunchGroup<D>> groups,
                                      Random& random, const Progress& progress,
                                      const Arrived& arrived) {
  AggregationResult result;
  result.stuck.assign(groups.size(), 0);
  result.particles.reserve(count);
  Launcher<D> launcher(std::move(groups));
  std::uint64_t inVain = 0;
  std::size_t told = 0;
  const auto tell = [&] {
    progress.report(static_cast<double>(result.particles.size()) /
                    static_cast<double>(std::max<std::size_t>(count, 1)));
    if (arrived) arrived(std::span(result.particles).subspan(told));
    told = result.particles.size();
  };
  while (result.particles.size() < count) {
    if (!launcher.draw(lattice_, random)) {
      result.end = AggregationEnd::Saturated;
      break;
    }
    if (++result.launches % 256 == 0) progress.throwIfStopped();
    if (walk(launcher.site(), launcher.sticking(), random, progress) == Fate::Lost) {
      if (++inVain < MostLaunchesInVain) continue;
      result.end = AggregationEnd::Starved;
      break;
    }
    inVain = 0;
    ++result.stuck[launcher.group()];
    result.particles.push_back(newest_);
    if (result.particles.size() - told >= ParticlesBetweenReports) tell();
  }
  tell();
  return result;
}

template class Aggregation<2>;
template class Aggregation<3>;

}  // namespace pneuma
