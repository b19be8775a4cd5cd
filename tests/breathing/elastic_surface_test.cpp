#include "breathing/elastic_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "breathing/breathing_surfaces.h"
#include "breathing/lung_frame.h"
#include "core/error.h"
#include "core/parallel.h"
#include "geometry/test_surfaces.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

/// A force and a stiffness that change all over the lung.
struct Uneven {
  std::vector<double> force;
  std::vector<double> stiffness;

  explicit Uneven(const TriangleMesh& lung) {
    const Vec3 tumour(-40.0, -60.0, 0.0);
    const LungFrame frame(Side::Right, bounds(testing::lungShaped(3)));
    for (const Vec3& p : lung.points) {
      const Vec3 q = frame.shareOf(p);
      force.push_back(0.05 + 0.9 * q.y() + 0.05 * q.z());
      stiffness.push_back((1.0 + 0.5 * std::sin(p.z() / 30.0)) *
                          ((p - tumour).norm() < 25.0 ? 5.0 : 1.0));
    }
  }
};

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0.0;
  double all = 0.0;
  for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
    difference += (a[n] - b[n]) * (a[n] - b[n]);
    all += b[n] * b[n];
  }
  return std::sqrt(difference / all);
}

/// sum M E w, E by its median.
double kept(const ElasticSurface& skin, const std::vector<double>& stiffness,
            const std::vector<double>& w) {
  std::vector<double> sorted = stiffness;
  std::ranges::sort(sorted);
  double sum = 0.0;
  for (std::size_t n = 0; n < w.size(); ++n) {
    sum += skin.areas()[n] * stiffness[n] / sorted[sorted.size() / 2] * w[n];
  }
  return sum;
}

double applied(const ElasticSurface& skin, const std::vector<double>& force) {
  return std::inner_product(force.begin(), force.end(), skin.areas().begin(), 0.0);
}

TEST(ElasticSurface, KeepsTheSumOfForces) {
  const TriangleMesh lung = testing::irregular(testing::lungShaped(4));
  const Uneven of(lung);
  for (const std::size_t mostPoints : {std::size_t{100000}, std::size_t{1000}}) {
    const ElasticSurface skin(lung, of.stiffness, {10.0, mostPoints});
    EXPECT_EQ(skin.solvedPoints() == lung.points.size(), mostPoints > 1000);
    const std::vector<double> w = skin.response(of.force, {1e-13});
    EXPECT_NEAR(kept(skin, of.stiffness, w) / applied(skin, of.force), 1.0, 1e-10);
  }
}

TEST(ElasticSurface, IsPositiveLinearAndTheSameBothWays) {
  const TriangleMesh lung = testing::irregular(testing::lungShaped(3));
  const Uneven of(lung);
  const ElasticSurface skin(lung, of.stiffness);
  const auto ofOne = [&](std::size_t at) {
    std::vector<double> one(lung.points.size(), 0.0);
    one[at] = 1.0 / skin.areas()[at];
    return skin.response(one, {1e-15});
  };
  const auto& [first, second, third] = lung.triangles[7];
  const std::vector<double> a = ofOne(first);
  const std::vector<double> b = ofOne(second);
  EXPECT_NEAR(a[second] / b[first], 1.0, 1e-12);
  EXPECT_GT(std::abs(a[second] / b[third] - 1.0), 1e-3);
  for (const double w : a) EXPECT_GT(w, -1e-15);
  std::vector<double> both = of.force;
  for (double& f : both) f *= 3.0;
  both[first] += 2.0 / skin.areas()[first];
  const std::vector<double> ofForce = skin.response(of.force, {1e-15});
  const std::vector<double> ofBoth = skin.response(both, {1e-15});
  for (std::size_t n = 0; n < both.size(); ++n) {
    EXPECT_NEAR(ofBoth[n], 3.0 * ofForce[n] + 2.0 * a[n], 1e-11);
  }
}

TEST(ElasticSurface, DoesNotDependOnTheSizeOfStiffnessNorOnThreads) {
  const TriangleMesh lung = testing::lungShaped(4);
  const Uneven of(lung);
  std::vector<double> four = of.stiffness;
  for (double& e : four) e *= 4.0;
  const std::vector<double> w = ElasticSurface(lung, of.stiffness).response(of.force);
  EXPECT_EQ(ElasticSurface(lung, four).response(of.force), w);
  const ElasticSurface coarse(lung, of.stiffness, {10.0, 500});
  const std::vector<double> many = coarse.response(of.force);
  const ThreadLimit one(1);
  EXPECT_EQ(ElasticSurface(lung, of.stiffness, {10.0, 500}).response(of.force), many);
}

