#include "lobes/fissure_fit.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"

namespace pneuma {
namespace {

/// Points upon z = 10 + 0.3 y + 8 cos(x / 40) sin(y / 50), a bent fissure.
Vec3 bent(double x, double y) {
  return {x, y, 10.0 + 0.3 * y + 8.0 * std::cos(x / 40.0) * std::sin(y / 50.0)};
}

std::vector<Vec3> bentPoints(int n) {
  Random random(7);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double x = random.uniform(-60.0, 60.0);
    points.push_back(bent(x, random.uniform(-80.0, 80.0)));
  }
  return points;
}

std::string refusalOfPoints(const std::vector<Vec3>& points) {
  try {
    fitFissure(points);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(FissureFit, IsThePlaneThroughThreePoints) {
  const std::vector<Vec3> points = {{0.0, 0.0, 5.0}, {10.0, 0.0, 5.0}, {0.0, 10.0, 15.0}};
  const HeightSurface surface = fitFissure(points);
  EXPECT_TRUE(surface.knots.empty());
  for (const Vec3& p : points) EXPECT_NEAR(surface.height(p), 0.0, 1e-12);
  // z = 5 + y: above it on the side of the normal, which looks up and to the front.
  EXPECT_NEAR(surface.normal().dot(Vec3(0.0, -1.0, 1.0).normalized()), 1.0, 1e-12);
  EXPECT_NEAR(surface.height({3.0, 4.0, 12.0}), 3.0 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(surface.height({3.0, 4.0, 6.0}), -3.0 / std::sqrt(2.0), 1e-12);
  const Vec3 right = surface.axes[0].cross(surface.axes[1]);
  EXPECT_NEAR((right - surface.normal()).norm(), 0.0, 1e-12);
}

TEST(FissureFit, GoesThroughItsPointsWithoutSmoothness) {
  const std::vector<Vec3> points = bentPoints(25);
  const HeightSurface exact = fitFissure(points, {.smoothness = 0.0});
  const HeightSurface smooth = fitFissure(points, {.smoothness = 1.0});
  double farthest = 0.0;
  for (const Vec3& p : points) {
    EXPECT_NEAR(exact.height(p), 0.0, 1e-9);
    farthest = std::max(farthest, std::abs(smooth.height(p)));
  }
  EXPECT_GT(farthest, 0.05);
}

TEST(FissureFit, IsNearTheFissureBetweenItsPoints) {
  const HeightSurface surface = fitFissure(bentPoints(60));
  double sum = 0.0;
  int count = 0;
  for (double x = -50.0; x <= 50.0; x += 5.0) {
    for (double y = -70.0; y <= 70.0; y += 5.0, ++count) {
      sum += std::abs(surface.distance(bent(x, y)));
    }
  }
  EXPECT_LT(sum / count, 0.5);
}

TEST(FissureFit, HasTheSlopeOfItsHeight) {
  const HeightSurface surface = fitFissure(bentPoints(12));
  const Vec2 at(13.0, -21.0);
  const double step = 1e-5;
  const Vec2 slope = surface.slope(at);
  EXPECT_NEAR(
      slope.x(),
      (surface.lift(at + Vec2(step, 0.0)) - surface.lift(at - Vec2(step, 0.0))) / (2.0 * step),
      1e-7);
  EXPECT_NEAR(
      slope.y(),
      (surface.lift(at + Vec2(0.0, step)) - surface.lift(at - Vec2(0.0, step))) / (2.0 * step),
      1e-7);
  EXPECT_NEAR(surface.height(surface.at(at)), 0.0, 1e-12);
}

TEST(FissureFit, GivesHeavyPointsMore) {
  std::vector<Vec3> points = bentPoints(20);
  points[3].z() += 10.0;
  std::vector<double> weights(points.size(), 1.0);
  const FissureFitOptions options{.smoothness = 0.3};
  const double light = std::abs(fitFissure(points, options, weights).height(points[3]));
  weights[3] = 50.0;
  EXPECT_LT(std::abs(fitFissure(points, options, weights).height(points[3])), 0.5 * light);
}

TEST(FissureFit, BendsAPriorThroughFewPoints) {
  HeightSurface prior;
  prior.scale = 100.0;
  prior.quadratic = {12.0, 30.0, 5.0, 20.0, -7.0, 3.0};
  const std::vector<Vec3> points = {prior.at({-40.0, -50.0}), prior.at({50.0, -30.0}),
                                    prior.at({0.0, 60.0}), prior.at({20.0, 10.0})};
  const HeightSurface same = bentThrough(prior, points);
  EXPECT_NEAR(same.lift({33.0, -21.0}), prior.lift({33.0, -21.0}), 1e-9);
  std::vector<Vec3> higher = points;
  for (Vec3& p : higher) p.z() += 4.0;
  EXPECT_NEAR(bentThrough(prior, higher).lift({33.0, -21.0}), prior.lift({33.0, -21.0}) + 4.0,
              1e-9);
}

TEST(FissureFit, DoesNotTiltAPriorAcrossPointsThatLieNearlyOnALine) {
  HeightSurface prior;
  prior.scale = 60.0;
  // One millimetre beside the line of the others, four above: a slope of four.
  const std::vector<Vec3> nearly = {{-60.0, 0.0, 6.0}, {0.0, 1.0, 10.0}, {60.0, 0.0, 6.0}};
  const HeightSurface bent = bentThrough(prior, nearly);
  EXPECT_NEAR(bent.lift({0.0, 60.0}), 22.0 / 3.0, 1.0);
  EXPECT_NEAR(bent.lift({60.0, 0.0}), 6.0, 2.0);
  // Along the line they tell the slope, and well apart all of it.
  const std::vector<Vec3> steep = {{-60.0, 0.0, -30.0}, {0.0, 4.0, 0.0}, {60.0, 0.0, 30.0}};
  EXPECT_NEAR(bentThrough(prior, steep).lift({60.0, 0.0}), 30.0, 0.1);
  const std::vector<Vec3> apart = {{-60.0, 0.0, 6.0}, {0.0, 60.0, 10.0}, {60.0, 0.0, 6.0}};
  for (const Vec3& p : apart) EXPECT_NEAR(bentThrough(prior, apart).height(p), 0.0, 1e-9);
}

TEST(FissureFit, ShowsThePointThatWasSetInAWrongPlace) {
  std::vector<Vec3> points = bentPoints(30);
  points[11].z() += 20.0;
  const std::vector<double> away = leaveOneOut(points);
  ASSERT_EQ(away.size(), points.size());
  EXPECT_EQ(std::max_element(away.begin(), away.end()) - away.begin(), 11);
  EXPECT_GT(away[11], 12.0);
  EXPECT_TRUE(leaveOneOut({points.data(), 3}).empty());
}

TEST(FissureFit, LeavesOneOutAsIfTheOthersWereAlone) {
  const std::vector<Vec3> points = bentPoints(15);
  const BestPlane plane = bestPlane(points);
  HeightSurface flat;
  flat.centre = plane.centre;
  flat.axes = plane.axes;
  flat.scale = plane.scale;
  const HeightSurface all = fitFissure(points);
  const std::vector<double> away = leaveOneOut(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<Vec3> others = points;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const double missed = std::abs(bentThrough(flat, others).height(points[i]));
    EXPECT_NEAR(away[i], missed / std::sqrt(1.0 + all.slope(all.planar(points[i])).squaredNorm()),
                1e-8);
  }
}

TEST(FissureFit, RefusesWhatNoFissureGoesThrough) {
  EXPECT_NE(refusalOfPoints({{0, 0, 0}, {1, 0, 0}}).find("three points"), std::string::npos);
  EXPECT_NE(refusalOfPoints({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).find("one line"),
            std::string::npos);
  EXPECT_NE(
      refusalOfPoints({{0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<double>::quiet_NaN(), 0}})
          .find("point 3"),
      std::string::npos);
  EXPECT_NE(refusalOfPoints(std::vector<Vec3>(2001, Vec3::Zero())).find("2001 points"),
            std::string::npos);
  EXPECT_NE(refusalOfPoints({{5, 5, 5}, {5, 5, 5}, {5, 5, 5}}).find("one line"), std::string::npos);
}

}  // namespace
}  // namespace pneuma
