#include <algorithm>
#include <cmath>
#include <map>

#include <benchmark/benchmark.h>

#include "core/random.h"
#include "geometry/mesh_doctor.h"
#include "geometry/self_intersections.h"
#include "geometry/test_surfaces.h"
#include "lobes/fissure_fit.h"
#include "lobes/fissure_proposal.h"
#include "lobes/lobe_splitting.h"
#include "pipeline/lobe_labels.h"
#include "pipeline/lobe_preview.h"

// Splitting lungs into lobes, beside the full check of the lung for self-intersections.
namespace pneuma {
namespace {

constexpr double SpacingMm = 2.5;

/// An egg of a lung's size; triangles by the power of 4.
const TriangleMesh& lungOf(int subdivisions) {
  static std::map<int, TriangleMesh> made;
  const auto known = made.find(subdivisions);
  if (known != made.end()) return known->second;
  TriangleMesh mesh = testing::sphere(1.0, Vec3::Zero(), subdivisions);
  for (Vec3& p : mesh.points) {
    p = p.cwiseProduct(Vec3(55.0, 80.0, 115.0)) * (1.0 - 0.15 * p.z());
  }
  return made.emplace(subdivisions, std::move(mesh)).first->second;
}

/// Through 12 points that lie about 5 mm from the proposals.
FissureSurfaces fissures(const TriangleMesh& lung, Side side) {
  Random random(1);
  FissureSurfaces surfaces;
  const LungBox box = lungBox(lung);
  for (const Fissure fissure : fissuresOf(side)) {
    const HeightSurface proposed = proposedFissure(fissure, box);
    std::vector<Vec3> points;
    for (int i = 0; i < 12; ++i) {
      const double u = random.uniform(0.1, 0.9) * (box.high.x() - box.low.x());
      const double v = random.uniform(0.1, 0.9) * (box.high.y() - box.low.y());
      points.push_back(proposed.at({u, v}) + Vec3(0.0, 0.0, random.uniform(-8.0, 8.0)));
    }
    surfaces[fissure] = fitFissure(points);
  }
  return surfaces;
}

void fiveLobes(benchmark::State& state) {
  const TriangleMesh& lung = lungOf(static_cast<int>(state.range(0)));
  const FissureSurfaces right = fissures(lung, Side::Right);
  const FissureSurfaces left = fissures(lung, Side::Left);
  for (auto _ : state) {
    benchmark::DoNotOptimize(splitLung(lung, Side::Right, right, SpacingMm));
    benchmark::DoNotOptimize(splitLung(lung, Side::Left, left, SpacingMm));
  }
  state.counters["triangles"] = 2.0 * static_cast<double>(lung.triangles.size());
}

BENCHMARK(fiveLobes)->DenseRange(5, 8)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void fullCheckOfBothLungs(benchmark::State& state) {
  const TriangleMesh& lung = lungOf(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    for (int n = 0; n < 2; ++n) benchmark::DoNotOptimize(selfIntersecting(lung).pairs);
  }
}

BENCHMARK(fullCheckOfBothLungs)
    ->DenseRange(5, 8)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

/// Labels of 512 x 512 x 400 voxels: both lungs, 12 % of them.
void labelsOfFiveLobes(benchmark::State& state) {
  LabelImage labels;
  labels.geometry.size = {512, 512, 400};
  labels.geometry.spacing = {0.68, 0.68, 0.75};
  labels.geometry.origin = {-174.0, -174.0, -150.0};
  labels.voxels.assign(labels.geometry.voxelCount(), 0);
  auto surfaces = std::make_shared<std::vector<LobeSurface>>();
  for (const Lobe lobe : {Lobe::RightLung, Lobe::LeftLung}) {
    const double sign = lobe == Lobe::RightLung ? -1.0 : 1.0;
    auto mesh = std::make_shared<TriangleMesh>(lungOf(6));
    for (Vec3& p : mesh->points) p.x() += sign * 75.0;
    const Box3 box = bounds(*mesh);
    const auto value = static_cast<std::uint8_t>(sign < 0.0 ? 10 : 20);
    for (int k = 0; k < 400; ++k) {
      for (int j = 0; j < 512; ++j) {
        for (int i = 0; i < 512; ++i) {
          const Vec3 p =
              labels.geometry.origin + labels.geometry.spacing.cwiseProduct(Vec3(i, j, k));
          if (!box.contains(p)) continue;
          const double z = p.z() / (115.0 * (1.0 - 0.15 * std::clamp(p.z() / 115.0, -1.0, 1.0)));
          const double scale = 1.0 - 0.15 * std::clamp(z, -1.0, 1.0);
          const Vec3 q = Vec3(p.x() - sign * 75.0, p.y(), p.z())
                             .cwiseQuotient(scale * Vec3(55.0, 80.0, 115.0));
          if (q.norm() < 0.98) labels.voxels[labels.geometry.index(i, j, k)] = value;
        }
      }
    }
    surfaces->push_back({lobe, "lung", mesh, examine(*mesh)});
  }
  LungModel model;
  model.surfaces = std::move(surfaces);
  const LobesOfLungs lobes = splitLobes(model, {});
  for (auto _ : state) benchmark::DoNotOptimize(lobeLabels(labels, lobes));
}

BENCHMARK(labelsOfFiveLobes)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

/// What a moved point of the right oblique fissure costs: the fit, every point's lobe, contours and
/// volumes; what is drawn of the fissure as well.
void previewOfAMovedPoint(benchmark::State& state) {
  const auto lung = std::make_shared<const LungShape>(
      lungShape(std::make_shared<const TriangleMesh>(lungOf(7)), Side::Right));
  LobePreview preview(lung, fissures(*lung->mesh, Side::Right));
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i) {
    points.push_back(preview.surface(Fissure::RightOblique).at({20.0 * (i % 4), 20.0 * (i / 4)}));
  }
  for (auto _ : state) {
    points[5].z() += 0.1;
    preview.set(Fissure::RightOblique, fitFissure(points));
    benchmark::DoNotOptimize(preview.lobes());
    for (const Fissure fissure : fissuresOf(Side::Right)) {
      benchmark::DoNotOptimize(preview.contour(fissure));
      if (state.range(0) != 0) benchmark::DoNotOptimize(preview.patch(fissure, 4.0));
    }
    benchmark::DoNotOptimize(preview.volumesMm3());
  }
  state.counters["triangles"] = static_cast<double>(lung->mesh->triangles.size());
}

BENCHMARK(previewOfAMovedPoint)
    ->ArgName("patches")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace pneuma
