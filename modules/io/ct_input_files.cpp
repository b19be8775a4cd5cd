#include <memory>
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

CtHead readCtHead(const std::filesystem::path& path, const SeriesChoice& choice,
                  const Progress& progress) {
  if (isVolumeFile(path)) return {readVolumeHeader(path).geometry, choice};
  CtHead head{{}, choice};
  if (!head.choice.listed) {
    head.choice.listed =
        std::make_shared<const std::vector<DicomSeries>>(listDicomSeries(path, progress));
  }
  head.geometry = chosenSeries(*head.choice.listed, choice).geometry;
  return head;
}

}  // namespace pneuma
