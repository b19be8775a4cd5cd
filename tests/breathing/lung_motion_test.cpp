#include "breathing/lung_motion.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/test_surfaces.h"

namespace pneuma {
namespace {

/// An ellipsoid of the size of a lung, 3.1 l.
TriangleMesh egg(double scale = 1.0, int subdivisions = 5) {
  TriangleMesh mesh = testing::sphere(1.0, Vec3::Zero(), subdivisions);
  for (Vec3& p : mesh.points) {
    p = Vec3(-70.0, 10.0, 30.0) + scale * p.cwiseProduct(Vec3(60.0, 95.0, 130.0));
  }
  return mesh;
}

TEST(LungFrame, BeginsAtHeartBackAndApexOfBothLungs) {
  const Box3 box(Vec3(-130.0, -85.0, -100.0), Vec3(-10.0, 105.0, 160.0));
  const LungFrame right(Side::Right, box);
  EXPECT_TRUE(right.shareOf({-10.0, 105.0, 160.0}).isZero(1e-12));
  EXPECT_TRUE(right.shareOf({-130.0, -85.0, -100.0}).isApprox(Vec3::Ones(), 1e-12));
  EXPECT_TRUE(right.toLps({1.0, 2.0, 3.0}).isApprox(Vec3(-1.0, -2.0, -3.0)));
  const LungFrame left(Side::Left, box);
  EXPECT_TRUE(left.shareOf({-130.0, 105.0, 160.0}).isZero(1e-12));
  EXPECT_TRUE(left.toLps({1.0, 2.0, 3.0}).isApprox(Vec3(1.0, -2.0, -3.0)));
}

TEST(PresetField, TakesTheTablesConstants) {
  const Box3 box(Vec3(0.0, 0.0, 0.0), Vec3(100.0, 150.0, 200.0));
  const LungFrame frame(Side::Left, box);
  const double gain = std::pow(1.1, 3.0) - 1.0;  // a strain of 0.1
  // At the base, front and side: q = (1, 1, 1).
  const Vec3 corner(100.0, 0.0, 0.0);
  const Vec3 deep = PresetField(MotionPreset::Deep, frame, gain).at(corner);
  EXPECT_NEAR(deep.x(), 0.1 * 100.0 * (0.52 - 0.34 - 0.08), 1e-9);
  EXPECT_NEAR(deep.y(), -0.1 * 150.0 * (0.46 + 0.64 + 0.50), 1e-9);
  EXPECT_NEAR(deep.z(), -0.1 * 200.0 * (0.07 - 0.29 + 0.82), 1e-9);
  const Vec3 quiet = PresetField(MotionPreset::Quiet, frame, gain).at(corner);
  EXPECT_NEAR(quiet.x(), 0.075 * 100.0 * (0.48 - 0.25), 1e-9);
  EXPECT_NEAR(quiet.y(), -0.075 * 150.0 * (-0.66 + 0.12 + 0.44), 1e-9);
  EXPECT_NEAR(quiet.z(), -0.075 * 200.0 * (0.42 - 0.69 + 2.94 - 0.27 - 1.56), 1e-9);
}

struct MotionCase {
  LungMotionOptions options;
  double gain;
  int subdivisions = 5;
};

class Motions : public ::testing::TestWithParam<MotionCase> {
 protected:
  double gain() const { return GetParam().gain; }

  const TriangleMesh mesh = egg(1.0, GetParam().subdivisions);

