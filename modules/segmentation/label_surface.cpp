#include "segmentation/label_surface.h"

#include <algorithm>
#include <string>

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDiscreteFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include "core/error.h"
#include "geometry/mesh_topology.h"
#include "segmentation/closing.h"
#include "segmentation/lung_labels.h"

namespace pneuma {
namespace {

constexpr double HilumMm = 10.0;  ///< airways within this closing of a lung run inside it
constexpr int SmoothingIterations = 20;
constexpr double PassBand = 0.02;
/// Of a voxel's diagonal; restoring the volume moves points a little more, and half is the limit.
constexpr double FarthestShare = 0.45;
constexpr int VolumeRounds = 4;
constexpr int DecimationTries = 4;

/// The voxels of a surface, with an empty one around them.
struct Body {
  VoxelBox box;
  std::vector<std::uint8_t> mask;
  std::size_t voxels = 0;
};

Body bodyOf(const LabelImage& labels, std::uint8_t label, const Progress& progress) {
  Body body;
  body.box = boxOf(labels, label, HilumMm);
  if (body.box.voxelCount() == 0) {
    throw InvalidInput("no voxel has the label " + std::to_string(label) +
                       "; a surface needs some");
  }
  // A lung may end with the slices; its surface is closed all the same.
  body.box.low.z() -= 1;
  body.box.size[2] += 2;
  body.mask = maskOf(labels, label, body.box);
  std::vector<std::uint8_t> closed = body.mask;
  closeByBall(closed, body.box.size, labels.geometry.spacing, HilumMm, progress);
  forEachRow(body.box, labels.geometry, [&](std::size_t at, std::size_t v, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (closed[at + i] != 0 && labels.voxels[v + i] == AirwayLabel) body.mask[at + i] = 1;
    }
  });
  fillHoles(body.mask, body.box.size, progress);
  body.voxels = keepLargest(body.mask, body.box.size, progress);
  return body;
}

/// Lets a filter end early where the user wants to stop. @throws Cancelled
void update(vtkAlgorithm& filter, const Progress& progress) {
  vtkNew<vtkCallbackCommand> watch;
  watch->SetClientData(const_cast<Progress*>(&progress));
  watch->SetCallback([](vtkObject* caller, unsigned long, void* data, void*) {
    if (static_cast<const Progress*>(data)->stopRequested()) {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  });
  filter.AddObserver(vtkCommand::ProgressEvent, watch);
  filter.Update();
  progress.throwIfStopped();
}

/// Takes points back that smoothing moved farther than `mostMm`: thin sheets and tips.
void keepNear(vtkPolyData& before, vtkPolyData& after, double mostMm) {
  for (vtkIdType p = 0; p < after.GetNumberOfPoints(); ++p) {
    Vec3 from;
    Vec3 to;
    before.GetPoint(p, from.data());
    after.GetPoint(p, to.data());
    const double moved = (to - from).norm();
    if (moved <= mostMm) continue;
    const Vec3 nearer = from + mostMm / moved * (to - from);
    after.GetPoints()->SetPoint(p, nearer.data());
  }
}

/// The voxels' faces smoothed, in mm along the image's axes.
vtkSmartPointer<vtkPolyData> smoothFaces(Body& body, const Vec3& spacing,
                                         const Progress& progress) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(body.box.size[0], body.box.size[1], body.box.size[2]);
  image->SetSpacing(spacing.data());
  image->SetOrigin(body.box.low.x() * spacing.x(), body.box.low.y() * spacing.y(),
                   body.box.low.z() * spacing.z());
  vtkNew<vtkUnsignedCharArray> values;
  values->SetArray(body.mask.data(), static_cast<vtkIdType>(body.mask.size()), 1);
  image->GetPointData()->SetScalars(values);
  vtkNew<vtkDiscreteFlyingEdges3D> faces;
  faces->SetInputData(image);
  faces->SetValue(0, 1.0);
  faces->ComputeNormalsOff();
  faces->ComputeGradientsOff();
  faces->ComputeScalarsOff();
  update(*faces, progress);
  vtkNew<vtkWindowedSincPolyDataFilter> smoother;
  smoother->SetInputConnection(faces->GetOutputPort());
  smoother->SetNumberOfIterations(SmoothingIterations);
  smoother->SetPassBand(PassBand);
  smoother->NormalizeCoordinatesOn();
  smoother->BoundarySmoothingOff();
  smoother->FeatureEdgeSmoothingOff();
  update(*smoother, progress);
  const vtkSmartPointer<vtkPolyData> smooth = smoother->GetOutput();
  keepNear(*faces->GetOutput(), *smooth, FarthestShare * spacing.norm());
  return smooth;
}

TriangleMesh meshOf(vtkPolyData& surface) {
  TriangleMesh mesh;
  mesh.points.reserve(static_cast<std::size_t>(surface.GetNumberOfPoints()));
  for (vtkIdType p = 0; p < surface.GetNumberOfPoints(); ++p) {
    Vec3 point;
    surface.GetPoint(p, point.data());
    mesh.points.push_back(point);
  }
  vtkCellArray* polygons = surface.GetPolys();
  mesh.triangles.reserve(static_cast<std::size_t>(polygons->GetNumberOfCells()));
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  for (vtkIdType cell = 0; cell < polygons->GetNumberOfCells(); ++cell) {
    polygons->GetCellAtId(cell, count, ids);
    mesh.triangles.push_back({static_cast<std::uint32_t>(ids[0]),
                              static_cast<std::uint32_t>(ids[1]),
                              static_cast<std::uint32_t>(ids[2])});
  }
  return mesh;
}

/// Fewer triangles; the count wanted is varied a little where the result is not closed.
TriangleMesh decimated(vtkPolyData& surface, int triangles, const Progress& progress) {
  const auto all = static_cast<double>(surface.GetNumberOfCells());
  double wanted = triangles;
  for (int attempt = 0; attempt < DecimationTries; ++attempt, wanted *= 1.1) {
    if (wanted >= all) return meshOf(surface);
    vtkNew<vtkQuadricDecimation> decimation;
    decimation->SetInputData(&surface);
    decimation->SetTargetReduction(1.0 - wanted / all);
    update(*decimation, progress);
    TriangleMesh mesh = meshOf(*decimation->GetOutput());
    const MeshTopology health = topology(mesh);
    if (health.faults() == 0 && health.components == 1) {
      return mesh;
    }
  }
  throw Unsupported("no closed surface of " + std::to_string(triangles) +
                    " triangles was found; ask for more, or for all of them with triangles=0");
}

}  // namespace

