#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/dicom_series.h"

namespace pneuma {

/// A slice of a file and where its voxels go: `size` values of HU.
struct SliceTarget {
  const DicomSlice* slice = nullptr;
  std::int16_t* hu = nullptr;
};

/// Reads slices of one file (`targets`, all of the same file) of `series`. What was not measured
/// becomes PaddingHu: stored values declared as padding, and values below -1024 HU that fill the
/// corners of a slice. A declared padding at -1024 HU or above is air that a scanner cut off as
/// well; it counts only from the edge of the slice inwards.
/// @returns why it failed, as the end of "FILE ...", or ""
std::string readSlices(const DicomSeries& series, std::span<const SliceTarget> targets);

/// Makes PaddingHu of a value below -1024 HU that stands in a corner of a slice, wherever it
/// stands.
void markCornerPadding(std::span<std::int16_t> slice, std::size_t columns);

}  // namespace pneuma
