#include "lobes/sheet_rim.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.h"
#include "lobes/detail/sentence_text.h"

namespace pneuma {
namespace {

constexpr double RimStepMm = 2.0;
constexpr int EvenRounds = 3;          ///< in which directions along the rim become even
constexpr double StripPerDepth = 1.5;  ///< the wall may stand aslant
constexpr double StripMarginMm = 2.0;
constexpr std::uint32_t Nowhere = std::numeric_limits<std::uint32_t>::max();

using Edge = std::array<std::uint32_t, 2>;

/// How a rim goes on beyond itself.
struct Outward {
  std::uint32_t before = Nowhere;  ///< points of the rim beside this one
  std::uint32_t after = Nowhere;
  Vec3 direction = Vec3::Zero();
  double lengthMm = 0.0;  ///< 0 where it may end
};

using Outwards = std::map<std::uint32_t, Outward>;

/// Across each edge of the rim in the plane of its triangle, the mean of two at each point.
Outwards outwardsOf(const TriangleMesh& sheet) {
  std::map<Edge, Vec3> normalOf;
  for (const auto& t : sheet.triangles) {
    const Vec3& a = sheet.points[t[0]];
    const Vec3 normal = (sheet.points[t[1]] - a).cross(sheet.points[t[2]] - a);
    for (std::size_t e = 0; e < 3; ++e) normalOf[{t[e], t[(e + 1) % 3]}] = normal;
  }
  Outwards outwards;
  for (const Edge& edge : rimOf(sheet)) {
    const Vec3 along = sheet.points[edge[1]] - sheet.points[edge[0]];
    const Vec3 away = along.cross(normalOf.at(edge)).normalized();
    outwards[edge[0]].direction += away;
    outwards[edge[1]].direction += away;
    outwards[edge[0]].after = edge[1];
    outwards[edge[1]].before = edge[0];
  }
  return outwards;
}

/// Saw-toothed rims would fold the strip.
void makeEven(Outwards& outwards) {
  for (int round = 0; round < EvenRounds; ++round) {
    const Outwards before = outwards;
    for (auto& [point, outward] : outwards) {
      const Outward& one = before.at(outward.before);
      const Outward& other = before.at(outward.after);
      outward.direction = (one.direction.normalized() + 2.0 * outward.direction.normalized() +
                           other.direction.normalized());
      outward.lengthMm = std::max({outward.lengthMm, one.lengthMm, other.lengthMm});
    }
  }
}

}  // namespace

std::vector<Edge> rimOf(const TriangleMesh& sheet) {
  std::vector<std::array<std::uint32_t, 4>> sides;  // both ends in order, then as they turn
  for (const auto& t : sheet.triangles) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = t[e];
      const std::uint32_t b = t[(e + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), a, b});
    }
  }
  std::ranges::sort(sides);
  const auto same = [&](std::size_t i, std::size_t k) {
    return k < sides.size() && sides[i][0] == sides[k][0] && sides[i][1] == sides[k][1];
  };
  std::vector<Edge> rim;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (same(i, i + 1) || (i > 0 && same(i, i - 1))) continue;
    rim.push_back({sides[i][2], sides[i][3]});
  }
  return rim;
}

RimPlace deepestRim(const TriangleMesh& sheet, const Domain& region,
                    const HeightAboveFloor& floor) {
  RimPlace deepest;
  for (const auto& [a, b] : rimOf(sheet)) {
    const Vec3 along = sheet.points[b] - sheet.points[a];
    const auto steps = static_cast<int>(std::ceil(along.norm() / RimStepMm)) + 1;
    for (int step = 0; step <= steps; ++step) {
      const Vec3 p = sheet.points[a] + static_cast<double>(step) / steps * along;
      if (!region.contains(p)) continue;
      double depth = region.distanceToWall(p);
      if (floor) depth = std::min(depth, std::max(0.0, floor(p)));
      if (depth > deepest.depthMm) deepest = {p, depth};
    }
  }
  return deepest;
}

void requireReach(const RimPlace& rim, double extendMm, const std::string& what,
                  const std::string& where) {
  if (rim.depthMm <= RimToleranceMm + extendMm) return;
  throw InvalidInput("the " + what + " ends inside the " + where + ": at " + placeText(rim.place) +
                     " its edge lies " + lengthText(rim.depthMm) +
                     " from the wall; extend it, or allow that far by 'extend', 15 mm at most");
}

TriangleMesh extendedThrough(const TriangleMesh& sheet, const Domain& region) {
  Outwards outwards = outwardsOf(sheet);
  for (auto& [point, outward] : outwards) {
    const Vec3& p = sheet.points[point];
    const double away = region.distanceToWall(p);
    if (!region.contains(p) && away > RimToleranceMm) continue;
    outward.lengthMm = StripPerDepth * away + StripMarginMm;
  }
  makeEven(outwards);
  TriangleMesh extended = sheet;
  std::map<std::uint32_t, std::uint32_t> beyond;
  for (const auto& [point, outward] : outwards) {
    if (outward.lengthMm == 0.0) continue;
    beyond[point] = static_cast<std::uint32_t>(extended.points.size());
    extended.points.push_back(sheet.points[point] +
                              outward.lengthMm * outward.direction.normalized());
  }
  for (const auto& [a, b] : rimOf(sheet)) {
    const auto fromA = beyond.find(a);
    const auto fromB = beyond.find(b);
    if (fromA != beyond.end()) extended.triangles.push_back({b, a, fromA->second});
    if (fromB == beyond.end()) continue;
    extended.triangles.push_back({b, fromA == beyond.end() ? a : fromA->second, fromB->second});
  }
  return extended;
}

}  // namespace pneuma
