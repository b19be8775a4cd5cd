#include "breathing/motion_fit.h"

#include <limits>

#include <gtest/gtest.h>

#include "breathing/made_lungs.h"
#include "core/error.h"

namespace pneuma {
namespace {

using testing::fieldOf;
using testing::madeLandmarks;
using testing::madeLungs;

const Vec3 Shift(-1.5, 20.0, 4.0);

/// Mean distance between two fields on 200 places that no fit has seen, mm.
template <class A, class B>
double apart(const A& a, const B& b) {
  const StrainedLungs lungs = madeLungs();
  double sum = 0.0;
  for (const LandmarkPair& pair : madeLandmarks(200, a, Vec3::Zero(), 0.0, 99)) {
    const Vec3 other = b(lungs.at(pair.side), pair.rest);
    sum += (pair.moved - pair.rest - other).norm();
  }
  return sum / 200.0;
}

auto linearField(const LinearForm& form) {
  return [form](const StrainedLung& lung, const Vec3& p) { return form.at(lung, p); };
}

TEST(FitLinearForm, FindsNineConstantsAndTheShift) {
  LinearForm truth;
  truth.slopes << 0.52, -0.34, -0.08, 0.46, 0.64, 0.50, 0.07, -0.29, 0.82;
  const LinearFit fit =
      fitLinearForm(madeLandmarks(40, linearField(truth), Shift, 0.0, 1), madeLungs());
  EXPECT_LT(apart(linearField(truth), linearField(fit.form)), 1.5);  // the ridge's
  EXPECT_LT((fit.form.slopes - truth.slopes).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT((fit.shift - Shift).norm(), 1.0);
}

TEST(FitLinearForm, IsExactWhereTheRidgeDrawsTo) {
  const LinearFit fit =
      fitLinearForm(madeLandmarks(12, linearField({}), Shift, 0.0, 1), madeLungs());
  EXPECT_LT(apart(linearField({}), linearField(fit.form)), 1e-9);
}

class PublishedForms : public ::testing::TestWithParam<MotionPreset> {};

TEST_P(PublishedForms, AreFoundFromLandmarks) {
  const PublishedForm truth = publishedForm(GetParam());
  const PublishedFit clean =
      fitPublishedForm(madeLandmarks(40, fieldOf(truth), Shift, 0.0, 2), madeLungs());
  EXPECT_LT(apart(fieldOf(truth), fieldOf(clean.form)), 1e-3);
  EXPECT_LT((clean.shift - Shift).norm(), 1e-3);
  const PublishedFit noisy =
      fitPublishedForm(madeLandmarks(40, fieldOf(truth), Shift, 1.0, 3), madeLungs());
  const auto withShift = [&](const StrainedLung& lung, const Vec3& p) {
    return Vec3(fieldOf(noisy.form)(lung, p) + noisy.shift - Shift);
  };
  EXPECT_LT(apart(fieldOf(truth), withShift), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Presets, PublishedForms,
                         ::testing::Values(MotionPreset::Quiet, MotionPreset::Deep));

TEST(FitPublishedForm, StartsFromNeitherPreset) {
  const PublishedForm truth = reasonedForm();
  const PublishedFit fit =
      fitPublishedForm(madeLandmarks(40, fieldOf(truth), Shift, 0.0, 2), madeLungs());
  EXPECT_LT(apart(fieldOf(truth), fieldOf(fit.form)), 1e-3);
}

TEST(MotionFits, RefuseWhatTheyCannotUse) {
  const StrainedLungs lungs = madeLungs();
  const auto landmarks = madeLandmarks(40, linearField({}), Shift, 0.0, 1);
  EXPECT_THROW(fitLinearForm(std::span(landmarks).first(11), lungs), InvalidInput);
  auto broken = landmarks;
  broken[3].moved.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(fitLinearForm(broken, lungs), InvalidInput);
  EXPECT_THROW(fitPublishedForm(broken, lungs), InvalidInput);
  auto elsewhere = landmarks;
  elsewhere[7].side = Side::None;
  EXPECT_THROW(fitPublishedForm(elsewhere, lungs), InvalidInput);
}

}  // namespace
}  // namespace pneuma
