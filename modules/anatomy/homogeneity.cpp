#include "anatomy/homogeneity.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "core/point_index.h"
#include "core/random.h"

namespace pneuma {
namespace {

constexpr std::size_t Chunk = 2048;  // points drawn from one stream of random numbers
constexpr std::size_t MostPoints = 10'000'000;
constexpr std::size_t MostDrawsPerPoint = 10'000;

std::size_t chunks(std::size_t n) { return (n + Chunk - 1) / Chunk; }

double totalVolumeMm3(std::span<const LobeRegion> regions) {
  double total = 0.0;
  for (const LobeRegion& region : regions) {
    const double volume = region.domain->volumeMm3();
    if (!(volume > 0.0 && std::isfinite(volume))) {
      throw InvalidInput("the region " + std::string(shortName(region.lobe)) +
                         " has no volume to measure homogeneity in; check its surface");
    }
    total += volume;
  }
  return total;
}

std::vector<Vec3> randomPointsOf(const LobeRegion& region, std::size_t count, std::uint64_t stream,
                                 const Progress& progress) {
  const Box3 box = region.domain->bounds();
  std::vector<Vec3> points(count);
  parallelFor(chunks(count), [&](std::size_t chunk) {
    progress.throwIfStopped();
    Random random(stream + chunk);
    const std::size_t end = std::min(count, (chunk + 1) * Chunk);
    std::size_t drawsLeft = (end - chunk * Chunk) * MostDrawsPerPoint;
    for (std::size_t i = chunk * Chunk; i < end;) {
      if (drawsLeft-- == 0) {
        throw InvalidInput("hardly any point of the box around the region " +
                           std::string(shortName(region.lobe)) +
                           " lies inside it; check its surface");
      }
      const double x = random.uniform(box.min().x(), box.max().x());
      const double y = random.uniform(box.min().y(), box.max().y());
      points[i] = {x, y, random.uniform(box.min().z(), box.max().z())};
      if (region.domain->contains(points[i])) ++i;
    }
  });
  return points;
}

std::size_t endsInside(std::span<const Vec3> ends, std::span<const LobeRegion> regions) {
  std::vector<std::size_t> inside(chunks(ends.size()), 0);
  parallelFor(inside.size(), [&](std::size_t chunk) {
    for (std::size_t i = chunk * Chunk; i < std::min(ends.size(), (chunk + 1) * Chunk); ++i) {
      inside[chunk] += std::ranges::any_of(regions, [&](const LobeRegion& region) {
        return region.domain->bounds().contains(ends[i]) && region.domain->contains(ends[i]);
      });
    }
  });
  std::size_t total = 0;
  for (const std::size_t count : inside) total += count;
  return total;
}

}  // namespace

std::vector<std::vector<Vec3>> randomPoints(std::span<const LobeRegion> regions, std::size_t count,
                                            std::uint64_t seed, const Progress& progress) {
  if (count == 0 || count > MostPoints) {
    throw InvalidOption("homogeneity is measured with 1 to " + std::to_string(MostPoints) +
                        " random points, but " + std::to_string(count) + " were asked for");
  }
  const double total = totalVolumeMm3(regions);
  std::vector<std::vector<Vec3>> points;
  double before = 0.0;
  std::size_t drawn = 0;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    before += regions[r].domain->volumeMm3();
    const double share = r + 1 == regions.size() ? 1.0 : before / total;
    const auto upTo = static_cast<std::size_t>(std::llround(share * static_cast<double>(count)));
    // Streams of regions and seeds lie far apart; those of chunks are neighbours, which the
    // generator's seeding tells apart.
    const std::uint64_t stream = (seed * 1000003 + r) << 20;
    points.push_back(randomPointsOf(regions[r], upTo - drawn, stream, progress));
    drawn = upTo;
    progress.report(share);
  }
  return points;
}

std::optional<Gap> gap(std::span<const Vec3> ends, std::span<const LobeRegion> regions,
                       std::span<const Vec3> points, const Progress& progress) {
  const std::size_t inside = endsInside(ends, regions);
  if (inside == 0 || points.empty()) return std::nullopt;
  Gap result;
  result.spacingMm = std::cbrt(totalVolumeMm3(regions) / static_cast<double>(inside));
  const PointIndex index({ends.begin(), ends.end()});
  std::vector<double> distance(points.size());
  parallelFor(chunks(points.size()), [&](std::size_t chunk) {
    progress.throwIfStopped();
    for (std::size_t i = chunk * Chunk; i < std::min(points.size(), (chunk + 1) * Chunk); ++i) {
      distance[i] = index.nearest(points[i]).distance / result.spacingMm;
    }
  });
  for (const double d : distance) result.mean += d;
  result.mean /= static_cast<double>(distance.size());
  result.max = *std::ranges::max_element(distance);
  const auto p95 =
      distance.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(distance.size()));
  std::ranges::nth_element(distance, p95);
  result.p95 = *p95;
  return result;
}

}  // namespace pneuma
