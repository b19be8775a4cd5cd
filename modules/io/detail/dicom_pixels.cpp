#include "io/detail/dicom_pixels.h"

#include <algorithm>
#include <cmath>

#include <vtkDICOMReader.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include "io/detail/quiet_stderr.h"
#include "io/detail/vtk_errors.h"

namespace pneuma {
namespace {

constexpr double LowestMeasuredHu = -1024.0;  // scanners cut off below
constexpr int LowestPossibleHu = -4096;       // a scale of 12 bits below water
constexpr double HighestPaddingHu = -900.0;   // a padding above air is a mistake of the header

double huOf(const DicomSlice& slice, double stored) {
  return stored * slice.slope + slice.intercept;
}

std::int16_t clamped(double hu) {
  return static_cast<std::int16_t>(std::clamp(std::round(hu), -32768.0, 32767.0));
}

template <class T>
void rescale(const DicomSlice& slice, std::span<const T> stored, std::int16_t* hu) {
  const bool whole = slice.slope == std::round(slice.slope) && std::abs(slice.slope) < 1000.0 &&
                     slice.intercept == std::round(slice.intercept) &&
                     std::abs(slice.intercept) < 1e6;
  if (whole) {  // nearly always; vectorised
    const int slope = static_cast<int>(slice.slope);
    const int intercept = static_cast<int>(slice.intercept);
    for (std::size_t i = 0; i < stored.size(); ++i) {
      hu[i] = static_cast<std::int16_t>(std::clamp(stored[i] * slope + intercept, -32768, 32767));
    }
    return;
  }
  for (std::size_t i = 0; i < stored.size(); ++i) hu[i] = clamped(huOf(slice, stored[i]));
}

template <class T>
void markDeclaredPadding(const DicomSlice& slice, std::span<const T> stored, std::size_t columns,
                         std::int16_t* hu) {
  if (!slice.padding) return;
  const int other = slice.paddingLimit.value_or(*slice.padding);
  const int low = std::min(*slice.padding, other);
  const int high = std::max(*slice.padding, other);
  const double top = std::max(huOf(slice, low), huOf(slice, high));
  const auto isPadding = [&](T value) { return value >= low && value <= high; };
  if (top < LowestMeasuredHu) {
    for (std::size_t i = 0; i < stored.size(); ++i) {
      if (isPadding(stored[i])) hu[i] = PaddingHu;
    }
  } else if (top <= HighestPaddingHu) {
    for (std::size_t row = 0; row < stored.size(); row += columns) {
      std::size_t i = row;
      for (; i < row + columns && isPadding(stored[i]); ++i) hu[i] = PaddingHu;
      for (std::size_t j = row + columns; j > i && isPadding(stored[j - 1]); --j) {
        hu[j - 1] = PaddingHu;
      }
    }
  }
}

/// What is wrong with a decompressed slice, or "". The decoders cut values to the bits stated, so
/// that damage shows only where no scanner goes.
std::string rangeFault(std::span<const std::int16_t> hu) {
  const int lowest = *std::ranges::min_element(hu);
  if (lowest >= LowestPossibleHu) return "";
  return "is damaged inside its compressed picture: it holds " + std::to_string(lowest) +
         " HU, which no scanner gives";
}

template <class T>
std::string takeSlices(const DicomSeries& series, std::span<const SliceTarget> targets,
                       const T* pixels, int frames) {
  const auto columns = static_cast<std::size_t>(series.columns);
  const std::size_t size = columns * static_cast<std::size_t>(series.rows);
  for (const SliceTarget& target : targets) {
    const DicomSlice& slice = *target.slice;
    if (slice.frame >= frames) return "holds fewer pictures than it states";
    const std::span<const T> stored(pixels + size * static_cast<std::size_t>(slice.frame), size);
    rescale(slice, stored, target.hu);
    markDeclaredPadding(slice, stored, columns, target.hu);
    markCornerPadding({target.hu, size}, columns);
    if (series.compression.empty()) continue;
    std::string fault = rangeFault({target.hu, size});
    if (!fault.empty()) return fault;
  }
  return "";
}

}  // namespace

void markCornerPadding(std::span<std::int16_t> slice, std::size_t columns) {
  for (const std::size_t corner :
       {std::size_t{0}, columns - 1, slice.size() - columns, slice.size() - 1}) {
    const std::int16_t value = slice[corner];
    if (value < LowestMeasuredHu && value != PaddingHu) {
      std::ranges::replace(slice, value, PaddingHu);
    }
  }
}

std::string readSlices(const DicomSeries& series, std::span<const SliceTarget> targets) {
  const QuietStderr quiet;
  const vtkNew<vtkDICOMReader> reader;
  const VtkErrors errors(static_cast<vtkAlgorithm&>(*reader));
  reader->SetFileName(targets.front().slice->file.c_str());
  reader->SortingOff();
  reader->AutoRescaleOff();  // done here: whole files stay 16 bits, and the range can be checked
  reader->SetMemoryRowOrderToFileNative();
  reader->UpdateInformation();
  // After an error here nothing else of the reader may be touched.
  if (reader->GetErrorCode() == 0) reader->vtkAlgorithm::Update(0);  // pictures without overlays
  const std::string again = "; copy it again from its source";
  if (reader->GetErrorCode() != 0 || !errors.first().empty()) {
    return "cannot be decoded" + (errors.first().empty() ? "" : " (" + errors.first() + ")") +
           again;
  }
  if (quiet.text().find("Corrupt JPEG data") != std::string::npos ||
      quiet.text().find("Premature end of JPEG") != std::string::npos) {
    return "is damaged inside its compressed picture" + again;
  }
  vtkImageData& picture = *reader->GetOutput();
  const int* size = picture.GetDimensions();
  if (size[0] != series.columns || size[1] != series.rows ||
      picture.GetNumberOfScalarComponents() != 1) {
    return "holds another picture than its header states" + again;
  }
  const void* pixels = picture.GetScalarPointer();
  std::string fault;
  switch (picture.GetScalarType()) {
    case VTK_SHORT:
      fault = takeSlices(series, targets, static_cast<const std::int16_t*>(pixels), size[2]);
      break;
    case VTK_UNSIGNED_SHORT:
      fault = takeSlices(series, targets, static_cast<const std::uint16_t*>(pixels), size[2]);
      break;
    case VTK_SIGNED_CHAR:
      fault = takeSlices(series, targets, static_cast<const std::int8_t*>(pixels), size[2]);
      break;
    case VTK_UNSIGNED_CHAR:
      fault = takeSlices(series, targets, static_cast<const std::uint8_t*>(pixels), size[2]);
      break;
    default:
      fault = "holds numbers of a kind that no CT has";
  }
  return fault.empty() ? fault : fault + again;
}

}  // namespace pneuma
