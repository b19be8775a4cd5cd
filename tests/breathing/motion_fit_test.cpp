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
double fieldsApart(const A& a, const B& b) {
  const StrainedLungs lungs = madeLungs();
  double sum = 0.0;
  for (const LandmarkPair& pair : madeLandmarks(200, a, Vec3::Zero(), 0.0, 99)) {
    const Vec3 other = b(lungs.at(pair.side), pair.rest);
    sum += (pair.moved - pair.rest - other).norm();
  }
  return sum / 200.0;
}

auto polynomialField(const PolynomialForm& form) {
  return [form](const StrainedLung& lung, const Vec3& p) {
    return PolynomialField(form, lung.frame, lung.strain).at(p);
  };
}

TEST(FitPolynomialForm, FindsNineConstantsAndTheShift) {
  PolynomialForm truth;
  truth.constants.leftCols<3>() << 0.52, -0.34, -0.08, 0.46, 0.64, 0.50, 0.07, -0.29, 0.82;
  const PolynomialFit fit =
      fitPolynomialForm(madeLandmarks(40, polynomialField(truth), Shift, 0.0, 1), madeLungs());
  EXPECT_LT(fieldsApart(polynomialField(truth), polynomialField(fit.form)), 1.5);  // the ridge's
  EXPECT_LT((fit.form.constants - truth.constants).cwiseAbs().maxCoeff(), 0.05);
  EXPECT_LT((fit.shift - Shift).norm(), 1.0);
}

TEST(FitPolynomialForm, FindsTenConstantsOfQuietBreathingExactlyWithoutARidge) {
  PolynomialForm truth;
  truth.constants << 0.36, 0.0, 0.0, -0.19, 0.0, 0.0, -0.50, 0.09, 0.33, 0.0, 0.0, 0.0, 0.32, -0.52,
      2.2, 0.0, -1.17, -0.2;
  const PolynomialFit fit =
      fitPolynomialForm(madeLandmarks(20, polynomialField(truth), Shift, 0.0, 1), madeLungs(),
                        termsOf(MotionPreset::Quiet), 0.0);
  EXPECT_LT((fit.form.constants - truth.constants).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((fit.shift - Shift).norm(), 1e-9);
}

TEST(FitPolynomialForm, IsExactWhereTheRidgeDrawsTo) {
  const PolynomialFit fit =
      fitPolynomialForm(madeLandmarks(12, polynomialField(evenForm()), Shift, 0.0, 1), madeLungs());
  EXPECT_LT(fieldsApart(polynomialField(evenForm()), polynomialField(fit.form)), 1e-9);
}

class PublishedForms : public ::testing::TestWithParam<MotionPreset> {};

TEST_P(PublishedForms, AreFoundFromLandmarks) {
  const PublishedForm truth = publishedForm(GetParam());
  const PublishedFit clean =
      fitPublishedForm(madeLandmarks(40, fieldOf(truth), Shift, 0.0, 2), madeLungs());
  EXPECT_LT(fieldsApart(fieldOf(truth), fieldOf(clean.form)), 1e-3);
  EXPECT_LT((clean.shift - Shift).norm(), 1e-3);
  const PublishedFit noisy =
      fitPublishedForm(madeLandmarks(40, fieldOf(truth), Shift, 1.0, 3), madeLungs());
  const auto withShift = [&](const StrainedLung& lung, const Vec3& p) {
    return Vec3(fieldOf(noisy.form)(lung, p) + noisy.shift - Shift);
  };
  EXPECT_LT(fieldsApart(fieldOf(truth), withShift), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Presets, PublishedForms,
                         ::testing::Values(MotionPreset::Quiet, MotionPreset::Deep));

TEST(FitPublishedForm, StartsFromNeitherPreset) {
  const PublishedForm truth = reasonedForm();
  const PublishedFit fit =
      fitPublishedForm(madeLandmarks(40, fieldOf(truth), Shift, 0.0, 2), madeLungs());
  EXPECT_LT(fieldsApart(fieldOf(truth), fieldOf(fit.form)), 1e-3);
}

TEST(MotionFits, RefuseWhatTheyCannotUse) {
  const StrainedLungs lungs = madeLungs();
  const auto landmarks = madeLandmarks(40, polynomialField(evenForm()), Shift, 0.0, 1);
  EXPECT_THROW(fitPolynomialForm(std::span(landmarks).first(11), lungs), InvalidInput);
  auto broken = landmarks;
  broken[3].moved.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(fitPolynomialForm(broken, lungs), InvalidInput);
  EXPECT_THROW(fitPublishedForm(broken, lungs), InvalidInput);
  auto elsewhere = landmarks;
  elsewhere[7].side = Side::None;
  EXPECT_THROW(fitPublishedForm(elsewhere, lungs), InvalidInput);
}

}  // namespace
}  // namespace pneuma
