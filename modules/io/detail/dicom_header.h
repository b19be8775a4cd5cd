#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/dicom_series.h"

namespace pneuma {

/// What the header of one DICOM file says, as far as a CT is concerned.
struct DicomHeader {
  DicomSeries series;  ///< modality, description ...; slices: the frames of this file
  std::string instanceUid;
  std::string photometric;
  int samplesPerPixel = 1;
  bool hasPixels = false;
  Vec3 row = Vec3::Zero();          ///< direction along a row, unit length
  Vec3 column = Vec3::Zero();       ///< direction along a column
  std::array<double, 2> pixelMm{};  ///< along a row, along a column
  std::string fault;  ///< why it cannot be read, as the end of "FILE ..."; "" if it can be
  ExitCode faultCode = ExitCode::InputInvalid;
  bool localizer = false;

  const std::string& name() const { return series.slices.front().name; }

  Vec3 normal() const { return row.cross(column); }
};

/// Nothing if the file is not DICOM. @throws InputMissing if it cannot be opened
/// @param name for messages
std::optional<DicomHeader> readDicomHeader(const std::filesystem::path& file,
                                           const std::string& name);

/// How the slices stand to each other. `slices` must be ascending along `normal`.
SeriesCheck checkedStack(const std::vector<DicomSlice>& slices, const Vec3& normal);

/// Sets rating, reasons and notes of a series whose other members are set.
void rate(DicomSeries& series, const DicomHeader& first);

/// True if `a` is the better choice.
bool betterSeries(const DicomSeries& a, const DicomSeries& b);

}  // namespace pneuma
