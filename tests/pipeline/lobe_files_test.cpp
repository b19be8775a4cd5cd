// Lobes from whatever there is, and the checks of what is written.
#include "pipeline/lobe_files.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/surface_voxels.h"
#include "io/surface_file.h"
#include "io/volume_file.h"
#include "pipeline/lobe_checks.h"
#include "pipeline/lobe_labels.h"
#include "pipeline/whole_lungs.h"
#include "segmentation/lung_labels.h"

namespace pneuma {
namespace {

/// An S that leans over itself, drawn out along x, in the middle of `centre`.
FissurePatch overhanging(const Vec3& centre) {
  auto mesh = std::make_shared<TriangleMesh>();
  constexpr int Half = 20;
  for (int j = -Half; j <= Half; ++j) {
    for (int i = -Half; i <= Half; ++i) {
      const double y = 5.2 * i - 55.0 * std::sin(std::numbers::pi * i / Half);
      mesh->points.push_back(centre + Vec3(4.0 * j, y, 3.0 * i));
      if (i == Half || j == Half) continue;
      const auto v = static_cast<std::uint32_t>(mesh->points.size() - 1);
      const std::uint32_t beside = v + 2 * Half + 1;
      mesh->triangles.push_back({v, beside, beside + 1});
      mesh->triangles.push_back({v, beside + 1, v + 1});
    }
  }
  return {"patch.vtp", std::move(mesh), {}};
}

/// A ball in triangles of an octahedron, pressed into a lung's shape.
TriangleMesh egg(const Vec3& centre) {
  TriangleMesh mesh;
  mesh.points = {Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                 -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int round = 0; round < 6; ++round) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.points.size()));
      if (isNew) mesh.points.push_back((mesh.points[a] + mesh.points[b]).normalized());
      return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (Vec3& p : mesh.points) {
    p = centre + p.cwiseProduct(Vec3(50.0, 80.0, 110.0)) * (1.0 - 0.15 * p.z());
  }
  return mesh;
}

class LobeFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_ / "fissures");
    std::filesystem::create_directories(folder_ / "lungs");
    writeSurface(folder_ / "lungs/right.vtp", egg(Vec3(-80.0, 0.0, 0.0)));
    writeSurface(folder_ / "lungs/left.vtp", egg(Vec3(80.0, 0.0, 0.0)));
  }

  void TearDown() override { std::filesystem::remove_all(folder_); }

  LungModel lungs() const {
    const std::filesystem::path path = folder_ / "lungs";
    return openLungs({&path, 1});
  }

  /// Lobes as the command writes them.
  LobesOfLungs makeLobes() const {
    const LungModel model = lungs();
    const LobesOfLungs lobes = splitLobes(model, {});
    pneuma::writeLobes(folder_, lobes, lobeLabels(lungLabels(model, 2.0), lobes), {},
                       lobesReport(model, lobes, {}));
    return lobes;
  }

  /// The checks that fail, with blanks between.
  std::string failing() const {
    std::string ids;
    for (const LobeCheck& check : checkLobes(folder_).checks) {
      if (!check.ok()) ids += (ids.empty() ? "" : " ") + check.id;
    }
    return ids;
  }

  void changeLobe(Lobe lobe, const std::function<void(TriangleMesh&)>& change) const {
    TriangleMesh mesh = readSurface(folder_ / lobeFile(lobe)).mesh;
    change(mesh);
    writeSurface(folder_ / lobeFile(lobe), mesh);
  }

  std::string refusal(std::vector<std::filesystem::path> paths,
                      const LungLabelOptions& labels = {}) const {
    try {
      openLungs(paths, labels);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) /
                                  ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(LobeFilesTest, PassEveryCheckWhereFissuresFold) {
  const LungModel model = lungs();
  LobeInputs inputs;
  inputs.given[Fissure::RightOblique].patch = overhanging(Vec3(-80.0, 0.0, -20.0));
  inputs.given[Fissure::LeftOblique].patch = overhanging(Vec3(80.0, 0.0, 0.0));
  const LobesOfLungs lobes = splitLobes(model, inputs);
  EXPECT_EQ(lobes.fissures.at(Fissure::LeftOblique).source, FissureSource::FoldingSurface);
  // An image with voxels beyond the lung, too: all of them go to a lobe.
  LabelImage whole = lungLabels(model, 2.0);
  for (int step = 0; step < 2; ++step) {
    for (std::size_t v = whole.voxels.size() - 1; v > 0; --v) {
      if (whole.voxels[v] == 0) whole.voxels[v] = whole.voxels[v - 1];
    }
  }
  const LabelImage labels = lobeLabels(whole, lobes);
  for (std::size_t v = 0; v < labels.voxels.size(); ++v) {
    ASSERT_EQ(whole.voxels[v] == 0, labels.voxels[v] == 0);
    ASSERT_LE(labels.voxels[v], 5);
  }
  pneuma::writeLobes(folder_, lobes, labels, {}, lobesReport(model, lobes, {}));
  EXPECT_EQ(failing(), "");
}

TEST_F(LobeFilesTest, DoNotMoveFissuresThatFold) {
  LobeInputs inputs;
  inputs.given[Fissure::LeftOblique].patch = overhanging(Vec3(80.0, 0.0, 0.0));
  inputs.shares[Side::Left] = {0.5, 0.5};
  EXPECT_THROW(splitLobes(lungs(), inputs), InvalidInput);
}

TEST_F(LobeFilesTest, PassEveryCheck) {
  makeLobes();
  EXPECT_EQ(failing(), "");
  std::vector<std::string> ids;
  for (const LobeCheck& check : checkLobes(folder_).checks) ids.push_back(check.id);
  for (const char* id : {"CLOSED-RML", "CUTS-LLL", "LUNG-R", "OVERLAP-L", "PARTITION-R",
                         "SHARED-right-oblique", "VOLUME-RUL", "LABELS"}) {
    EXPECT_EQ(std::ranges::count(ids, id), 1) << id;
  }
}

TEST_F(LobeFilesTest, FailWhereTheyAreHarmed) {
  makeLobes();
  // A point of the pleura is moved inwards: the volume is another, all else holds.
  changeLobe(Lobe::LeftLower, [](TriangleMesh& mesh) {
    const auto lowest =
        std::ranges::min_element(mesh.points, {}, [](const Vec3& p) { return p.z(); });
    lowest->z() += 0.5;
  });
  EXPECT_EQ(failing(), "VOLUME-LLL");
  makeLobes();
  changeLobe(Lobe::RightMiddle, [](TriangleMesh& mesh) { mesh.triangles.pop_back(); });
  EXPECT_NE(failing().find("CLOSED-RML"), std::string::npos);
  makeLobes();
  changeLobe(Lobe::RightUpper, [](TriangleMesh& mesh) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  });
  EXPECT_NE(failing().find("CLOSED-RUL"), std::string::npos);
  makeLobes();
  // Moved as a whole by a thousandth of a millimetre: closed, but the neighbours' triangles differ.
  changeLobe(Lobe::RightUpper, [](TriangleMesh& mesh) {
    for (Vec3& p : mesh.points) p.x() += 1e-3;
  });
  EXPECT_NE(failing().find("SHARED-right-horizontal"), std::string::npos);
  makeLobes();
  std::filesystem::copy_file(folder_ / lobeFile(Lobe::LeftUpper),
                             folder_ / lobeFile(Lobe::LeftLower),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_NE(failing().find("OVERLAP-L"), std::string::npos);
  makeLobes();
  LabelImage labels = readLabelVolume(folder_ / LobeLabelsFile);
  for (std::size_t v = 0, left = 500; v < labels.voxels.size() && left > 0; ++v) {
    if (labels.voxels[v] != 1) continue;
    labels.voxels[v] = 2;
    --left;
  }
  writeVolume(folder_ / LobeLabelsFile, labels);
  EXPECT_EQ(failing(), "LABELS");
}

TEST_F(LobeFilesTest, LabelsAgreeWithTheSurfaces) {
  const LobesOfLungs lobes = makeLobes();
  const LabelImage lungs = lungLabels(this->lungs(), 1.0);
  const LabelImage labels = lobeLabels(lungs, lobes);
  std::size_t all = 0;
  std::size_t other = 0;
  for (const SplitLung& lung : lobes.lungs) {
    for (const Lobe lobe : lobesOf(lung.side)) {
      const std::vector<std::uint8_t> inside =
          voxelsInside(surfaceOf(lung.complex, static_cast<RegionId>(lobe)).mesh, labels.geometry);
      for (std::size_t v = 0; v < inside.size(); ++v) {
        const bool isLabel = labels.voxels[v] == static_cast<std::uint8_t>(lobe);
        all += inside[v];
        if (isLabel == (inside[v] != 0)) continue;
        ++other;
        // Within half a voxel of a fissure.
        const auto slice = labels.geometry.sliceCount();
        const auto row = static_cast<std::size_t>(labels.geometry.size[0]);
        const Vec3 p = labels.geometry.worldFromVoxel(Vec3(static_cast<double>(v % row),
                                                           static_cast<double>(v % slice / row),
                                                           static_cast<double>(v / slice)));
        double nearest = 1e9;
        for (const Fissure fissure : fissuresOf(lung.side)) {
          nearest = std::min(nearest, std::abs(lobes.fissures.at(fissure).surface.distance(p)));
        }
        ASSERT_LT(nearest, 0.5);
      }
    }
  }
  EXPECT_GT(all, 3500000U);
  EXPECT_LE(static_cast<double>(other), 1e-4 * static_cast<double>(all));
}

TEST_F(LobeFilesTest, LobesThatShareTrianglesAreWelded) {
  const LobesOfLungs lobes = makeLobes();
  const LungModel model = openLungs({&folder_, 1});
  EXPECT_TRUE(model.warnings.empty());
  ASSERT_EQ(model.surfaces->size(), 2U);
  for (const LobeSurface& lung : *model.surfaces) {
    EXPECT_TRUE(lung.health.healthy()) << lung.name;
    EXPECT_NEAR(signedVolumeMm3(*lung.mesh) / lobes.lungMm3.at(side(lung.lobe)), 1.0, 1e-12);
  }
}

TEST_F(LobeFilesTest, LobesWithGapsAreDrawnAnew) {
  const LobesOfLungs lobes = makeLobes();
  double sum = 0.0;
  for (const Lobe lobe : lobesOf(Side::Left)) {
    changeLobe(lobe, [](TriangleMesh& mesh) {
      const Vec3 centre = bounds(mesh).center();
      for (Vec3& p : mesh.points) p = centre + 0.98 * (p - centre);
    });
    sum += 0.98 * 0.98 * 0.98 * lobes.lobeMm3.at(lobe);
  }
  const LungModel model = openLungs({&folder_, 1});
  ASSERT_EQ(model.warnings.size(), 1U);
  EXPECT_NE(model.warnings[0].find("left lung share no triangles"), std::string::npos);
  const LobeSurface& left = model.surfaces->back();
  EXPECT_TRUE(left.health.healthy());
  EXPECT_EQ(left.health.components, 1U);
  EXPECT_NEAR(signedVolumeMm3(*left.mesh) / sum, 1.0, 1e-9);
}

TEST_F(LobeFilesTest, RefusesLungsThatCannotBeJoined) {
  makeLobes();
  std::filesystem::remove(folder_ / "rml.vtp");
  EXPECT_NE(refusal({folder_}).find("RML is missing"), std::string::npos);
  std::filesystem::rename(folder_ / "lungs/right.vtp", folder_ / "lungs/other");
  std::filesystem::rename(folder_ / "lungs/left.vtp", folder_ / "lungs/right.vtp");
  std::filesystem::rename(folder_ / "lungs/other", folder_ / "lungs/left.vtp");
  EXPECT_NE(refusal({folder_ / "lungs"}).find("wrong way round"), std::string::npos);
}

TEST_F(LobeFilesTest, LabelsOfOtherNumbersAreLungs) {
  LabelImage image = lungLabels(lungs(), 3.0);
  const auto write = [&](std::uint8_t right, std::uint8_t left, const char* name) {
    LabelImage other = image;
    for (std::uint8_t& label : other.voxels) {
      label = label == RightLabel ? right : label == LeftLabel ? left : std::uint8_t{0};
    }
    writeVolume(folder_ / name, other);
    return folder_ / name;
  };
  const auto cip = write(2, 3, "cip.nii.gz");
  EXPECT_NE(refusal({cip}).find("--right-label"), std::string::npos);
  LungLabelOptions options;
  options.right = 2;
  options.left = 3;
  const LungModel model = openLungs({&cip, 1}, options);
  ASSERT_EQ(model.surfaces->size(), 2U);
  EXPECT_LT(bounds(*model.surfaces->front().mesh).center().x(), 0.0);
  options.left = 4;
  EXPECT_NE(refusal({cip}, options).find("label 4"), std::string::npos);
  const auto ours = write(RightLabel, LeftLabel, "ours.nii.gz");
  EXPECT_EQ(openLungs({&ours, 1}).surfaces->size(), 2U);
  const auto swapped = write(LeftLabel, RightLabel, "swapped.nii.gz");
  EXPECT_NE(refusal({swapped}).find("wrong way round"), std::string::npos);
}

}  // namespace
}  // namespace pneuma