TriangleMesh labelSurface(const LabelImage& labels, std::uint8_t label,
                          const SurfaceOptions& options, const Progress& progress) {
  requireValid(options);
  Body body = bodyOf(labels, label, progress);
  const ImageGeometry& geometry = labels.geometry;
  progress.report(0.4);
  const vtkSmartPointer<vtkPolyData> smooth = smoothFaces(body, geometry.spacing, progress);
  body.mask = {};
  progress.report(0.7);
  TriangleMesh mesh =
      options.triangles > 0 ? decimated(*smooth, options.triangles, progress) : meshOf(*smooth);
  for (Vec3& point : mesh.points) point = geometry.origin + geometry.direction * point;
  if (signedVolumeMm3(mesh) < 0.0) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  }
  restoreVolume(mesh, static_cast<double>(body.voxels) * geometry.voxelMm3());
  progress.report(1.0);
  return mesh;
}

double labelVolumeMm3(const LabelImage& labels, std::uint8_t label) {
  return static_cast<double>(bodyOf(labels, label, {}).voxels) * labels.geometry.voxelMm3();
}

void restoreVolume(TriangleMesh& mesh, double volumeMm3) {
  for (int round = 0; round < VolumeRounds; ++round) {
    const double step = (volumeMm3 - signedVolumeMm3(mesh)) / areaMm2(mesh);
    std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3 twiceArea =
          (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
      for (const std::uint32_t corner : {a, b, c}) normals[corner] += twiceArea;
    }
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
      const double length = normals[p].norm();
      if (length > 0.0) mesh.points[p] += step / length * normals[p];
    }
  }
}

}  // namespace pneuma
