#include "growth/seeding.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"

namespace pneuma {
namespace {

constexpr double MostNodes = 40e6;
constexpr std::size_t MovesBetweenStops = 4096;

std::vector<Vec3> nodesInside(const Domain& domain, const Vec3& anchor, double spacing,
                              const Progress& progress) {
  const Box3 box = domain.bounds();
  const Vec3 low = ((box.min() - anchor) / spacing).array().ceil();
  const Vec3 high = ((box.max() - anchor) / spacing).array().floor();
  const Vec3 nodes = (high - low).array() + 1.0;
  if (!(nodes.prod() <= MostNodes)) {
    throw InvalidInput("filling a lobe of " + std::to_string(std::lround(box.sizes().maxCoeff())) +
                       " mm with points every " + std::to_string(spacing) +
                       " mm would take too many points; choose a larger spacing or fewer "
                       "terminals, and check the units of the surface");
  }
  const auto planes = static_cast<std::size_t>(std::max(nodes.z(), 0.0));
  std::vector<std::vector<Vec3>> inPlane(planes);
  parallelFor(planes, [&](std::size_t plane) {
    progress.throwIfStopped();
    const double z = anchor.z() + spacing * (low.z() + static_cast<double>(plane));
    for (double j = low.y(); j <= high.y(); ++j)
      for (double i = low.x(); i <= high.x(); ++i) {
        const Vec3 p(anchor.x() + spacing * i, anchor.y() + spacing * j, z);
        if (domain.contains(p)) inPlane[plane].push_back(p);
      }
  });
  std::vector<Vec3> points;
  for (auto& some : inPlane) {
    progress.throwIfStopped();
    points.insert(points.end(), some.begin(), some.end());
    some = {};
  }
  return points;
}

void move(std::vector<Vec3>& points, const Domain& domain, double reachMm, Random& random,
          const Progress& progress) {
  std::size_t moves = 0;
  for (Vec3& p : points) {
    if (++moves % MovesBetweenStops == 0) progress.throwIfStopped();
    const double x = random.uniform(-reachMm, reachMm);
    const double y = random.uniform(-reachMm, reachMm);
    const double z = random.uniform(-reachMm, reachMm);
    const Vec3 moved = p + Vec3(x, y, z);
    if (domain.contains(moved)) p = moved;
  }
}

SeedPoints lattice(std::span<const LobeRegion> lobes, double spacingMm, const Progress& progress) {
  SeedPoints seeds;
  seeds.spacingMm = spacingMm;
  Box3 box;
  for (const LobeRegion& region : lobes) box.extend(region.domain->bounds());
  seeds.anchor = box.min() + spacingMm * LatticeOffset;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    seeds.byRegion.push_back(nodesInside(*lobes[i].domain, seeds.anchor, spacingMm, progress));
    if (seeds.byRegion.back().empty()) {
      throw InvalidInput("no point of a lattice of " + std::to_string(spacingMm) +
                         " mm lies in the " + std::string(longName(lobes[i].lobe)) +
                         "; choose a smaller spacing or more terminals, and check the units of "
                         "the surface");
    }
  }
  return seeds;
}

void jitterPoints(SeedPoints& seeds, std::span<const LobeRegion> lobes, double jitter,
                  std::uint64_t seed, const Progress& progress) {
  if (jitter <= 0.0) return;
  Random random(seed);
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    move(seeds.byRegion[i], *lobes[i].domain, jitter * seeds.spacingMm / 2.0, random, progress);
  }
}

/// Takes `surplus` points away, any point with the same probability.
void thin(SeedPoints& seeds, std::size_t surplus, std::uint64_t seed) {
  std::vector<std::size_t> order(seeds.count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(seed);
  for (std::size_t i = 0; i < surplus; ++i) {
    std::swap(order[i], order[i + random.below(order.size() - i)]);
  }
  std::vector<char> drop(order.size(), 0);
  for (std::size_t i = 0; i < surplus; ++i) drop[order[i]] = 1;
  std::size_t index = 0;
  for (auto& points : seeds.byRegion) {
    std::erase_if(points, [&](const Vec3&) { return drop[index++] != 0; });
  }
}

}  // namespace

double totalVolumeMm3(std::span<const LobeRegion> lobes) {
  double volume = 0.0;
  for (const LobeRegion& region : lobes) volume += region.domain->volumeMm3();
  return volume;
}

std::size_t SeedPoints::count() const {
  std::size_t sum = 0;
  for (const auto& points : byRegion) sum += points.size();
  return sum;
}

SeedPoints seedLattice(std::span<const LobeRegion> lobes, double spacingMm, double jitter,
                       std::uint64_t seed, const Progress& progress) {
  SeedPoints seeds = lattice(lobes, spacingMm, progress);
  jitterPoints(seeds, lobes, jitter, seed, progress);
  return seeds;
}

SeedPoints seedExactly(std::span<const LobeRegion> lobes, std::size_t count, double jitter,
                       std::uint64_t seed, const Progress& progress) {
  // The number of nodes falls with the spacing, but in jumps where a plane of nodes crosses a flat
  // wall: look at spacings around the ideal one, then bisect beside the one with the least surplus.
  const double ideal = std::cbrt(totalVolumeMm3(lobes) / static_cast<double>(count));
  const double step = 0.0025 * ideal;
  SeedPoints best;
  const auto consider = [&](double spacingMm) {
    SeedPoints trial = lattice(lobes, spacingMm, progress);
    const bool enough = trial.count() >= count;
    if (enough && (best.byRegion.empty() || trial.count() < best.count())) best = std::move(trial);
    return enough;
  };
  for (int i = -8; i <= 8; ++i) consider(ideal + step * i);
  for (double spacing = ideal - 9.0 * step; best.byRegion.empty(); spacing *= 0.98) {
    consider(spacing);
  }
  double enough = best.spacingMm;
  double tooFew = enough + step;
  for (int i = 0; i < 16 && best.count() > count; ++i) {
    const double middle = (enough + tooFew) / 2.0;
    (consider(middle) ? enough : tooFew) = middle;
  }
  thin(best, best.count() - count, seed);
  jitterPoints(best, lobes, jitter, seed, progress);
  return best;
}

}  // namespace pneuma
