#include "breathing/form_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "breathing/made_lungs.h"
#include "core/error.h"

namespace pneuma {
namespace {

using testing::madeLandmarks;
using testing::madeLung;
using testing::madeLungs;

const Vec3 NoShift = Vec3::Zero();

auto fieldBy(const MotionForm& form) {
  return [form](const StrainedLung& lung, const Vec3& p) {
    return FormField(form, lung.frame, lung.strain).at(p);
  };
}

/// Constants of the kind that no fit starts from.
MotionForm truthOf(FormKind kind) {
  if (kind == FormKind::Published) {
    return PublishedForm{{0.3, 0.6, 1.0}, {1.1, 0.8, 1.6}, 0.1, {0.3, 0.2, 0.8}};
  }
  std::vector<double> constants;
  for (std::size_t n = 0; n < constantCount(kind); ++n) {
    constants.push_back(std::sin(1.0 + static_cast<double>(n)));
  }
  return formOf(kind, constants);
}

class FormFits : public ::testing::TestWithParam<FormKind> {
 protected:
  FormFit fitOf(double noiseMm, std::span<const WallReading> walls = {}) const {
    const auto landmarks = madeLandmarks(60, fieldBy(truth), Shift, noiseMm, 4);
    return fitForm(landmarks, madeLungs(), walls, {GetParam(), 0.0, 0.1});
  }

