#include "pipeline/review_stations.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "pipeline/fissure_tracing.h"

namespace pneuma {
namespace {

/// A square of 120 mm in triangles of 5 mm, sloping.
TriangleMesh sheet() {
  TriangleMesh mesh;
  constexpr std::uint32_t Row = 25;
  for (std::uint32_t j = 0; j < Row; ++j) {
    for (std::uint32_t i = 0; i < Row; ++i) mesh.points.emplace_back(5.0 * i, 5.0 * j, 2.5 * j);
  }
  for (std::uint32_t j = 0; j + 1 < Row; ++j) {
    for (std::uint32_t i = 0; i + 1 < Row; ++i) {
      const std::uint32_t p = Row * j + i;
      mesh.triangles.push_back({p, p + 1, p + Row});
      mesh.triangles.push_back({p + 1, p + Row + 1, p + Row});
    }
  }
  return mesh;
}

double nearest(const Vec3& p, const std::vector<Vec3>& others) {
  double least = 1e9;
  for (const Vec3& other : others) least = std::min(least, (p - other).norm());
  return least;
}

TEST(ReviewStations, AreSpreadOverTheWholeFissureFromSideToSide) {
  const std::vector<Vec3> stations = reviewStations(sheet(), {});
  ASSERT_EQ(stations.size(), StationsPerFissure);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    // One in each band of ten millimetres, upon the sheet.
    EXPECT_NEAR(stations[i].x(), 10.0 * static_cast<double>(i) + 5.0, 5.0);
    EXPECT_NEAR(stations[i].z(), 0.5 * stations[i].y(), 1e-9);
  }
  double back = 0.0;
  for (const Vec3& station : stations) back += station.y() > 60.0 ? 1.0 : 0.0;
  EXPECT_GE(back, 4.0);
  EXPECT_LE(back, 8.0);
}

TEST(ReviewStations, GoWhereNobodySetPoints) {
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i) points.emplace_back(10.0 * i + 5.0, 20.0 + (i % 3) * 10.0, 15.0);
  const std::vector<Vec3> stations = reviewStations(sheet(), points);
  ASSERT_EQ(stations.size(), StationsPerFissure);
  double sum = 0.0;
  for (const Vec3& station : stations) sum += nearest(station, points);
  EXPECT_GT(sum / static_cast<double>(stations.size()), 35.0);
}

TEST(ReviewStations, AreNoneWithoutAFissureAndFewOnAFewTriangles) {
  EXPECT_TRUE(reviewStations({}, {}).empty());
  TriangleMesh one;
  one.points = {Vec3::Zero(), Vec3(10.0, 0.0, 0.0), Vec3(0.0, 10.0, 0.0)};
  one.triangles = {{0, 1, 2}};
  EXPECT_EQ(reviewStations(one, {}).size(), 1U);
}

TEST(ShownParts, TellWhereTheTrianglesDo) {
  const TriangleMesh mesh = sheet();
  HeightSurface surface;
  surface.centre = Vec3(60.0, 60.0, 30.0);
  std::vector<std::uint8_t> onSheet;
  for (const auto& triangle : mesh.triangles) {
    double x = 0.0;
    for (const std::uint32_t corner : triangle) x += mesh.points[corner].x() / 3.0;
    onSheet.push_back(x < 60.0 ? 1 : 0);
  }
  const ShownParts parts(surface, mesh, onSheet);
  EXPECT_TRUE(parts.shows({30.0, 40.0, 20.0}));
  EXPECT_FALSE(parts.shows({90.0, 40.0, 20.0}));
  EXPECT_FALSE(parts.shows({90.0, 40.0, 24.0}));  // a little off it
  EXPECT_TRUE(parts.shows({150.0, 40.0, 20.0}));  // beyond its rim nothing is told
  EXPECT_TRUE(ShownParts(surface, {}, {}).shows({90.0, 40.0, 20.0}));
}

}  // namespace
}  // namespace pneuma
