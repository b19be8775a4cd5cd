#include "pipeline/ct_source.h"

#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/ct_file.h"
#include "io/input_files.h"
#include "io/volume_file.h"

namespace pneuma {
namespace {

std::uint64_t bytesOf(const std::vector<std::filesystem::path>& files) {
  std::uint64_t bytes = 0;
  for (const std::filesystem::path& file : files) {
    std::error_code error;
    bytes += std::filesystem::file_size(file, error);
    if (error) throw InputMissing("the CT '" + file.string() + "' cannot be read");
  }
  return bytes;
}

/// Folders often carry a patient's name.
std::string named(const std::filesystem::path& path) {
  return "'" + (path.has_filename() ? path : path.parent_path()).filename().string() + "'";
}

std::string megabytes(std::uint64_t bytes) {
  const std::uint64_t tenths = (bytes + 50'000) / 100'000;
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " MB";
}

/// How readCt() may be asked for what is at a place: the series that the source names, then all
/// others.
std::vector<SeriesChoice> choicesAt(const std::filesystem::path& path, const CtSource& source,
                                    const Progress& progress) {
  if (isVolumeFile(path)) return {SeriesChoice{}};
  if (!isDicomPath(path)) {
    throw InvalidInput(named(path) +
                       " holds no CT; take the file or the folder of slices that the project was "
                       "made with");
  }
  const auto all =
      std::make_shared<const std::vector<DicomSeries>>(listDicomSeries(path, progress));
  std::vector<SeriesChoice> choices = {{source.series, all}};
  for (const DicomSeries& series : *all) {
    if (!series.refusal) choices.push_back({seriesName(series.uid), all});
  }
  return choices;
}

}  // namespace

std::string contentHash(const std::vector<std::filesystem::path>& files, const Progress& progress) {
  std::string all;
  for (std::size_t n = 0; n < files.size(); ++n) {
    const auto part = [&](std::size_t done) {
      return static_cast<double>(done) / static_cast<double>(files.size());
    };
    all += files[n].filename().string() + "\n" +
           sha256OfFile(files[n], progress.part(part(n), part(n + 1), "hashing"));
  }
  return sha256(all);
}

namespace {

std::string hashOf(const std::vector<std::filesystem::path>& files, const Progress& progress) {
  return files.size() == 1 ? sha256OfFile(files.front(), progress) : contentHash(files, progress);
}

}  // namespace

CtSource hashed(CtSource source, const Progress& progress) {
  if (!source.sha256.empty()) return source;
  const auto files =
      ctInputFiles(source.path, {source.series}, progress.part(0.0, 0.2, "reading headers"));
  source.bytes = bytesOf(files);
  source.sha256 = hashOf(files, progress.part(0.2, 1.0, "hashing"));
  return source;
}

FoundCt foundCt(const CtSource& source, const std::filesystem::path& path,
                const Progress& progress) {
  FoundCt found{nullptr, source};
  found.source.path = path;
  const std::vector<SeriesChoice> choices =
      choicesAt(path, source, progress.part(0.0, 0.1, "reading headers"));
  std::uint64_t thereBytes = 0;
  for (const SeriesChoice& choice : choices) {
    std::vector<std::filesystem::path> files;
    try {
      files = ctInputFiles(path, choice);
    } catch (const Error&) {
      continue;  // there is no such series, or it cannot be read
    }
    const std::uint64_t bytes = bytesOf(files);
    if (thereBytes == 0) thereBytes = bytes;
    if (bytes != source.bytes) continue;
    thereBytes = bytes;
    if (hashOf(files, progress.part(0.1, 0.5, "looking whether it is the same CT")) !=
        source.sha256) {
      continue;
    }
    found.source.series = choice.wanted;
    CtFile file =
        readCt(path, source.corrections, progress.part(0.5, 1.0, "reading the CT"), choice);
    found.image = std::make_shared<const CtImage>(std::move(file.image));
    return found;
  }
  if (thereBytes == 0) throw InvalidInput(named(path) + " holds no CT that can be read");
  const std::string differs =
      thereBytes == source.bytes
          ? "it is as large, but its content, or the names of its files, are others"
          : "its files hold " + megabytes(thereBytes) + ", those of the project's CT " +
                megabytes(source.bytes);
  throw InvalidInput(named(path) + " is another CT than the one that the project was made with: " +
                     differs + "; take that one");
}

}  // namespace pneuma