  const Vec3 Shift{-1.5, 12.0, 4.0};
  const MotionForm truth = truthOf(GetParam());
};

TEST_P(FormFits, GiveBackTheConstantsThatLandmarksWereMadeBy) {
  const FormFit fit = fitOf(0.0);
  const std::vector<double> wanted = constantsOf(truth, GetParam());
  const std::vector<double> found = constantsOf(fit.form, GetParam());
  ASSERT_EQ(found.size(), constantCount(GetParam()));
  for (std::size_t n = 0; n < wanted.size(); ++n) EXPECT_NEAR(found[n], wanted[n], 1e-3) << n;
  EXPECT_LT((fit.shift - Shift).norm(), 1e-3);
}

TEST_P(FormFits, KnowHowFarOffTheirConstantsAre) {
  // Of 9 or 10 constants, each off by its standard error in the mean.
  double squares = 0.0;
  const FormFit fit = fitOf(1.0);
  const std::vector<double> wanted = constantsOf(truth, GetParam());
  const std::vector<double> found = constantsOf(fit.form, GetParam());
  for (std::size_t n = 0; n < wanted.size(); ++n) {
    ASSERT_GT(fit.standardErrors[n], 0.0);
    squares += std::pow((found[n] - wanted[n]) / fit.standardErrors[n], 2.0);
  }
  const double mean = std::sqrt(squares / static_cast<double>(wanted.size()));
  EXPECT_GT(mean, 0.3);
  EXPECT_LT(mean, 2.0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, FormFits,
                         ::testing::Values(FormKind::Deep, FormKind::Quiet, FormKind::Published));

TEST(FormFit, OfAConstantThatMovesNothingIsNotDetermined) {
  // c1 is next to nothing, so that its power c2 does not show.
  const PublishedForm still{{1e-30, 0.6, 1.0}, {1.1, 0.8, 1.6}, 0.1, {0.3, 0.2, 0.8}};
  const auto landmarks = madeLandmarks(60, fieldBy(still), NoShift, 1.0, 4);
  const FormFit fit = fitForm(landmarks, madeLungs(), {}, {FormKind::Published});
  EXPECT_GT(fit.standardErrors[2], 1.0);
  EXPECT_LT(fit.standardErrors[4], 1.0);
}

TEST(PolynomialForm, ListsTheConstantsOfItsKindRowByRow) {
  EXPECT_EQ(constantCount(FormKind::Deep), 9U);
  EXPECT_EQ(constantCount(FormKind::Quiet), 10U);
  const auto quiet =
      std::get<PolynomialForm>(formOf(FormKind::Quiet, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(quiet.constants.row(0), (Eigen::RowVector<double, 6>(1, 0, 0, 2, 0, 0)));
  EXPECT_EQ(quiet.constants.row(1), (Eigen::RowVector<double, 6>(3, 4, 5, 0, 0, 0)));
  EXPECT_EQ(quiet.constants.row(2), (Eigen::RowVector<double, 6>(6, 7, 8, 0, 9, 10)));
}

class FormFields : public ::testing::TestWithParam<FormKind> {};

TEST_P(FormFields, KnowHowTheyChangeFromPlaceToPlace) {
  const StrainedLung lung = madeLungs().at(Side::Right);
  const FormField field(truthOf(GetParam()), lung.frame, lung.strain);
  for (const LandmarkPair& pair :
       madeLandmarks(40, fieldBy(truthOf(GetParam())), NoShift, 0.0, 6)) {
    if (pair.side != Side::Right) continue;
    constexpr double HalfMm = 1e-4;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = HalfMm * Vec3::Unit(axis);
      const Vec3 slope = (field.at(pair.rest + step) - field.at(pair.rest - step)) / (2.0 * HalfMm);
      EXPECT_LT((field.gradientAt(pair.rest).col(axis) - slope).norm(), 1e-6);
    }
  }
  if (GetParam() != FormKind::Published) return;
  // Beside the box its shares stay those of the wall.
  const Vec3 beside(-75.0, 10.0, 400.0);
  EXPECT_TRUE(field.gradientAt(beside).col(2).isZero());
}

INSTANTIATE_TEST_SUITE_P(Kinds, FormFields,
                         ::testing::Values(FormKind::Deep, FormKind::Quiet, FormKind::Published));

TriangleMesh movedWall(Side side, const MotionForm& form, double strain, const Vec3& shift) {
  TriangleMesh wall = madeLung(side, 4);
  const FormField field(form, {side, bounds(wall)}, strain);
  for (Vec3& p : wall.points) p += field.at(p) + shift;
  return wall;
}

TEST(WallReading, IsNothingOnTheTrueMotionAndTheShiftOffIt) {
  const MotionForm even = evenForm();
  // 0.7 of a strain s widens the volume by (1 + 0.7 s)^3, so that the wall's own strain is 0.7 s.
  const WallReading reading(Side::Right, madeLung(Side::Right, 4),
                            movedWall(Side::Right, even, 0.2, NoShift));
  EXPECT_NEAR(reading.lung().strain, 0.14, 1e-9);
  PolynomialForm whole;
  whole.constants = evenForm().constants / 0.7;
  EXPECT_LT(meanDistanceMm(reading, whole, NoShift), 1e-6);
  EXPECT_NEAR(meanDistanceMm(reading, whole, Vec3(0.0, 0.0, 2.0)), 1.2, 0.5);
  EXPECT_THROW(WallReading(Side::Left, madeLung(Side::Left, 2), madeLung(Side::Left, 2)),
               InvalidInput);
}

TEST(WallReading, HelpsFewLandmarksAndDoesNotSpoilMany) {
  // Walls that truly moved by the strain that their volumes tell.
  const MotionForm truth = publishedForm(MotionPreset::Deep);
  for (const std::size_t count : {12U, 60U}) {
    std::vector<WallReading> walls;
    StrainedLungs lungs;
    for (const Side side : {Side::Right, Side::Left}) {
      walls.emplace_back(side, madeLung(side, 4), movedWall(side, truth, 0.17, NoShift));
      lungs.emplace(side, walls.back().lung());
    }
    const auto apart = [&](const FormFit& fit) {
      double sum = 0.0;
      for (const LandmarkPair& pair : madeLandmarks(200, fieldBy(truth), NoShift, 0.0, 99)) {
        sum +=
            (displacementBy(fit.form, lungs, pair) + fit.shift - (pair.moved - pair.rest)).norm();
      }
      return sum / 200.0;
    };
    const auto landmarks = madeLandmarks(count, fieldBy(truth), NoShift, 3.0, 5);
    const FormFit alone = fitForm(landmarks, lungs, {}, {FormKind::Deep});
    const FormFit hinted = fitForm(landmarks, lungs, walls, {FormKind::Deep});
    const FormFit none = fitForm(landmarks, lungs, walls, {FormKind::Deep, WeakRidge, 0.0});
    EXPECT_EQ(none.shift, alone.shift);
    if (count == 12U) {
      EXPECT_LT(apart(hinted), apart(alone));
    } else {
      EXPECT_LT(apart(hinted), apart(alone) + 0.3);
    }
  }
}

}  // namespace
}  // namespace pneuma
