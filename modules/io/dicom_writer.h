#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/progress.h"
#include "io/atomic_file.h"

namespace pneuma {

/// How a CT becomes a DICOM series.
struct DicomWriting {
  std::string patientName = "PNEUMA^SAMPLE";
  std::string patientId = "PNEUMA-SAMPLE";
  std::string studyDescription = "Synthetic chest";
  std::string seriesDescription = "Synthetic chest CT";
  std::string kernel = "STANDARD";
  /// The UIDs are made from it: the same text, the same UIDs. Series that differ need other texts.
  std::string identity;
  std::vector<int> leftOut;  ///< slices (k) for which no file is written; their numbers stay free
};

/// The names of the files that writeDicomSeries() makes, upwards in k: "slice-0001.dcm", ...
std::vector<std::string> dicomFileNames(const CtImage& image, const DicomWriting& writing);

/// Writes one CT Image Storage file per slice into a folder that exists: explicit VR little endian,
/// 16 bits signed, HU = stored - 1024, PaddingHu as the pixel padding value. Position and
/// orientation of every slice are those of the geometry. Where the slices are not stacked straight
/// (a tilted gantry) GantryDetectorTilt tells by how much. Each file is written aside and renamed.
/// @throws InvalidInput for rows and columns that are not perpendicular or more than 65535;
///         OutputFailed; Cancelled: the files written so far stay
void writeDicomSeries(const std::filesystem::path& folder, const CtImage& image,
                      const DicomWriting& writing, Existing existing = Existing::Replace,
                      const Progress& progress = {});

/// "2.25." and the decimal number of a UUID (version 8) made from a text: a valid DICOM UID.
std::string uidOf(const std::string& text);

}  // namespace pneuma
