#include "io/dicom_series.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "io/atomic_file.h"
#include "io/detail/dicom_header.h"
#include "io/detail/text_fields.h"
#include "io/detail/unzipped.h"
#include "io/detail/volume_fields.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr int SubfolderDepth = 1;       // a folder and the folders in it
constexpr double SameDirection = 1e-3;  // radians
constexpr double SameSpacing = 1e-3;    // relative
constexpr std::size_t MostNamed = 3;    // files or places in one sentence

/// Where headers are looked for, and what takes care of the files.
struct Source {
  std::shared_ptr<const void> folder;
  std::vector<Unzipped::File> files;
  std::vector<std::string> unreadable;
};

void addFiles(Source& source, const fs::path& folder, int depth, const Progress& progress) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    entries.push_back(entry->path());
  }
  if (error) {
    source.unreadable.push_back(folder.filename().string());
    return;
  }
  std::ranges::sort(entries);
  for (const fs::path& entry : entries) {
    progress.throwIfStopped();
    std::error_code ignored;
    if (fs::is_regular_file(entry, ignored)) {
      source.files.push_back({entry, entry.filename().string()});
    } else if (depth > 0 && fs::is_directory(entry, ignored)) {
      addFiles(source, entry, depth - 1, progress);
    }
  }
}

Source sourceOf(const fs::path& path, const Progress& progress) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    throw InputMissing(
        quoted(path) +
        (error ? " cannot be reached: " + error.message() : std::string(" is not there")) +
        "; check the path");
  }
  Source source;
  if (fs::is_directory(path, error)) {
    addFiles(source, path, SubfolderDepth, progress);
    if (source.files.empty() && !source.unreadable.empty()) {
      throw InputMissing("the folder " + quoted(path) + " cannot be read; check its permissions");
    }
  } else if (isZipFile(path)) {
    Unzipped archive = unzipped(path, progress);
    source.folder = std::move(archive.folder);
    source.files = std::move(archive.files);
  } else if (!fs::is_regular_file(path, error)) {
    throw InputMissing(quoted(path) + " is a device or a pipe; name a file");
  } else {
    addFiles(source, folderOf(path), 0, progress);
  }
  return source;
}

/// "'a', 'b', 'c' and 4 more"
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), MostNamed); ++i) {
    text += (i == 0 ? "" : ", ") + quotedName(names[i]);
  }
  if (names.size() > MostNamed)
    text += " and " + std::to_string(names.size() - MostNamed) + " more";
  return text;
}

/// How a slice differs from the first of its series so that both cannot be one volume, or "".
std::string difference(const DicomHeader& header, const DicomHeader& first) {
  const DicomSeries& a = header.series;
  const DicomSeries& b = first.series;
  if (a.rows != b.rows || a.columns != b.columns) {
    return "has " + std::to_string(a.columns) + " x " + std::to_string(a.rows) + " pixels, " +
           quotedName(first.name()) + " " + std::to_string(b.columns) + " x " +
           std::to_string(b.rows);
  }
  if ((header.row - first.row).norm() > SameDirection ||
      (header.column - first.column).norm() > SameDirection) {
    return "is oriented otherwise than " + quotedName(first.name());
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (std::abs(header.pixelMm[axis] / first.pixelMm[axis] - 1.0) > SameSpacing) {
      return "has pixels of " + numberText(header.pixelMm[axis]) + " mm, " +
             quotedName(first.name()) + " of " + numberText(first.pixelMm[axis]) + " mm";
    }
  }
  return "";
}