TEST(ElasticSurface, IsForceByStiffnessWithoutALength) {
  const TriangleMesh lung = testing::lungShaped(3);
  const Uneven of(lung);
  const std::vector<double> w = ElasticSurface(lung, of.stiffness, {0.0}).response(of.force);
  const std::vector<double> lone =
      ElasticSurface(lung, of.stiffness, {0.0}).response(std::vector<double>(w.size(), 1.0));
  for (std::size_t n = 0; n < w.size(); ++n) EXPECT_NEAR(w[n], of.force[n] * lone[n], 1e-12);
}

TEST(ElasticSurface, ShowsNothingOfItsTriangles) {
  // The same everywhere stays the same everywhere, whatever the edges of points.
  const TriangleMesh uneven = testing::irregular(testing::lungShaped(4));
  const std::vector<double> ones(uneven.points.size(), 1.0);
  for (const double w : ElasticSurface(uneven).response(ones)) EXPECT_NEAR(w, 1.0, 1e-9);
  // And triangles a quarter as large change little; points of the coarser are those of the finer.
  const TriangleMesh coarse = testing::lungShaped(4);
  const TriangleMesh fine = testing::lungShaped(5);
  const Uneven ofCoarse(coarse);
  const Uneven ofFine(fine);
  const double change = apart(ElasticSurface(coarse).response(ofCoarse.force),
                              ElasticSurface(fine).response(ofFine.force));
  EXPECT_LE(change, 2e-3);
}

TEST(ElasticSurface, IsNearlyTheSameOnACoarseProxy) {
  const TriangleMesh lung = testing::lungShaped(5);
  const Uneven of(lung);
  const ElasticSurface proxy(lung, {}, {10.0, 2000});
  EXPECT_LT(proxy.solvedPoints(), 1700u);
  EXPECT_LE(apart(proxy.response(of.force), ElasticSurface(lung).response(of.force)),
            4e-3);  // 12 mm apart
}

TEST(SurfaceProxy, IsAClosedSurfaceOfSpreadPoints) {
  const TriangleMesh lung = testing::irregular(testing::lungShaped(5));
  const SurfaceProxy proxy = surfaceProxy(lung, edgeMatrix(lung), 800);
  EXPECT_NEAR(static_cast<double>(proxy.mesh.points.size()), 800.0, 250.0);
  // Euler's formula of a ball.
  EXPECT_NEAR(static_cast<double>(proxy.mesh.triangles.size()),
              2.0 * static_cast<double>(proxy.mesh.points.size()) - 4.0, 10.0);
  for (std::size_t n = 0; n < lung.points.size(); ++n) {
    const auto& [corner, share] = proxy.places[n];
    Vec3 there = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_GE(share[k], 0.0);
      there += share[k] * proxy.mesh.points[corner[k]];
    }
    EXPECT_LT((there - lung.points[n]).norm(), 5.0);
  }
}

TEST(SurfaceProxy, KeepsTwoSheetsApartThatNearlyTouch) {
  TriangleMesh thin = testing::sphere(60.0, Vec3::Zero(), 5);
  for (Vec3& p : thin.points) p.z() *= 0.02;
  const SurfaceProxy proxy = surfaceProxy(thin, edgeMatrix(thin), 800);
  const auto above =
      std::ranges::count_if(proxy.mesh.points, [](const Vec3& p) { return p.z() > 0.0; });
  EXPECT_GT(above, 240);  // each sheet has points of its own
  EXPECT_GT(static_cast<std::ptrdiff_t>(proxy.mesh.points.size()) - above, 240);
  std::size_t through = 0;
  for (const auto& [i, j, k] : proxy.mesh.triangles) {
    const auto& points = proxy.mesh.points;
    const double middle = (points[i] + points[j] + points[k]).head<2>().norm() / 3.0;
    const bool same = (points[i].z() > 0.0) == (points[j].z() > 0.0) &&
                      (points[j].z() > 0.0) == (points[k].z() > 0.0);
    if (!same && middle < 50.0) ++through;
  }
  EXPECT_EQ(through, 0u);
}

TEST(ElasticSurface, RefusesWhatItCannotSolveAndStopsWhenAsked) {
  EXPECT_THROW(ElasticSurface(TriangleMesh{}), InvalidInput);
  const TriangleMesh lung = testing::lungShaped(2);
  std::vector<double> stiffness(lung.points.size(), 1.0);
  stiffness[0] = -1.0;
  EXPECT_THROW(ElasticSurface(lung, stiffness), InvalidInput);
  stiffness.pop_back();
  EXPECT_THROW(ElasticSurface(lung, stiffness), InvalidInput);
  const ElasticSurface skin(lung);
  EXPECT_THROW(skin.response(stiffness), InvalidInput);
  testing::ProgressRecorder impatient(0.0);
  EXPECT_THROW(skin.response(Uneven(lung).force, {}, Progress(impatient)), Cancelled);
}

}  // namespace
}  // namespace pneuma
