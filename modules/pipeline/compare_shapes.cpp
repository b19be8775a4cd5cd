#include "pipeline/compare_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anatomy/lobe.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/units.h"
#include "geometry/nearest_triangle.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/figure_table.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

std::vector<double> distances(const TriangleMesh& from, const TriangleMesh& to) {
  const NearestTriangle nearest(to);
  std::vector<double> found(from.points.size());
  parallelFor(found.size(), [&](std::size_t p) { found[p] = nearest.distanceMm(from.points[p]); });
  return found;
}

std::string labelName(std::uint8_t label) {
  if (label == 0) return "all";
  const std::string_view name = shortName(static_cast<Lobe>(label));
  const auto lobe = lobeOfShortName(name);
  const bool known = lobe && static_cast<std::uint8_t>(*lobe) == label;
  return known ? std::string(name) : std::to_string(label);
}

/// Of the second over the first; infinite for a surface against one without volume.
double percent(double first, double second) {
  if (first == second) return 0.0;
  if (first == 0.0) return std::numeric_limits<double>::infinity();
  return 100.0 * (second - first) / std::abs(first);
}

double percent(const LabelAgreement& label) { return 100.0 * label.volumeDifference(); }

/// JSON has no infinity: null says that there is no such figure.
Json finiteJson(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// "the first has none" where it has none of a label that the other has, else "".
std::string missing(const LabelAgreement& label) {
  if (!label.inOneOnly()) return "";
  return label.firstMl > 0.0 ? "the second has none" : "the first has none";
}

std::vector<std::string> failuresOf(const LabelAgreement& label, const ShapeLimits& limits) {
  std::vector<std::string> failures;
  const std::string name = "label " + labelName(label.label) + ": ";
  const bool limited =
      limits.minDice > 0.0 || limits.maxHd95Mm > 0.0 || limits.maxVolumePercent > 0.0;
  if (limited && label.inOneOnly()) return {name + missing(label)};
  if (label.dice < limits.minDice) {
    failures.push_back(name + "Dice " + fixed(label.dice, 4) + ", under " +
                       fixed(limits.minDice, 4));
  }
  if (limits.maxHd95Mm > 0.0 && label.hausdorff95Mm > limits.maxHd95Mm) {
    failures.push_back(name + "HD95 " + fixed(label.hausdorff95Mm, 2) + " mm, over " +
                       fixed(limits.maxHd95Mm, 2) + " mm");
  }
  const double volume = percent(label);
  if (limits.maxVolumePercent > 0.0 && std::abs(volume) > limits.maxVolumePercent) {
    failures.push_back(name + "volume " + fixed(volume, 2) + " %, over " +
                       fixed(limits.maxVolumePercent, 2) + " %");
  }
  return failures;
}

void compareLabels(ShapeComparison& comparison, const Progress& progress) {
  const LabelImage first = readLabelVolume(comparison.paths[0], progress.part(0.0, 0.2, "reading"));
  const LabelImage second =
      readLabelVolume(comparison.paths[1], progress.part(0.2, 0.4, "reading"));
  std::vector<std::uint8_t> labels = labelsIn(first);
  const std::vector<std::uint8_t> others = labelsIn(second);
  labels.insert(labels.end(), others.begin(), others.end());
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  if (labels.empty()) {
    throw InvalidInput("neither '" + comparison.paths[0].string() + "' nor '" +
                       comparison.paths[1].string() + "' has a label; there is nothing to compare");
  }
  const Progress part = progress.part(0.4, 1.0, "comparing labels");
  for (std::size_t n = 0; n < labels.size(); ++n) {
    comparison.labels.push_back(agreement(first, second, labels[n]));
    part.report(static_cast<double>(n + 1) / static_cast<double>(labels.size() + 1));
  }
  comparison.labels.push_back(agreement(first, second, labels));
  for (const LabelAgreement& label : comparison.labels) {
    const std::vector<std::string> failures = failuresOf(label, comparison.limits);
    comparison.failures.insert(comparison.failures.end(), failures.begin(), failures.end());
  }
}

void compareSurfaces(ShapeComparison& comparison, const Progress& progress) {
  const TriangleMesh first = readSurface(comparison.paths[0]).mesh;
  const TriangleMesh second = readSurface(comparison.paths[1]).mesh;
  const SurfaceDistance distance = surfaceDistance(first, second, progress);
  comparison.surfaces.push_back(distance);
  const ShapeLimits& limits = comparison.limits;
  if (limits.maxDistanceMm > 0.0 && distance.between.maxMm > limits.maxDistanceMm) {
    comparison.failures.push_back("largest distance " + fixed(distance.between.maxMm, 3) +
                                  " mm, over " + fixed(limits.maxDistanceMm, 3) + " mm");
  }
  if (limits.maxHd95Mm > 0.0 && distance.between.hausdorff95Mm > limits.maxHd95Mm) {
    comparison.failures.push_back("HD95 " + fixed(distance.between.hausdorff95Mm, 3) +
                                  " mm, over " + fixed(limits.maxHd95Mm, 3) + " mm");
  }
  const double volume = percent(distance.firstMl, distance.secondMl);
  if (limits.maxVolumePercent > 0.0 && std::abs(volume) > limits.maxVolumePercent) {
    comparison.failures.push_back("volume " + fixed(volume, 3) + " %, over " +
                                  fixed(limits.maxVolumePercent, 3) + " %");
  }
}

bool isSurface(const std::filesystem::path& path) {
  std::error_code error;
  return isSurfaceFileName(path) && std::filesystem::is_regular_file(path, error) &&
         !isTreeFile(path);
}

}  // namespace

