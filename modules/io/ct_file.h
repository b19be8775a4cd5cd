#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/progress.h"
#include "io/ct_corrections.h"
#include "io/dicom_series.h"

namespace pneuma {

/// Whether the numbers of an image can be Hounsfield units of a chest.
struct HuCheck {
  double percentile1 = 0.0;  ///< below it lies 1 % of what was measured
  int lowest = 0;            ///< of what was measured
  int highest = 0;
  double paddingShare = 0.0;  ///< of all voxels

  /// A chest holds air: the lowest hundredth lies far below water.
  bool plausible() const { return percentile1 <= -500.0; }
};

/// @param image of at least one voxel
HuCheck huCheck(const CtImage& image);

/// A CT of any format, and what was found while reading it.
struct CtFile {
  CtImage image;
  std::string format;    ///< "DICOM", "NIfTI", "NRRD", "MetaImage"
  double tiltDeg = 0.0;  ///< before it was undone
  HuCheck hu;
  std::uint64_t memoryBytes = 0;
  std::optional<DicomSeries> series;  ///< where it came from DICOM, with its identifiers
  std::vector<DicomSeries> others;    ///< series that were there besides, best first
  std::vector<std::string> notes;     ///< said in passing
  std::vector<std::string> warnings;  ///< may make a result wrong
};

/// True if a CT may be there: a volume file, a DICOM file, a zip archive, a folder with DICOM.
bool isCtPath(const std::filesystem::path& path);

/// The name of a series in what is kept and passed on: "series-" and 16 digits of the SHA-256 of
/// its UID, which itself would lead to the person in a hospital's archive.
std::string seriesName(const std::string& uid);

/// What is kept and passed on of SeriesChoice::wanted: a UID becomes its seriesName().
std::string keptSeries(const std::string& wanted);

/// Which series of several; the best one unless said otherwise.
struct SeriesChoice {
  std::string wanted;  ///< place in the list from 1 ("2"), UID, or seriesName(); "": the best
  /// What listDicomSeries() found at the path already; null: it is looked for.
  std::shared_ptr<const std::vector<DicomSeries>> listed = nullptr;
};

/// The series of a list that is wanted.
/// @throws InvalidOption if there is no such one; the refusal of the best if none can be read;
/// Unsupported if none is of the chest, unless one is wanted
const DicomSeries& chosenSeries(const std::vector<DicomSeries>& all, const SeriesChoice& choice);

/// The files that readCt() would read: those of the chosen series, the archive that holds it, or a
/// volume and the file of its voxels.
/// @throws as readCt() before it reads a voxel
std::vector<std::filesystem::path> ctInputFiles(const std::filesystem::path& path,
                                                const SeriesChoice& choice = {},
                                                const Progress& progress = {});

/// What is known of a CT before its voxels are read.
struct CtHead {
  ImageGeometry geometry;  ///< as it stands in the files, nothing corrected
  SeriesChoice choice;     ///< the one that was asked with, and the list of series that was found
};

/// Reads headers alone. With its choice the other functions need not read them again.
/// @throws as readCt() before it reads a voxel
CtHead readCtHead(const std::filesystem::path& path, const SeriesChoice& choice = {},
                  const Progress& progress = {});

/// Reads a CT.
/// @throws InputMissing, InvalidInput (gaps, damage: see readDicomSeries), Unsupported (no CT, not
/// in HU), Error (OutOfMemory), Cancelled
CtFile readCt(const std::filesystem::path& path, const CtCorrections& corrections = {},
              const Progress& progress = {}, const SeriesChoice& choice = {});

}  // namespace pneuma
