#include <algorithm>
#include <map>
#include <mutex>

#include "core/error.h"
#include "core/options.h"
#include "core/parallel.h"
#include "io/detail/dicom_pixels.h"
#include "io/detail/text_fields.h"
#include "io/dicom_series.h"

namespace pneuma {
namespace {

/// Which slice of the image every slice of the series becomes, and which nothing does.
struct Places {
  std::vector<std::size_t> of;       ///< of the series' slices
  std::vector<std::size_t> missing;  ///< of the image's
  std::vector<double> mm;            ///< where the image's slices stand, from the first
};

Places placesOf(const DicomSeries& series) {
  Places places;
  const std::vector<DicomSlice>& slices = series.slices;
  const Vec3 axis = series.geometry.direction.col(2);
  const auto mm = [&](const Vec3& p) { return (p - slices.front().position).dot(axis); };
  auto gap = series.check.gaps.begin();
  auto duplicate = series.check.duplicates.begin();
  for (std::size_t i = 0; i < slices.size(); ++i) {
    if (duplicate != series.check.duplicates.end() && *duplicate == i) {
      ++duplicate;
      places.of.push_back(places.of.back());
      continue;
    }
    if (gap != series.check.gaps.end() && gap->above == i) {
      const double from = mm(slices[gap->below].position);
      const double step = (mm(slices[i].position) - from) / (gap->missing + 1);
      for (int m = 1; m <= gap->missing; ++m) {
        places.missing.push_back(places.mm.size());
        places.mm.push_back(from + m * step);
      }
      ++gap;
    }
    places.of.push_back(places.mm.size());
    places.mm.push_back(mm(slices[i].position));
  }
  return places;
}

using Targets = std::vector<std::vector<SliceTarget>>;  // of each file, in the order of the slices

void readFiles(const DicomSeries& series, const Targets& files, const Progress& progress) {
  std::vector<std::string> faults(files.size());
  std::mutex mutex;
  std::size_t done = 0;
  parallelFor(files.size(), [&](std::size_t f) {
    progress.throwIfStopped();
    faults[f] = readSlices(series, files[f]);
    const std::lock_guard lock(mutex);
    progress.report(static_cast<double>(++done) / static_cast<double>(files.size()));
  });
  for (std::size_t f = 0; f < files.size(); ++f) {
    if (!faults[f].empty()) {
      throw InvalidInput(quotedName(files[f].front().slice->name) + " " + faults[f]);
    }
  }
}

/// Slices in one place may only be copies of each other.
void requireSame(const DicomSeries& series, const CtImage& image, const Places& places,
                 const Progress& progress) {
  const std::size_t size = image.geometry.sliceCount();
  std::vector<std::int16_t> copy(size);
  for (const std::size_t i : series.check.duplicates) {
    progress.throwIfStopped();
    const DicomSlice& slice = series.slices[i];
    const SliceTarget target{&slice, copy.data()};
    const std::string fault = readSlices(series, {&target, 1});
    if (!fault.empty()) throw InvalidInput(quotedName(slice.name) + " " + fault);
    if (std::equal(copy.begin(), copy.end(),
                   image.voxels.begin() + static_cast<std::ptrdiff_t>(size * places.of[i]))) {
      continue;
    }
    throw InvalidInput(titleOf(series) + " holds different slices in one place: " +
                       quotedName(slice.name) + " and " + quotedName(series.slices[i - 1].name) +
                       " at " + placeText(slice.position, series.geometry.direction.col(2)) +
                       (2 * series.check.duplicates.size() >= places.mm.size()
                            ? ": it seems to hold several phases or reconstructions; put each into "
                              "a folder of its "
                              "own"
                            : "; take one of them away"));
  }
}

}  // namespace

void requireReadable(const DicomSeries& series, const CtCorrections& corrections) {
  if (series.refusal) throw Error(series.refusal->code, series.refusal->sentence);
  if (!series.check.gaps.empty() && !corrections.fillGaps) {
    throw InvalidInput(titleOf(series) + ": " + gapsText(series) +
                       "; find them, or let them be interpolated (--fill-gaps)");
  }
  requireMemory(series.memoryBytes, titleOf(series));
}

std::string obstacleOf(const DicomSeries& series, const CtCorrections& corrections) {
  try {
    requireReadable(series, corrections);
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

CtImage readDicomSlice(const DicomSeries& series, std::size_t slice) {
  CtImage image;
  image.geometry = series.geometry;
  if (series.geometry.voxelCount() == 0) image.geometry = {};  // of a series that was refused
  image.geometry.size = {series.columns, series.rows, 1};
  image.geometry.origin = series.slices[slice].position;
  image.voxels.resize(image.geometry.voxelCount());
  const SliceTarget target{&series.slices[slice], image.voxels.data()};
  const std::string fault = readSlices(series, {&target, 1});
  if (!fault.empty()) throw InvalidInput(quotedName(series.slices[slice].name) + " " + fault);
  return image;
}

CtImage readDicomSeries(const DicomSeries& series, const CtCorrections& corrections,
                        const Progress& progress) {
  requireValid(corrections);
  requireReadable(series, corrections);
  const Places places = placesOf(series);
  CtImage image;
  image.geometry = series.geometry;
  image.voxels.resize(image.geometry.voxelCount());
  Targets files;
  std::map<std::filesystem::path, std::size_t> indexOf;
  auto duplicate = series.check.duplicates.begin();
  for (std::size_t i = 0; i < series.slices.size(); ++i) {
    if (duplicate != series.check.duplicates.end() && *duplicate == i) {
      ++duplicate;
      continue;
    }
    const auto [at, isNew] = indexOf.emplace(series.slices[i].file, files.size());
    if (isNew) files.emplace_back();
    files[at->second].push_back(
        {&series.slices[i], &image.at(0, 0, static_cast<int>(places.of[i]))});
  }
  const bool more = corrections.fixTilt || corrections.resampleMm > 0.0;
  readFiles(series, files, progress.part(0.0, more ? 0.5 : 1.0, "reading slices"));
  requireSame(series, image, places, progress);
  if (!places.missing.empty()) image = withSlicesFilled(std::move(image), places.missing);
  if (corrections.fixTilt && series.check.tilted()) {
    image = untilted(image, progress.part(0.5, 0.75, "undoing the tilt"));
  }
  if (corrections.resampleMm > 0.0) {
    std::vector<double> standing;  // left empty where the steps are even
    if (series.check.uneven()) {
      standing = places.mm;
      const double shrunk =
          image.geometry.spacing.z() / series.geometry.spacing.z();  // by untilting
      for (double& mm : standing) mm *= shrunk;
    }
    image =
        resampled(image, corrections.resampleMm, standing, progress.part(0.75, 1.0, "resampling"));
  }
  progress.report(1.0);
  return image;
}

}  // namespace pneuma
