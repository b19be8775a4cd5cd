#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "core/progress.h"
#include "io/ct_corrections.h"

namespace pneuma {

/// One slice of a series, as its header describes it.
struct DicomSlice {
  std::filesystem::path file;
  std::string name;              ///< of the file, or of its entry in an archive, for messages
  int frame = 0;                 ///< in a file of several
  Vec3 position = Vec3::Zero();  ///< centre of its first pixel, LPS, mm
  double slope = 1.0;            ///< HU = slope * stored value + intercept
  double intercept = 0.0;
  int bitsStored = 16;
  bool isSigned = true;
  std::optional<int> padding;       ///< stored value that means "nothing measured here"
  std::optional<int> paddingLimit;  ///< other end of the range of such values
};

/// A step between neighbouring slices that is too long: slices are missing.
struct SliceGap {
  std::size_t below = 0;    ///< index of the slice before the gap
  std::size_t above = 0;    ///< and of the one beyond it
  int missing = 0;          ///< slices that would fill it
  std::vector<Vec3> where;  ///< first pixel's centre of each missing slice
};

/// How the slices of a series stand to each other: from their positions, never from
/// SliceThickness. Slices that stand where the one before does count for nothing else.
struct SeriesCheck {
  double spacingMm = 0.0;      ///< along the normal; median of the steps
  double tiltDeg = 0.0;        ///< between the stack's axis and the slices' normal
  double unevenMm = 0.0;       ///< largest difference of a step, gaps aside, from the median
  double sidewaysMm = 0.0;     ///< largest distance of a slice from the stack's axis
  std::vector<SliceGap> gaps;  ///< steps of 1.5 spacings or more
  std::vector<std::size_t> duplicates;  ///< slices that stand where the one before does

  bool tilted() const { return tiltDeg > LeastTiltDeg; }

  bool uneven() const { return unevenMm > 0.05 || unevenMm > 0.01 * spacingMm; }

  /// Slices missing in all gaps.
  int missing() const;
};

/// Why a series cannot be read, in one sentence.
struct Refusal {
  ExitCode code = ExitCode::InputInvalid;
  std::string sentence;
};

/// Attributes that name the patient, the people or the place, by keyword ("PatientName"). Nobody
/// prints them unless asked to.
using Identifiers = std::map<std::string, std::string>;

/// A series of CT slices (or of something else, with the reason why it cannot be read).
struct DicomSeries {
  std::string modality;
  std::string description;
  std::string kernel;
  std::string bodyPart;
  std::string imageType;    ///< "ORIGINAL\PRIMARY\AXIAL"
  std::string compression;  ///< "" or the name of the compressed transfer syntax
  int number = 0;
  int rows = 0;
  int columns = 0;
  double thicknessMm = 0.0;  ///< as stated; 0 if not

  std::vector<DicomSlice> slices;  ///< ascending along the normal
  ImageGeometry geometry;          ///< once gaps are filled and duplicates dropped
  SeriesCheck check;
  std::optional<Refusal> refusal;    ///< why it cannot be read whatever is corrected
  bool ofAnotherPart = false;        ///< a part of the body is stated that is not the chest
  int place = 0;                     ///< in the list, best first, from 1
  int rating = 0;                    ///< 0 (cannot be read, or not the chest) to 5
  std::vector<std::string> reasons;  ///< of the rating
  std::vector<std::string> notes;
  std::uint64_t memoryBytes = 0;  ///< of the image

  std::string uid;
  Identifiers identifiers;
  std::shared_ptr<const void> extracted;  ///< keeps what was taken out of an archive
};

/// Series below a path, best first (axial CT of the chest, then more slices, thinner, softer; last
/// those that cannot be read).
/// A folder is searched with its subfolders, but no deeper; of a file all files of its series in
/// the same folder are taken; a zip archive is unpacked into a private folder that lives as long as
/// one of its series. Only headers are read. Other files do not matter.
/// @throws InputMissing if there is nothing or it cannot be read, InvalidInput for a damaged or
/// dangerous archive, Cancelled
std::vector<DicomSeries> listDicomSeries(const std::filesystem::path& path,
                                         const Progress& progress = {});

/// True if the file starts as DICOM files do.
bool isDicomFile(const std::filesystem::path& file);

/// True for a DICOM file, a folder with one in it, and a zip archive.
bool isDicomPath(const std::filesystem::path& path);

/// The volume of a series in HU. Padding is PaddingHu. Slices in the same place are dropped if they
/// hold the same.
/// @throws the refusal of the series; InvalidInput for gaps unless corrected, for different slices
/// in one place, for a file that is cut off or damaged; Unsupported for a compression that cannot
/// be read; Error (OutOfMemory); Cancelled. Each names the file or the place
CtImage readDicomSeries(const DicomSeries& series, const CtCorrections& corrections = {},
                        const Progress& progress = {});

/// Throws what readDicomSeries would throw before it reads a pixel.
void requireReadable(const DicomSeries& series, const CtCorrections& corrections);

/// Why the series cannot be read, as requireReadable() says it; empty if it can be.
std::string obstacleOf(const DicomSeries& series, const CtCorrections& corrections = {});

/// One slice as an image by itself, for whoever wants to see what a series shows: also of one that
/// cannot be read as a volume, which then lies on axes and at pixels of 1 mm.
/// @param slice in the order of series.slices
/// @throws InvalidInput if its file is cut off, damaged, or another picture than the series' first
CtImage readDicomSlice(const DicomSeries& series, std::size_t slice);

/// `series 3 "Chest 5 mm"`
std::string titleOf(const DicomSeries& series);

/// Where a point lies along the axis of the body that `normal` runs along most: "S 112.5 mm".
std::string placeText(const Vec3& point, const Vec3& normal);

/// The gaps as a sentence: "2 slices are missing between S 112.5 and S 127.5 mm (at ...)".
std::string gapsText(const DicomSeries& series);

}  // namespace pneuma