/// Faults of single files, and slices that do not belong together.
std::optional<Refusal> refusalOfFiles(const DicomSeries& series,
                                      const std::vector<DicomHeader>& headers) {
  if (series.modality != "CT") {
    return Refusal{ExitCode::Unsupported,
                   titleOf(series) + " is no CT: its modality is " +
                       (series.modality.empty() ? "not stated" : series.modality)};
  }
  if (headers.front().localizer) {
    return Refusal{
        ExitCode::Unsupported,
        titleOf(series) + " is a localizer (an overview picture), not a stack of slices"};
  }
  std::vector<std::string> faulty;
  const DicomHeader* worst = nullptr;
  for (const DicomHeader& header : headers) {
    if (header.fault.empty()) continue;
    if (worst == nullptr) worst = &header;
    faulty.push_back(header.name());
  }
  if (worst != nullptr) {
    const std::string others = faulty.size() == 1
                                   ? ""
                                   : " (and " + std::to_string(faulty.size() - 1) + " more of " +
                                         std::to_string(headers.size()) + " files are faulty)";
    return Refusal{worst->faultCode, quotedName(worst->name()) + " " + worst->fault + others};
  }
  for (const DicomHeader& header : headers) {
    const std::string odd = difference(header, headers.front());
    if (!odd.empty()) {
      return Refusal{ExitCode::InputInvalid,
                     titleOf(series) +
                         " mixes slices that are no one volume: " + quotedName(header.name()) +
                         " " + odd + "; put them in folders of their own"};
    }
  }
  return std::nullopt;
}

/// What is wrong with the stack and cannot be corrected.
std::optional<Refusal> refusalOfStack(const DicomSeries& series) {
  const SeriesCheck& check = series.check;
  const std::size_t places = series.slices.size() - check.duplicates.size();
  if (series.slices.size() < 2) {
    return Refusal{ExitCode::InputInvalid, titleOf(series) + " has one slice only (" +
                                               quotedName(series.slices[0].name) +
                                               "); a volume needs two or more"};
  }
  if (places < 2) {
    return Refusal{ExitCode::InputInvalid, titleOf(series) + ": all " +
                                               std::to_string(series.slices.size()) +
                                               " slices stand in the same place"};
  }
  if (static_cast<std::size_t>(check.missing()) > places) {
    return Refusal{ExitCode::InputInvalid,
                   gapsText(series) +
                       "; more are missing than there are, so that nothing can be "
                       "made of it"};
  }
  if (check.sidewaysMm > std::max(series.geometry.spacing.x(), series.geometry.spacing.y())) {
    return Refusal{ExitCode::InputInvalid,
                   titleOf(series) + ": slices are shifted sideways by up to " +
                       numberText(std::round(check.sidewaysMm * 100.0) / 100.0) +
                       " mm against each other; they are no one volume"};
  }
  return std::nullopt;
}

void setGeometry(DicomSeries& series, const DicomHeader& first) {
  const Vec3 start = series.slices.front().position;
  const Vec3 axis = series.slices.back().position - start;
  const std::size_t places = series.slices.size() - series.check.duplicates.size();
  const int slices = static_cast<int>(places) + series.check.missing();
  ImageGeometry& geometry = series.geometry;
  geometry.size = {series.columns, series.rows, slices};
  geometry.origin = start;
  geometry.direction.col(0) = first.row;
  geometry.direction.col(1) = first.column;
  geometry.direction.col(2) = first.normal();
  geometry.spacing = Vec3(first.pixelMm[0], first.pixelMm[1], 1.0);
  if (places > 1) {
    // The mean step, so that the last slice lies where it says; along a tilted gantry's axis.
    geometry.spacing.z() = axis.norm() / (slices - 1);
    geometry.direction.col(2) = axis.normalized();
  }
  series.memoryBytes = geometry.voxelCount() * sizeof(std::int16_t);
}

/// Steps that no scanner makes, positions that are no place.
std::optional<Refusal> refusalOfGeometry(const DicomSeries& series) {
  const ImageGeometry& geometry = series.geometry;
  try {
    checkedGeometry(geometry.size, geometry.steps(), geometry.origin, titleOf(series));
  } catch (const InvalidInput& error) {
    return Refusal{error.code(), error.what()};
  }
  return std::nullopt;
}