  LungMotion motion() const {
    return {Side::Right, mesh, GetParam().options, (1.0 + gain()) * signedVolumeMm3(mesh)};
  }
};

TEST_P(Motions, HaveTheVolumeAskedForAtEveryStep) {
  const LungMotion moved = motion();
  EXPECT_NEAR(moved.scaleFor((1.0 + gain()) * moved.restMm3()), 1.0, 1e-9);
  EXPECT_NEAR(moved.scaleFor(moved.restMm3()), 0.0, 1e-12);
  for (int step = -2; step <= 12; ++step) {
    const double wanted = moved.restMm3() * (1.0 + gain() * step / 10.0);
    const double s = moved.scaleFor(wanted);
    TriangleMesh now = mesh;
    for (std::size_t n = 0; n < now.points.size(); ++n) now.points[n] += s * moved.ofWall()[n];
    EXPECT_NEAR(signedVolumeMm3(now), wanted, 1e-3) << step;  // 1e-6 ml
  }
}

TEST_P(Motions, GiveTheWallAndItsInsideOneField) {
  const LungMotion moved = motion();
  for (std::size_t n = 0; n < mesh.points.size(); n += 97) {
    EXPECT_NEAR((moved.at(mesh.points[n]) - moved.ofWall()[n]).norm(), 0.0, 1e-9) << n;
    // 1 % further in the field is at most 2 % of itself and a fifteenth of the layer's millimetre
    // away.
    const Vec3 inner = mesh.points[n] - 0.01 * (mesh.points[n] - Vec3(-70.0, 10.0, 30.0));
    const double most =
        0.03 * moved.ofWall()[n].norm() + 0.1 * std::max(1.0, std::abs(moved.layerMm()));
    EXPECT_LT((moved.at(inner) - moved.ofWall()[n]).norm(), most) << n;
  }
}

TEST_P(Motions, KnowHowTheyChangeFromPlaceToPlace) {
  const LungMotion moved = motion();
  double most = 0.0;
  double sum = 0.0;
  int count = 0;
  for (double share = 0.35; share < 1.0; share += 0.1) {
    const TriangleMesh shell = egg(share);
    for (std::size_t n = 0; n < shell.points.size(); n += 41) {
      const Vec3& p = shell.points[n];
      const FieldAt field = moved.withGradientAt(p);
      EXPECT_EQ(field.value, moved.at(p));
      // Over a length of several triangles, as the field itself has their edges in it.
      constexpr double HalfMm = 2.0;
      Eigen::Matrix3d differences;
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 step = HalfMm * Vec3::Unit(axis);
        differences.col(axis) = (moved.at(p + step) - moved.at(p - step)) / (2.0 * HalfMm);
      }
      const double off = (field.gradient - differences).cwiseAbs().maxCoeff();
      most = std::max(most, off);
      sum += off;
      ++count;
    }
  }
  const double layer = std::max(1.0, std::abs(moved.layerMm()));
  EXPECT_LT(sum / count, 0.002 * layer);
  EXPECT_LT(most, 0.03 * layer);
}

TEST_P(Motions, TurnNothingInsideOut) {
  const LungMotion moved = motion();
  std::vector<Vec3> inside;
  for (double share = 0.05; share < 1.0; share += 0.1) {
    const TriangleMesh shell = egg(share);
    for (std::size_t n = 0; n < shell.points.size(); n += 41) inside.push_back(shell.points[n]);
  }
  EXPECT_GT(moved.maxScale(), 1.5);
  for (const double s : {-0.5, 0.5, 1.0, 1.5}) {
    EXPECT_GT(leastDeterminant(moved, inside, s), 0.1) << s;
  }
  EXPECT_NEAR(leastDeterminant(moved, inside, 0.0), 1.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Presets, Motions,
                         ::testing::Values(MotionCase{{MotionPreset::Quiet}, 0.15},
                                           MotionCase{{MotionPreset::Quiet}, 0.25},
                                           MotionCase{{MotionPreset::Deep}, 0.6},
                                           MotionCase{{MotionPreset::Deep}, 1.0}));

LungMotionOptions by(MotionModel model, Posture posture) {
  return {MotionPreset::Quiet, model, posture};
}

LungMotionOptions byForm(const MotionForm& form) {
  LungMotionOptions options;
  options.form = std::make_shared<const MotionForm>(form);
  return options;
}

/// Of a lung in which every power is 1 or more, so that no place is infinitely steep.
const PublishedForm Smooth{{0.2, 0.4, 1.0}, {1.0, 1.0, 1.3}, 0.1, {0.1, 0.2, 0.8}};

INSTANTIATE_TEST_SUITE_P(OwnForms, Motions,
                         ::testing::Values(MotionCase{byForm(evenForm()), 0.5, 4},
                                           MotionCase{byForm(Smooth), 0.3, 4}));

INSTANTIATE_TEST_SUITE_P(
    ByForces, Motions,
    ::testing::Values(MotionCase{by(MotionModel::Preset, Posture::Prone), 0.15, 3},
                      MotionCase{by(MotionModel::Preset, Posture::LeftLateral), 0.15, 3},
                      MotionCase{by(MotionModel::Published, Posture::Supine), 0.15, 3},
                      MotionCase{by(MotionModel::Continuous, Posture::Upright), 0.15, 3}));

TEST(LungMotion, IsThePresetItselfInSupine) {
  const TriangleMesh mesh = egg();
  const double most = 1.15 * signedVolumeMm3(mesh);
  LungMotionOptions supine;
  supine.postureShare = 0.5;
  const LungMotion moved(Side::Right, mesh, supine, most);
  const PresetField preset(MotionPreset::Quiet, LungFrame(Side::Right, bounds(mesh)),
                           most / signedVolumeMm3(mesh) - 1.0);
  const VolumeLayer layer(mesh);
  for (std::size_t n = 0; n < mesh.points.size(); n += 97) {
    const Vec3 p = 0.9 * mesh.points[n];
    EXPECT_EQ(moved.at(p), preset.at(p) + moved.layerMm() * layer.at(p));
  }
}

TEST(LungMotion, TakesSomebodysOwnConstantsInPlaceOfThePresets) {
  const TriangleMesh mesh = egg(1.0, 4);
  const double most = 1.331 * signedVolumeMm3(mesh);  // a strain of 0.1
  const LungMotion moved(Side::Right, mesh, byForm(evenForm()), most);
  const FormField field(evenForm(), LungFrame(Side::Right, bounds(mesh)), 0.1);
  const VolumeLayer layer(mesh);
  const Vec3 p = 0.5 * (mesh.points[0] + Vec3(-70.0, 10.0, 30.0));
  EXPECT_LT((moved.at(p) - field.at(p) - moved.layerMm() * layer.at(p)).norm(), 1e-9);
  EXPECT_GT(moved.layerMm(), 1.0);  // what 0.7 of the expansion lacks
}

/// The share of a straight line in the scales at volumes up to `mostMm3` more.
double straightness(const VolumePolynomial& volume, double mostMm3) {
  constexpr int Steps = 50;
  Eigen::MatrixX2d line(Steps + 1, 2);
  Eigen::VectorXd scale(Steps + 1);
  for (int n = 0; n <= Steps; ++n) {
    line.row(n) << 1.0, static_cast<double>(n) / Steps;
    scale[n] = scaleForVolume(volume, volume.a[0] + mostMm3 * n / Steps).value();
  }
  const Eigen::VectorXd fitted =
      line * (line.transpose() * line).inverse() * (line.transpose() * scale);
  return 1.0 - (scale - fitted).squaredNorm() / (scale.array() - scale.mean()).square().sum();
}

TEST(LungMotion, DisplacesPointsNearlyInProportionToVolume) {
  // As the paper has it from landmarks.
  for (const MotionModel model :
       {MotionModel::Preset, MotionModel::Published, MotionModel::Continuous}) {
    // One with more points than are carried on into the lung.
    const TriangleMesh mesh = egg(1.0, model == MotionModel::Published ? 4 : 3);
    const double most = signedVolumeMm3(mesh) + 5e5;
    const LungMotion moved(Side::Right, mesh, by(model, Posture::Supine), most);
    EXPECT_NEAR(moved.scaleFor(most), 1.0, 1e-9);
    EXPECT_GE(straightness(moved.volume(), 5e5), 0.999);
    EXPECT_GE(straightness(moved.volume(), 3e6), 0.99);
    EXPECT_LT(straightness(moved.volume(), 3e6), 0.9999);
  }
}

TEST(LungMotion, TakesUpTheDifferenceOfAPosture) {
  const TriangleMesh mesh = egg(1.0, 4);
  const double most = 1.15 * signedVolumeMm3(mesh);
  const LungFrame frame(Side::Left, bounds(mesh));
  const SurfaceMotion skin(mesh, frame, MotionModel::Continuous);
  const std::vector<Vec3> prone = skin.at(Posture::Prone, most);
  const std::vector<Vec3> supine = skin.at(Posture::Supine, most);
  const LungMotion preset(Side::Left, mesh, MotionPreset::Quiet, most);
  for (const double share : {1.0, 0.5}) {
    LungMotionOptions options = by(MotionModel::Preset, Posture::Prone);
    options.postureShare = share;
    const LungMotion moved(Side::Left, mesh, options, most);
    const VolumeLayer layer(mesh);
    double apart = 0.0;
    double size = 0.0;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      const Vec3 expected = preset.ofWall()[n] + share * (prone[n] - supine[n]) +
                            (moved.layerMm() - preset.layerMm()) * layer.normals()[n];
      apart += (moved.ofWall()[n] - expected).squaredNorm();
      size += (share * (prone[n] - supine[n])).squaredNorm();
    }
    EXPECT_LT(std::sqrt(apart / size), 0.02);
    EXPECT_GT(std::sqrt(size / static_cast<double>(mesh.points.size())), 0.5);
  }
}

TEST(LungMotion, NamesTheVolumesThatDoNotFold) {
  const TriangleMesh mesh = egg();
  const double rest = signedVolumeMm3(mesh);
  const LungMotion moved(Side::Left, mesh, MotionPreset::Quiet, 1.2 * rest);
  try {
    moved.scaleFor(0.01 * rest);
    FAIL() << "no limit";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("left lung would fold"), std::string::npos)
        << error.what();
  }
}

