#include "io/ct_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "io/detail/dicom_pixels.h"
#include "io/detail/text_fields.h"
#include "io/member_archive.h"
#include "io/volume_file.h"

namespace pneuma {
namespace {

constexpr std::string_view SeriesNameStart = "series-";

namespace fs = std::filesystem;

constexpr std::size_t Values = 65536;  // of a voxel
constexpr int Lowest = std::numeric_limits<std::int16_t>::min();

std::string hundredths(double value) { return numberText(std::round(value * 100.0) / 100.0); }

void addFindings(CtFile& file, const DicomSeries& series, const CtCorrections& corrections) {
  const SeriesCheck& check = series.check;
  file.notes.insert(file.notes.end(), series.notes.begin(), series.notes.end());
  if (!check.gaps.empty()) {
    file.warnings.push_back(gapsText(series) + "; interpolated from their neighbours");
  }
  if (!check.duplicates.empty()) {
    file.notes.push_back(std::to_string(check.duplicates.size()) +
                         (check.duplicates.size() == 1 ? " slice was" : " slices were") +
                         " there twice with the same pixels; one of each was taken");
  }
  if (check.uneven()) {
    file.notes.push_back(
        "slices are unevenly spaced: steps differ from " + hundredths(check.spacingMm) +
        " mm by up to " + hundredths(check.unevenMm) + " mm" +
        (corrections.resampleMm > 0.0 ? "; resampled from where they stand"
                                      : "; resample to put them right (--resample)"));
  }
  if (series.compression.find("Lossless") == std::string::npos &&
      series.compression.starts_with("JPEG")) {
    file.notes.push_back("the pixels are compressed with loss (" + series.compression + ")");
  }
}

void addTilt(CtFile& file, const CtCorrections& corrections) {
  if (file.tiltDeg <= LeastTiltDeg) return;
  const std::string tilt = "the gantry was tilted by " + hundredths(file.tiltDeg) + " deg";
  if (corrections.fixTilt) {
    file.notes.push_back(tilt + "; undone");
  } else {
    file.warnings.push_back(tilt +
                            "; slices are kept where they lie, on skew axes; undo it to have "
                            "them straight over each other (--fix-tilt)");
  }
}

void requireHu(const CtFile& file, const fs::path& path) {
  if (file.hu.plausible()) return;
  if (file.hu.paddingShare >= 1.0) {
    throw InvalidInput(quoted(path) + " holds nothing but padding");
  }
  throw Unsupported(
      quoted(path) + " does not look like a chest CT in HU: 99 % of its values lie at " +
      numberText(file.hu.percentile1) + " or above (lowest " + std::to_string(file.hu.lowest) +
      "), but a chest holds air, below -500; check that the series is the right one "
      "and its rescale slope and intercept are there");
}

[[noreturn]] void throwOfAnotherPart(const DicomSeries& series) {
  throw Unsupported(titleOf(series) + " is not of the chest: its header states the body part " +
                    quotedName(series.bodyPart) +
                    "; if it shows the chest all the same, take it by '" +
                    "pneuma import --series " + std::to_string(series.place) + "'");
}

CtFile readDicom(const fs::path& path, const CtCorrections& corrections, const Progress& progress,
                 const SeriesChoice& choice) {
  std::vector<DicomSeries> all =
      choice.listed ? *choice.listed
                    : listDicomSeries(path, progress.part(0.0, 0.1, "reading headers"));
  const DicomSeries& series = chosenSeries(all, choice);
  CtFile file;
  file.format = "DICOM";
  file.image = readDicomSeries(series, corrections, progress.part(0.1, 0.95, "reading slices"));
  file.tiltDeg = series.check.tiltDeg;
  addFindings(file, series, corrections);
  const auto chosen = all.begin() + (&series - all.data());
  file.series = std::move(*chosen);
  all.erase(chosen);
  file.others = std::move(all);
  return file;
}

CtFile readVolume(const fs::path& path, const CtCorrections& corrections, const Progress& progress,
                  const SeriesChoice& choice) {
  if (!choice.wanted.empty()) {
    throw InvalidOption(quoted(path) + " is one volume; a series can be chosen of DICOM only");
  }
  const VolumeHeader header = readVolumeHeader(path);
  CtFile file;
  file.format = header.format;
  file.notes = header.notes;
  file.tiltDeg = tiltDeg(header.geometry);
  file.image = readHuVolume(path, progress.part(0.0, 0.7, "reading"));
  const ImageGeometry& geometry = file.image.geometry;
  parallelFor(static_cast<std::size_t>(geometry.size[2]), [&](std::size_t k) {
    markCornerPadding({&file.image.at(0, 0, static_cast<int>(k)), geometry.sliceCount()},
                      static_cast<std::size_t>(geometry.size[0]));
  });
  if (corrections.fixTilt && file.tiltDeg > LeastTiltDeg) {
    file.image = untilted(file.image, progress.part(0.7, 0.8, "undoing the tilt"));
  }
  if (corrections.resampleMm > 0.0) {
    file.image =
        resampled(file.image, corrections.resampleMm, {}, progress.part(0.8, 0.95, "resampling"));
  }
  return file;
}

}  // namespace

HuCheck huCheck(const CtImage& image) {
  // Counted by slabs; whole numbers add up to the same in any order.
  const auto slices = static_cast<std::size_t>(image.geometry.size[2]);
  const std::size_t slabs = std::min<std::size_t>(slices, 8);
  const std::size_t size = image.geometry.sliceCount();
  std::vector<std::vector<std::uint64_t>> counts(slabs, std::vector<std::uint64_t>(Values));
  parallelFor(slabs, [&](std::size_t s) {
    const std::size_t end = size * (slices * (s + 1) / slabs);
    for (std::size_t i = size * (slices * s / slabs); i < end; ++i) {
      ++counts[s][static_cast<std::size_t>(image.voxels[i] - Lowest)];
    }
  });
  std::vector<std::uint64_t>& all = counts.front();
  for (std::size_t s = 1; s < slabs; ++s) {
    for (std::size_t v = 0; v < Values; ++v) all[v] += counts[s][v];
  }
  const auto padding = static_cast<std::size_t>(PaddingHu - Lowest);
  HuCheck check;
  check.paddingShare = static_cast<double>(all[padding]) / static_cast<double>(image.voxels.size());
  all[padding] = 0;
  std::uint64_t measured = 0;
  for (const std::uint64_t n : all) measured += n;
  if (measured == 0) return check;
  const std::uint64_t hundredth = measured / 100;
  std::uint64_t below = 0;
  bool found = false;
  bool first = true;
  for (std::size_t v = 0; v < Values; ++v) {
    if (all[v] == 0) continue;
    const int hu = static_cast<int>(v) + Lowest;
    if (first) check.lowest = hu;
    first = false;
    check.highest = hu;
    below += all[v];
    if (!found && below > hundredth) {
      check.percentile1 = hu;
      found = true;
    }
  }
  return check;
}

bool isCtPath(const fs::path& path) {
  // A project is a zip archive, too.
  return !isProjectFileName(path) && (isVolumeFile(path) || isDicomPath(path));
}

std::string seriesName(const std::string& uid) {
  constexpr std::size_t Digits = 16;
  return std::string(SeriesNameStart) + sha256(uid).substr(0, Digits);
}

std::string keptSeries(const std::string& wanted) {
  const bool tellsNothing =
      wanted.empty() || parseInteger(wanted).has_value() || wanted.starts_with(SeriesNameStart);
  return tellsNothing ? wanted : seriesName(wanted);
}

const DicomSeries& chosenSeries(const std::vector<DicomSeries>& all, const SeriesChoice& choice) {
  if (choice.wanted.empty()) {
    if (all.front().refusal && all.size() > 1) {
      throw Error(all.front().refusal->code,
                  "none of the " + std::to_string(all.size()) +
                      " series there can be read; the first: " + all.front().refusal->sentence);
    }
    if (!all.front().refusal && all.front().ofAnotherPart) throwOfAnotherPart(all.front());
    return all.front();
  }
  const auto named = std::ranges::find_if(all, [&](const DicomSeries& series) {
    return series.uid == choice.wanted || seriesName(series.uid) == choice.wanted;
  });
  if (named != all.end()) return *named;
  const std::optional<std::int64_t> place = parseInteger(choice.wanted);
  if (place && *place >= 1 && *place <= static_cast<std::int64_t>(all.size())) {
    return all[static_cast<std::size_t>(*place - 1)];
  }
  throw InvalidOption("there is no series '" + choice.wanted + "'; " + std::to_string(all.size()) +
                      (all.size() == 1 ? " is" : " are") +
                      " there, to be chosen by place in the list of 'pneuma info', by UID, or by "
                      "the name that a project gives "
                      "it");
}

CtFile readCt(const fs::path& path, const CtCorrections& corrections, const Progress& progress,
              const SeriesChoice& choice) {
  requireValid(corrections);
  CtFile file = isVolumeFile(path) ? readVolume(path, corrections, progress, choice)
                                   : readDicom(path, corrections, progress, choice);
  addTilt(file, corrections);
  file.memoryBytes = file.image.voxels.size() * sizeof(std::int16_t);
  file.hu = huCheck(file.image);
  requireHu(file, path);
  progress.report(1.0);
  return file;
}

}  // namespace pneuma
