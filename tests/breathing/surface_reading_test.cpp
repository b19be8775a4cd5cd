#include "breathing/surface_reading.h"

#include <gtest/gtest.h>

#include "breathing/made_lungs.h"
#include "core/error.h"

namespace pneuma {
namespace {

using testing::fieldOf;
using testing::madeLandmarks;
using testing::madeLung;

TriangleMesh movedLung(const TriangleMesh& rest, const PublishedForm& form, double strain) {
  const PublishedField field(form, {Side::Right, bounds(rest)}, strain);
  TriangleMesh moved = rest;
  for (Vec3& p : moved.points) p += field.at(p);
  return moved;
}

SurfaceReading readingOf(const PublishedForm& form) {
  const TriangleMesh rest = madeLung(Side::Right, 4);
  return {Side::Right, rest, movedLung(rest, form, 0.06), movedLung(rest, form, 0.12), 400};
}

/// The same way in all three directions: 23 degrees off the truth.
PublishedForm wrongDirections() {
  PublishedForm wrong = reasonedForm();
  wrong.weights = Vec3::Ones();
  wrong.powers = Vec3::Ones();
  return wrong;
}

TEST(SurfaceReading, IsBlindToDirectionsWhichLandmarksReject) {
  const SurfaceReading reading = readingOf(reasonedForm());
  // Volume grows not quite in proportion to the way: 0.5 mm at the truth.
  EXPECT_LT(reading.meanResidualMm(reasonedForm()), 1.0);
  // The published validation, 1 % or 2 mm, accepts wrong directions.
  EXPECT_LT(reading.meanResidualMm(wrongDirections()), 1.0);

  const auto landmarks = madeLandmarks(40, fieldOf(reasonedForm()), Vec3::Zero(), 0.0, 5);
  const StrainedLungs lungs = testing::madeLungs();
  double sum = 0.0;
  for (const LandmarkPair& pair : landmarks) {
    const Vec3 predicted = pair.rest + fieldOf(wrongDirections())(lungs.at(pair.side), pair.rest);
    sum += (pair.moved - predicted).norm();
  }
  EXPECT_GT(sum / 40.0, 4.0);
}

TEST(SurfaceReading, StopsOnlyAtSheetsThatFaceAsTheStartDoes) {
  // Within the wall a second sheet that faces inwards, 1 to 3 mm deep.
  const Vec3 centre(-75.0, 10.0, 30.0);
  const TriangleMesh wall = madeLung(Side::Right, 4);
  TriangleMesh inner = testing::insideOut(wall);
  for (Vec3& p : inner.points) p = centre + 0.98 * (p - centre);
  const TriangleMesh shell = testing::together(wall, inner);
  const SurfaceReading reading(Side::Right, shell, movedLung(shell, reasonedForm(), 0.06),
                               movedLung(shell, reasonedForm(), 0.12), 400);
  EXPECT_LT(reading.meanResidualMm(reasonedForm()), 1.0);
}

TEST(SurfaceReading, HintsWithoutSpoilingLandmarks) {
  std::vector<SurfaceReading> surfaces;
  surfaces.push_back(readingOf(reasonedForm()));
  const StrainedLungs lungs = testing::madeLungs();
  const auto landmarks = madeLandmarks(40, fieldOf(reasonedForm()), Vec3::Zero(), 1.0, 6);
  const PublishedFit fit = fitPublishedForm(landmarks, lungs, surfaces);
  double sum = 0.0;
  for (const LandmarkPair& pair :
       madeLandmarks(100, fieldOf(reasonedForm()), Vec3::Zero(), 0.0, 7)) {
    const Vec3 found = fieldOf(fit.form)(lungs.at(pair.side), pair.rest) + fit.shift;
    sum += (pair.moved - pair.rest - found).norm();
  }
  EXPECT_LT(sum / 100.0, 2.0);
}

TEST(SurfaceReading, RefusesVolumesThatDoNotRise) {
  const TriangleMesh rest = madeLung(Side::Right, 2);
  const TriangleMesh more = movedLung(rest, reasonedForm(), 0.1);
  EXPECT_THROW(SurfaceReading(Side::Right, rest, more, more), InvalidInput);
  EXPECT_THROW(SurfaceReading(Side::Right, more, rest, more), InvalidInput);
}

}  // namespace
}  // namespace pneuma