SurfaceDistance surfaceDistance(const TriangleMesh& first, const TriangleMesh& second,
                                const Progress& progress) {
  SurfaceDistance result;
  result.firstMl = millilitres(signedVolumeMm3(first));
  result.secondMl = millilitres(signedVolumeMm3(second));
  std::vector<double> there = distances(first, second);
  progress.report(0.5);
  std::vector<double> back = distances(second, first);
  progress.report(1.0);
  result.between = summaryOf(std::move(there), std::move(back));
  return result;
}

bool areShapes(const std::filesystem::path& first, const std::filesystem::path& second) {
  return (isVolumeFileName(first) && isVolumeFileName(second)) ||
         (isSurface(first) && isSurface(second));
}

ShapeComparison compareShapes(const std::filesystem::path& first,
                              const std::filesystem::path& second, const ShapeLimits& limits,
                              const Progress& progress) {
  requireValid(limits);
  ShapeComparison comparison{{first, second}, {}, {}, limits, {}};
  if (isVolumeFileName(first)) {
    compareLabels(comparison, progress);
  } else {
    compareSurfaces(comparison, progress);
  }
  return comparison;
}

Json toJson(const ShapeComparison& comparison, std::span<const InputFile> inputs) {
  Json report = reportEnvelope("pneuma/compare-shapes/1", inputs, toJson(comparison.limits), 0);
  for (const LabelAgreement& label : comparison.labels) {
    report["labels"].push_back({{"label", label.label},
                                {"name", labelName(label.label)},
                                {"first_ml", label.firstMl},
                                {"second_ml", label.secondMl},
                                {"volume_percent", finiteJson(percent(label))},
                                {"dice", label.dice},
                                {"mean_mm", finiteJson(label.meanMm)},
                                {"hd95_mm", finiteJson(label.hausdorff95Mm)}});
  }
  for (const SurfaceDistance& surface : comparison.surfaces) {
    report["surfaces"].push_back(
        {{"first_ml", surface.firstMl},
         {"second_ml", surface.secondMl},
         {"volume_percent", finiteJson(percent(surface.firstMl, surface.secondMl))},
         {"mean_mm", surface.between.meanMm},
         {"hd95_mm", surface.between.hausdorff95Mm},
         {"max_mm", surface.between.maxMm}});
  }
  report["failures"] = comparison.failures;
  return report;
}

std::string textOf(const ShapeComparison& comparison) {
  std::vector<std::vector<std::string>> rows;
  if (!comparison.labels.empty()) {
    rows = {{"label", "first", "second", "difference", "Dice", "mean distance", "HD95"}};
  } else {
    rows = {{"first", "second", "difference", "mean distance", "HD95", "largest"}};
  }
  const auto ml = [](double value) { return fixed(value, 1) + " ml"; };
  const auto figure = [](double value, const char* unit) {
    return std::isfinite(value) ? fixed(value, 2) + unit : "-";
  };
  const auto mm = [&](double value) { return figure(value, " mm"); };
  for (const LabelAgreement& label : comparison.labels) {
    rows.push_back({labelName(label.label), ml(label.firstMl), ml(label.secondMl),
                    label.inOneOnly() ? missing(label) : figure(percent(label), " %"),
                    fixed(label.dice, 4), mm(label.meanMm), mm(label.hausdorff95Mm)});
  }
  for (const SurfaceDistance& surface : comparison.surfaces) {
    rows.push_back({ml(surface.firstMl), ml(surface.secondMl),
                    figure(percent(surface.firstMl, surface.secondMl), " %"),
                    mm(surface.between.meanMm), mm(surface.between.hausdorff95Mm),
                    mm(surface.between.maxMm)});
  }
  return textTable(rows);
}

}  // namespace pneuma
