#include <algorithm>
#include <map>

#include <benchmark/benchmark.h>
#include <vtkImageData.h>
#include <vtkImageEuclideanDistance.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include "pipeline/sample_ct.h"
#include "segmentation/closing.h"
#include "segmentation/distance_map.h"
#include "segmentation/fissure_sheetness.h"
#include "segmentation/lung_segmentation.h"

// Finding lungs: whether its time grows with the voxels of the lungs' box, and what its slowest
// step, distances in mm, costs beside the general filter of VTK; and looking for fissures.
namespace pneuma {
namespace {

/// The sample chest with voxels of tenths of a millimetre.
const SampleCt& sampleOf(std::int64_t tenths) {
  static const SampleChest chest = sampleChest();
  static std::map<std::int64_t, SampleCt> made;
  const auto known = made.find(tenths);
  if (known != made.end()) return known->second;
  SampleCtOptions options;
  options.spacingMm = 0.1 * static_cast<double>(tenths);
  options.thickMm = options.spacingMm;
  return made.emplace(tenths, sampleCt(chest, options)).first->second;
}

VoxelBox boxOfLungs(const LabelImage& truth) {
  LabelImage both = truth;
  for (std::uint8_t& label : both.voxels) label = label == 10 || label == 20 ? 1 : 0;
  return within(boxOf(both, 1, 0.0), both.geometry);
}

void findLungs(benchmark::State& state) {
  const SampleCt& sample = sampleOf(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(segmentLungs(sample.image).labels.voxels.data());
  const double voxels = static_cast<double>(boxOfLungs(sample.truth).voxelCount());
  state.counters["box_Mvoxels"] = voxels * 1e-6;
  state.counters["s_per_Gvoxel"] = benchmark::Counter(
      voxels * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(findLungs)
    ->Arg(24)
    ->Arg(17)
    ->Arg(12)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

/// What fissures are looked for in, of both lungs; 24 Mvoxels of a real CT took 1.7 s where it was
/// tried first.
void sheetness(benchmark::State& state) {
  const SampleCt& sample = sampleOf(10);
  double voxels = 0.0;
  for (auto _ : state) {
    voxels = 0.0;
    for (const std::uint8_t lung : {10, 20}) {
      voxels += static_cast<double>(
          fissureSheetness(sample.image, sample.truth, lung).geometry.voxelCount());
    }
  }
  state.counters["box_Mvoxels"] = voxels * 1e-6;
  state.counters["s_per_Gvoxel"] = benchmark::Counter(
      voxels * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(sheetness)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

std::vector<std::uint8_t> rightLung(const SampleCt& sample, VoxelBox& box) {
  box = within(boxOf(sample.truth, 10, 10.0), sample.truth.geometry);
  return maskOf(sample.truth, 10, box);
}

void distanceMap(benchmark::State& state) {
  const SampleCt& sample = sampleOf(17);
  VoxelBox box;
  const std::vector<std::uint8_t> mask = rightLung(sample, box);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        squaredDistances(mask, box.size, sample.truth.geometry.spacing, 1000.0).data());
  }
}

BENCHMARK(distanceMap)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

void distanceMapOfVtk(benchmark::State& state) {
  const SampleCt& sample = sampleOf(17);
  VoxelBox box;
  std::vector<std::uint8_t> mask = rightLung(sample, box);
  // VTK measures to what is zero.
  for (std::uint8_t& voxel : mask) voxel = voxel == 0 ? 1 : 0;
  const vtkNew<vtkImageData> image;
  image->SetDimensions(box.size.data());
  image->SetSpacing(sample.truth.geometry.spacing.data());
  const vtkNew<vtkUnsignedCharArray> values;
  values->SetArray(mask.data(), static_cast<vtkIdType>(mask.size()), 1);
  image->GetPointData()->SetScalars(values);
  for (auto _ : state) {
    const vtkNew<vtkImageEuclideanDistance> filter;
    filter->SetInputData(image);
    filter->SetConsiderAnisotropy(1);
    filter->Update();
    benchmark::DoNotOptimize(filter->GetOutput());
  }
}

BENCHMARK(distanceMapOfVtk)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
}  // namespace pneuma