TEST(LungMotion, AStiffPartMovesLessAndTheVolumeStays) {
  const TriangleMesh mesh = egg();
  const double most = 1.2 * signedVolumeMm3(mesh);
  LungMotionOptions options;
  const LungMotion healthy(Side::Right, mesh, options, most);
  const Vec3 base(-70.0, 10.0, -100.0);
  options.stiffness.assign(mesh.points.size(), 1.0);
  EXPECT_LT((LungMotion(Side::Right, mesh, options, most).at(base) - healthy.at(base)).norm(),
            1e-6);
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    if ((mesh.points[n] - base).norm() < 40.0) options.stiffness[n] = 5.0;
  }
  const LungMotion sick(Side::Right, mesh, options, most);
  EXPECT_LT(sick.at(base).norm(), healthy.at(base).norm() - 1.0);
  EXPECT_NEAR(sick.volume().at(1.0), most, 1e-3);
  EXPECT_EQ(sick.at(base), sick.withGradientAt(base).value);
}

TEST(LungMotion, RefusesWhatIsNoLung) {
  const TriangleMesh metres = egg(1e-3);
  EXPECT_THROW(LungMotion(Side::Left, metres, MotionPreset::Quiet, 3.5e-3), InvalidInput);
  TriangleMesh inverted = egg();
  for (auto& triangle : inverted.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_THROW(LungMotion(Side::Left, inverted, MotionPreset::Quiet, 3.5e6), InvalidInput);
  EXPECT_THROW(LungMotion(Side::Left, {}, MotionPreset::Quiet, 3.5e6), InvalidInput);
}

}  // namespace
}  // namespace pneuma
