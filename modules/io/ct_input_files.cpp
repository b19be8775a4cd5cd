#include <set>

#include "io/ct_file.h"
#include "io/volume_file.h"

namespace pneuma {

std::vector<std::filesystem::path> ctInputFiles(const std::filesystem::path& path,
                                                const SeriesChoice& choice,
                                                const Progress& progress) {
  if (isVolumeFile(path)) {
    const std::filesystem::path data = readVolumeHeader(path).dataFile;
    return data == path ? std::vector{path} : std::vector{path, data};
  }
  const std::vector<DicomSeries> all =
      choice.listed ? *choice.listed : listDicomSeries(path, progress);
  const DicomSeries& series = chosenSeries(all, choice);
  if (series.extracted) return {path};
  std::set<std::filesystem::path> files;
  for (const DicomSlice& slice : series.slices) files.insert(slice.file);
  return {files.begin(), files.end()};
}

}  // namespace pneuma
