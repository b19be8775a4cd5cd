#include "io/animated_gltf.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <vtkCompositeDataIterator.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include "core/error.h"
#include "core/math.h"
#include "support/progress_recorder.h"
#include "temp_folder.h"

namespace pneuma {
namespace {

using testing::TempFolder;

/// A triangle of three points that all move by (1, 2, 3) mm in their own way.
MorphingMesh triangle(const std::string& name, std::size_t motion) {
  MorphingMesh mesh;
  mesh.name = name;
  mesh.points = {10.0F, 20.0F, 30.0F, 40.0F, 20.0F, 30.0F, 10.0F, 60.0F, 30.0F};
  mesh.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  mesh.triangles = {{0, 1, 2}};
  mesh.displacement = {1, 0, 0, 0, 2, 0, 0, 0, 3};
  mesh.normalSlope = {0, 0, 0, 0, 0, 0, 0, 0, 0};
  mesh.motion = motion;
  return mesh;
}

/// The points of all meshes at a time, as another library animates them.
std::vector<Vec3> pointsAt(const std::filesystem::path& path, double seconds) {
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(path.c_str());
  reader->ApplyDeformationsToGeometryOn();
  reader->SetFrameRate(10);
  reader->UpdateInformation();
  for (vtkIdType n = 0; n < reader->GetNumberOfAnimations(); ++n) reader->EnableAnimation(n);
  reader->UpdateTimeStep(seconds);
  std::vector<Vec3> points;
  const auto iterator =
      vtkSmartPointer<vtkCompositeDataIterator>::Take(reader->GetOutput()->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem()) {
    auto* data = vtkPolyData::SafeDownCast(iterator->GetCurrentDataObject());
    if (data == nullptr) continue;
    for (vtkIdType n = 0; n < data->GetNumberOfPoints(); ++n) {
      Vec3 p;
      data->GetPoint(n, p.data());
      points.push_back(p);
    }
  }
  return points;
}

/// (x, y, z) of LPS in mm as glTF has it.
Vec3 turned(const Vec3& p) { return Vec3(p.x(), p.z(), -p.y()) / 1000.0; }

TEST(AnimatedGltf, IsMovedByAnotherLibraryAsWeMoveIt) {
  const TempFolder folder;
  const auto path = folder / "breath.glb";
  writeAnimatedGltf(path, {triangle("Right", 0), triangle("Left", 1)}, {0.0, 1.0, 2.0},
                    {{0.0, 1.0, 0.0}, {0.0, 0.5, 2.0}});
  for (const auto& [seconds, right, left] :
       {std::array{0.0, 0.0, 0.0}, {0.5, 0.5, 0.25}, {1.0, 1.0, 0.5}, {1.5, 0.5, 1.25}}) {
    const std::vector<Vec3> points = pointsAt(path, seconds);
    ASSERT_EQ(points.size(), 6U);
    for (std::size_t n = 0; n < 6; ++n) {
      const double s = n < 3 ? right : left;
      const MorphingMesh mesh = triangle("", 0);
      const std::size_t at = 3 * (n % 3);
      const Vec3 rest(mesh.points[at], mesh.points[at + 1], mesh.points[at + 2]);
      const Vec3 u(mesh.displacement[at], mesh.displacement[at + 1], mesh.displacement[at + 2]);
      EXPECT_LT((points[n] - turned(rest + s * u)).norm(), 1e-7)
          << "point " << n << " at " << seconds << " s";
    }
  }
}

TEST(AnimatedGltf, RefusesNothing) {
  const TempFolder folder;
  EXPECT_THROW(writeAnimatedGltf(folder / "none.glb", {}, {0.0}, {}), InvalidInput);
  EXPECT_THROW(writeAnimatedGltf(folder / "none.glb", {triangle("A", 0)}, {}, {{}}), InvalidInput);
  EXPECT_EQ(folder.fileCount(), 0U);
}

TEST(AnimatedGltf, LeavesNothingIfItIsCancelled) {
  const TempFolder folder;
  testing::ProgressRecorder stopped(0.0);
  EXPECT_THROW(writeAnimatedGltf(folder / "breath.glb", {triangle("a", 0)}, {0.0, 1.0},
                                 {{0.0, 1.0}}, Existing::Replace, Progress(stopped)),
               Cancelled);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace pneuma