void addNotes(DicomSeries& series) {
  const auto rescaled = [&](const DicomSlice& slice) {
    return slice.slope != series.slices.front().slope ||
           slice.intercept != series.slices.front().intercept;
  };
  if (std::ranges::any_of(series.slices, rescaled)) {
    series.notes.emplace_back("slices differ in slope and intercept; each was taken with its own");
  }
  const double thickness = series.thicknessMm;
  const double spacing = series.check.spacingMm;
  if (thickness > 0.0 && spacing > 0.0 && spacing > 1.5 * thickness) {
    series.notes.push_back("slices of " + numberText(thickness) + " mm stand " +
                           numberText(std::round(spacing * 1000.0) / 1000.0) +
                           " mm apart: what lies between was not scanned");
  }
}

DicomSeries seriesOf(std::vector<DicomHeader> headers) {
  DicomSeries series = headers.front().series;
  series.slices.clear();
  const Vec3 normal = headers.front().normal();
  for (const DicomHeader& header : headers) {
    series.slices.insert(series.slices.end(), header.series.slices.begin(),
                         header.series.slices.end());
  }
  series.refusal = refusalOfFiles(series, headers);
  if (!series.refusal) {
    std::ranges::stable_sort(series.slices, {},
                             [&](const DicomSlice& slice) { return slice.position.dot(normal); });
    series.check = checkedStack(series.slices, normal);
    setGeometry(series, headers.front());
    series.refusal = refusalOfGeometry(series);
    if (!series.refusal) series.refusal = refusalOfStack(series);
    addNotes(series);
  }
  rate(series, headers.front());
  return series;
}

/// Headers of the files, in the order of the files, damaged ones without a series apart.
struct Headers {
  std::map<std::pair<std::string, bool>, std::vector<DicomHeader>> bySeries;
  std::vector<std::string> lost;   ///< DICOM files that end before they say what they belong to
  std::vector<std::string> empty;  ///< called .dcm but something else
  std::vector<std::string> unreadable;
  std::size_t withoutPicture = 0;
};

Headers headersOf(const Source& source, const std::string& onlyUid, const Progress& progress) {
  Headers headers;
  headers.unreadable = source.unreadable;
  for (std::size_t i = 0; i < source.files.size(); ++i) {
    progress.report(static_cast<double>(i) / static_cast<double>(source.files.size()));
    const auto& [path, name] = source.files[i];
    std::optional<DicomHeader> header;
    try {
      header = readDicomHeader(path, name);
    } catch (const InputMissing&) {
      headers.unreadable.push_back(name);
      continue;
    }
    if (!header) {
      if (lowerCase(path.extension().string()) == ".dcm") headers.empty.push_back(name);
    } else if (!header->fault.empty() && (header->series.uid.empty() || !header->hasPixels)) {
      headers.lost.push_back(name);
    } else if (!header->hasPixels) {
      ++headers.withoutPicture;
    } else if (onlyUid.empty() || header->series.uid == onlyUid) {
      headers.bySeries[{header->series.uid, header->localizer}].push_back(std::move(*header));
    }
  }
  return headers;
}

[[noreturn]] void throwNothing(const fs::path& path, const Source& source, const Headers& headers) {
  if (!headers.lost.empty()) {
    throw InvalidInput(listed(headers.lost) +
                       " is cut off or damaged; copy it again from its source");
  }
  if (!headers.unreadable.empty()) {
    throw InputMissing(listed(headers.unreadable) + " cannot be read; check the permissions");
  }
  std::string text = "there is no DICOM picture in " + quoted(path) + ": ";
  text += source.files.empty()
              ? "it holds no files"
              : std::to_string(source.files.size()) + " files were looked at, " +
                    std::to_string(headers.withoutPicture) + " of them DICOM without a picture";
  throw InputMissing(text);
}

}  // namespace

