#pragma once

#include <QString>
#include <filesystem>
#include <memory>
#include <vector>

#include "io/dicom_series.h"
#include "render/picture.h"

namespace pneuma {

/// A series of a folder as the window shows it, without anything that names a person.
struct SeriesRow {
  /// Whether lungs can be looked for in it.
  enum class Use {
    Recommended,
    Possible,      ///< others suit lungs better
    Doubtful,      ///< it can be opened, but is hardly what lungs are found in
    WithGapsOnly,  ///< slices are missing; it opens once they are interpolated
    Impossible
  };
  QString description;
  QString modality;
  QString slices;
  QString spacing;  ///< and thickness as stated, mm
  QString size;     ///< voxels
  QString kernel;   ///< empty if not stated
  QString why;      ///< the reason for its use, a sentence
  Use use = Use::Impossible;
  bool opened = false;  ///< it is open now

  bool canOpen() const { return use != Use::Impossible; }
};

/// The series of a folder or an archive, to choose one of.
struct SeriesList {
  std::vector<std::filesystem::path> paths;  ///< what is opened with it, itself among them
  std::shared_ptr<const std::vector<DicomSeries>> series;  ///< best first
  std::vector<SeriesRow> rows;                             ///< in the same order
  int chosen = -1;  ///< the row to open unless somebody says otherwise; none: -1

  /// False if there is nothing to ask: one series, and no doubt about it.
  bool toBeChosen() const;

  /// What there is to choose, in a sentence or two.
  QString sentence() const;
};

/// @param openedUid of the series that is open; "": none is
SeriesList seriesList(std::vector<std::filesystem::path> paths, std::vector<DicomSeries> series,
                      const std::string& openedUid = {});

/// The folder, archive or file with DICOM among paths to open; none if there is none, or several.
const std::filesystem::path* dicomPlace(const std::vector<std::filesystem::path>& paths);

/// The middle slice of a series, not larger than `edge` pixels: a CT in the lung window, others
/// from their darkest to their brightest. Without pixels if it cannot be read.
Picture thumbnailOf(const DicomSeries& series, int edge);

}  // namespace pneuma
