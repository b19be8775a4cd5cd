#include <cstdlib>
#include <filesystem>

#include <benchmark/benchmark.h>
#include <vtkDICOMDirectory.h>
#include <vtkDICOMReader.h>
#include <vtkNew.h>

#include "io/ct_file.h"

namespace pneuma {
namespace {

/// The real series, or nothing.
std::filesystem::path series() {
  const char* data = std::getenv("PNEUMA_TEST_DATA");
  return std::filesystem::path(data == nullptr ? "" : data) / "ct_lung_dx_a0001_dicom" / "series";
}

/// What reading costs with vtk-dicom alone: find the series, read it.
void vtkDicomAlone(benchmark::State& state) {
  if (!std::filesystem::exists(series())) return state.SkipWithError("PNEUMA_TEST_DATA is not set");
  for (auto _ : state) {
    const vtkNew<vtkDICOMDirectory> directory;
    directory->SetDirectoryName(series().c_str());
    directory->Update();
    const vtkNew<vtkDICOMReader> reader;
    reader->SetFileNames(directory->GetFileNamesForSeries(0));
    reader->SetMemoryRowOrderToFileNative();
    reader->Update();
    benchmark::DoNotOptimize(reader->GetOutput());
  }
}

BENCHMARK(vtkDicomAlone)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

/// The same with every check.
void readCtOfDicom(benchmark::State& state) {
  if (!std::filesystem::exists(series())) return state.SkipWithError("PNEUMA_TEST_DATA is not set");
  for (auto _ : state) benchmark::DoNotOptimize(readCt(series()).image.voxels.data());
}

BENCHMARK(readCtOfDicom)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
}  // namespace pneuma
