#include "breathing/landmark_error.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"

namespace pneuma {
namespace {

std::vector<LandmarkPair> corners(const Vec3& shift, double turn) {
  std::vector<LandmarkPair> landmarks;
  for (int n = 0; n < 8; ++n) {
    const Vec3 p(n & 1 ? 80.0 : -60.0, n & 2 ? 40.0 : -90.0, n & 4 ? 150.0 : -20.0);
    landmarks.push_back({p, rotated(p, Vec3(0.6, 0.0, 0.8), turn) + shift, Side::None});
  }
  return landmarks;
}

TEST(LandmarkErrors, TakeOutAShiftAndATurn) {
  const std::vector<Vec3> still(8, Vec3::Zero());
  const LandmarkErrors shifted = landmarkErrors(corners({3.0, -4.0, 12.0}, 0.0), still);
  EXPECT_NEAR(shifted.raw.meanMm, 13.0, 1e-12);
  EXPECT_NEAR(shifted.raw.sdMm, 0.0, 1e-12);
  EXPECT_NEAR(shifted.shifted.meanMm, 0.0, 1e-12);
  const LandmarkErrors turned = landmarkErrors(corners({3.0, -4.0, 12.0}, 0.2), still);
  EXPECT_GT(turned.shifted.meanMm, 5.0);
  EXPECT_NEAR(turned.rigid.meanMm, 0.0, 1e-9);
}

TEST(LandmarkErrors, AreOfThePredictedPlaces) {
  std::vector<LandmarkPair> landmarks = corners(Vec3::Zero(), 0.0);
  std::vector<Vec3> displacement(8, Vec3::Zero());
  EXPECT_EQ(landmarkErrors(landmarks, displacement).raw.meanMm, 0.0);
  for (std::size_t n = 0; n < 8; ++n) displacement[n].x() = n < 4 ? 1.0 : 3.0;
  const LandmarkError raw = landmarkErrors(landmarks, displacement).raw;
  EXPECT_NEAR(raw.meanMm, 2.0, 1e-12);
  EXPECT_NEAR(raw.sdMm, std::sqrt(8.0 / 7.0), 1e-12);
}

TEST(LandmarkErrors, RefuseUnequalCountsAndTooFew) {
  const std::vector<LandmarkPair> landmarks = corners(Vec3::Zero(), 0.0);
  EXPECT_THROW(landmarkErrors(landmarks, std::vector<Vec3>(7)), InvalidInput);
  EXPECT_THROW(landmarkErrors(std::span(landmarks).first(2), std::vector<Vec3>(2)), InvalidInput);
}

}  // namespace
}  // namespace pneuma