std::vector<DicomSeries> listDicomSeries(const fs::path& path, const Progress& progress) {
  const Source source = sourceOf(path, progress.part(0.0, 0.5, "unpacking"));
  std::string onlyUid;
  std::error_code error;
  if (fs::is_regular_file(path, error) && !source.folder) {
    const std::optional<DicomHeader> header = readDicomHeader(path, path.filename().string());
    if (!header) throw Unsupported(quoted(path) + " is neither DICOM nor a zip archive");
    if (!header->hasPixels && !header->fault.empty()) {
      throw InvalidInput(quoted(path) + " " + header->fault);
    }
    if (!header->hasPixels) throw Unsupported(quoted(path) + " is DICOM without a picture");
    onlyUid = header->series.uid;
  }
  Headers headers = headersOf(source, onlyUid, progress.part(0.5, 1.0, "reading headers"));
  if (headers.bySeries.empty()) throwNothing(path, source, headers);
  std::vector<DicomSeries> all;
  for (auto& [key, files] : headers.bySeries) {
    DicomSeries series = seriesOf(std::move(files));
    series.extracted = source.folder;
    if (!headers.lost.empty() && !series.refusal) {
      series.refusal = Refusal{ExitCode::InputInvalid,
                               listed(headers.lost) +
                                   " is cut off within its header; copy it again from its source, "
                                   "or move it away if it does not belong to this series"};
      series.rating = 0;
      series.reasons = {series.refusal->sentence};
    }
    if (!headers.unreadable.empty()) {
      series.notes.push_back(listed(headers.unreadable) +
                             " could not be read for lack of permission; a slice may be missing");
    }
    if (!headers.empty.empty()) {
      series.notes.push_back(listed(headers.empty) + " is called .dcm but is no DICOM file");
    }
    all.push_back(std::move(series));
  }
  std::ranges::sort(all, betterSeries);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].place = static_cast<int>(i) + 1;
  return all;
}

bool isDicomPath(const fs::path& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return isDicomFile(path) || isZipFile(path);
  if (!fs::is_directory(path, error)) return false;
  Source source;
  addFiles(source, path, SubfolderDepth, {});
  return std::ranges::any_of(source.files, [](const auto& file) { return isDicomFile(file.path); });
}

std::string titleOf(const DicomSeries& series) {
  return "series " + std::to_string(series.number) +
         (series.description.empty() ? "" : " " + quotedName(series.description));
}

std::string placeText(const Vec3& point, const Vec3& normal) {
  static constexpr std::array<std::array<char, 2>, 3> Letters = {
      {{'L', 'R'}, {'P', 'A'}, {'S', 'I'}}};
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const double value = std::round(point[axis] * 100.0) / 100.0;
  return std::string(1, Letters[static_cast<std::size_t>(axis)][value < 0.0 ? 1 : 0]) + " " +
         numberText(std::abs(value)) + " mm";
}

std::string gapsText(const DicomSeries& series) {
  const Vec3 normal = series.geometry.direction.col(2);
  std::string text;
  for (std::size_t g = 0; g < std::min(series.check.gaps.size(), MostNamed); ++g) {
    const SliceGap& gap = series.check.gaps[g];
    text += (g == 0 ? "" : "; ") + std::to_string(gap.missing) +
            (gap.missing == 1 ? " slice is" : " slices are") + " missing between " +
            placeText(series.slices[gap.below].position, normal) + " and " +
            placeText(series.slices[gap.above].position, normal) + " (at ";
    for (std::size_t m = 0; m < std::min(gap.where.size(), MostNamed); ++m) {
      text += (m == 0 ? "" : ", ") + placeText(gap.where[m], normal);
    }
    text += gap.where.size() > MostNamed ? " and on)" : ")";
  }
  if (series.check.gaps.size() > MostNamed) {
    text += "; and " + std::to_string(series.check.gaps.size() - MostNamed) + " more gaps";
  }
  return text;
}

}  // namespace pneuma
