#include "cli/ct_report.h"

#include <algorithm>
#include <cmath>

#include "cli/arguments.h"
#include "cli/files.h"
#include "cli/text.h"
#include "core/units.h"
#include "io/atomic_file.h"
#include "io/input_files.h"

namespace pneuma::cli {
namespace {

std::vector<const DicomSeries*> allSeries(const CtFile& file) {
  std::vector<const DicomSeries*> all;
  if (!file.series) return all;
  all.push_back(&*file.series);
  for (const DicomSeries& other : file.others) all.push_back(&other);
  std::ranges::sort(all, {}, &DicomSeries::place);
  return all;
}

Json vectorJson(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json geometryJson(const ImageGeometry& geometry) {
  Json rows = Json::array();
  for (int r = 0; r < 3; ++r) rows.push_back(vectorJson(geometry.direction.row(r)));
  return {{"size", geometry.size},
          {"spacing_mm", vectorJson(geometry.spacing)},
          {"origin_mm", vectorJson(geometry.origin)},
          {"direction", rows}};
}

Json seriesJson(const DicomSeries& series) {
  return {{"place", series.place},
          {"number", series.number},
          {"modality", series.modality},
          {"description", series.description},
          {"kernel", series.kernel},
          {"body_part", series.bodyPart},
          {"image_type", series.imageType},
          {"compression", series.compression},
          {"slices", series.slices.size()},
          {"columns", series.columns},
          {"rows", series.rows},
          {"pixel_mm", {series.geometry.spacing.x(), series.geometry.spacing.y()}},
          {"spacing_mm", series.check.spacingMm},
          {"thickness_mm", series.thicknessMm},
          {"rating", series.rating},
          {"reasons", series.reasons}};
}

Json gapsJson(const DicomSeries& series) {
  Json gaps = Json::array();
  for (const SliceGap& gap : series.check.gaps) {
    gaps.push_back({{"below_mm", vectorJson(series.slices[gap.below].position)},
                    {"above_mm", vectorJson(series.slices[gap.above].position)},
                    {"missing", gap.missing}});
  }
  return gaps;
}

/// "to the left, the back, up": where i, j and k run, and by how much they miss it.
std::string directionText(const ImageGeometry& geometry) {
  static constexpr std::array<std::array<const char*, 2>, 3> Names = {
      {{"left", "right"}, {"back", "front"}, {"head", "feet"}}};
  std::string text;
  double worst = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Index along = 0;
    const Vec3 column = geometry.direction.col(axis);
    worst = std::max(worst, std::acos(std::min(1.0, column.cwiseAbs().maxCoeff(&along))));
    text += (axis == 0 ? "towards " : ", ") +
            std::string(Names[static_cast<std::size_t>(along)][column[along] < 0.0 ? 1 : 0]);
  }
  const double deg = degrees(worst);
  return deg < 0.05 ? text : text + ", up to " + fixed(deg, 1) + " deg oblique";
}

std::string stars(int rating) {
  return std::string(static_cast<std::size_t>(rating), '*') +
         std::string(static_cast<std::size_t>(5 - rating), '.');
}

std::string megabytes(std::uint64_t bytes) {
  return fixed(static_cast<double>(bytes) / 1e6, 1) + " MB";
}

std::string listed(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += "  ! " + sentence + "\n";
  return text;
}

}  // namespace

void addCorrections(CLI::App& app, CtCorrections& corrections) {
  forEachField<CtCorrections>([&](const auto& field) {
    using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
    if constexpr (std::is_same_v<Value, bool>) {
      app.add_flag("--" + std::string(field.name), corrections.*(field.member),
                   std::string(field.help));
    } else {
      addField(app, corrections, field);
    }
  });
}

Json ctJson(const CtFile& file, bool identifiers) {
  Json json = {{"kind", "ct"},
               {"format", file.format},
               {"geometry", geometryJson(file.image.geometry)},
               {"tilt_deg", file.tiltDeg},
               {"hu",
                {{"percentile_1", file.hu.percentile1},
                 {"lowest", file.hu.lowest},
                 {"highest", file.hu.highest},
                 {"padding_share", file.hu.paddingShare},
                 {"plausible", file.hu.plausible()}}},
               {"memory_bytes", file.memoryBytes},
               {"complaints", file.warnings},
               {"notes", file.notes}};
  if (!file.series) return json;
  json["gaps"] = gapsJson(*file.series);
  json["missing_slices"] = file.series->check.missing();
  json["duplicate_slices"] = file.series->check.duplicates.size();
  json["uneven_mm"] = file.series->check.unevenMm;
  json["series_chosen"] = file.series->place;
  json["series"] = Json::array();
  for (const DicomSeries* series : allSeries(file)) json["series"].push_back(seriesJson(*series));
  if (identifiers) json["identifiers"] = file.series->identifiers;
  return json;
}

std::string ctText(const CtFile& file, bool identifiers) {
  const ImageGeometry& geometry = file.image.geometry;
  const auto by = [](const auto& a, const auto& b, const auto& c) {
    return a + " x " + b + " x " + c;
  };
  std::vector<std::vector<std::string>> rows = {
      {"size", by(std::to_string(geometry.size[0]), std::to_string(geometry.size[1]),
                  std::to_string(geometry.size[2])) +
                   " voxels"},
      {"voxel", by(fixed(geometry.spacing.x(), 3), fixed(geometry.spacing.y(), 3),
                   fixed(geometry.spacing.z(), 3)) +
                    " mm"},
      {"first voxel (LPS)", fixed(geometry.origin.x(), 1) + ", " + fixed(geometry.origin.y(), 1) +
                                ", " + fixed(geometry.origin.z(), 1) + " mm"},
      {"axes", directionText(geometry)},
      {"gantry tilt", fixed(file.tiltDeg, 1) + " deg"}};
  if (file.series) {
    const SeriesCheck& check = file.series->check;
    rows.push_back({"missing slices", std::to_string(check.missing())});
    rows.push_back({"slices in one place", std::to_string(check.duplicates.size())});
    rows.push_back({"slice spacing",
                    fixed(check.spacingMm, 3) + " mm, " +
                        (check.uneven() ? "uneven by up to " + fixed(check.unevenMm, 3) + " mm"
                                        : std::string("even"))});
  }
  rows.push_back({"HU", std::to_string(file.hu.lowest) + " to " + std::to_string(file.hu.highest) +
                            ", 1 % below " + fixed(file.hu.percentile1, 0)});
  rows.push_back({"padding", fixed(100.0 * file.hu.paddingShare, 1) + " %"});
  rows.push_back({"memory", megabytes(file.memoryBytes)});
  std::string text = table(rows) + listed(file.warnings) + listed(file.notes);
  if (file.series) text += "series here, best first:\n" + seriesTable(allSeries(file));
  if (identifiers && file.series) {
    text += "identifiers:\n";
    for (const auto& [name, value] : file.series->identifiers) {
      text += "  " + name + ": " + value + "\n";
    }
  }
  return text;
}

std::string seriesTable(const std::vector<const DicomSeries*>& all) {
  std::vector<std::vector<std::string>> rows = {{"  ", "rating", "kind", "slices", "pixels",
                                                 "pixel", "spacing", "thickness", "kernel",
                                                 "description"}};
  for (const DicomSeries* series : all) {
    const bool sound = !series->refusal;
    rows.push_back({"  " + std::to_string(series->place), stars(series->rating), series->modality,
                    std::to_string(series->slices.size()),
                    std::to_string(series->columns) + " x " + std::to_string(series->rows),
                    sound ? fixed(series->geometry.spacing.x(), 2) : "-",
                    sound ? fixed(series->check.spacingMm, 2) : "-", fixed(series->thicknessMm, 2),
                    series->kernel.empty() ? "-" : series->kernel, series->description});
  }
  std::string text = table(rows);
  for (const DicomSeries* series : all) {
    std::string reasons;
    for (const std::string& reason : series->reasons) {
      reasons += (reasons.empty() ? "" : "; ") + reason;
    }
    text += "  " + std::to_string(series->place) + ": " + reasons + "\n";
  }
  return text;
}

}  // namespace pneuma::cli
