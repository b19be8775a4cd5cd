#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "io/detail/dicom_header.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

constexpr double AxialCosine = 0.866;      // normal within 30 degrees of the body's axis
constexpr double LeastCoverageMm = 150.0;  // shorter than any adult's lungs
constexpr double ThinMm = 3.0;

/// 0 soft, 1 unknown, 2 sharp. Makers name kernels as they like: Siemens B30f, Br40 (number = how
/// sharp), GE STANDARD, LUNG, Canon FC08, FC51, Philips A, B, C, L, YA.
int sharpness(const std::string& kernel) {
  const std::string name = lowerCase(trimmed(kernel));
  if (name.empty()) return 1;
  const auto starts = [&](std::string_view word) { return name.starts_with(word); };
  static constexpr std::array<std::string_view, 4> Soft = {"stan", "soft", "detail", "medium"};
  static constexpr std::array<std::string_view, 6> Sharp = {"lung",  "bone",  "edge",
                                                            "sharp", "ultra", "yb"};
  if (std::ranges::any_of(Soft, starts)) return 0;
  if (std::ranges::any_of(Sharp, starts)) return 2;
  const auto digit =
      std::ranges::find_if(name, [](unsigned char c) { return std::isdigit(c) != 0; });
  if (digit != name.end()) {
    const std::string letters(name.begin(), digit);
    const int number = std::atoi(&*digit);
    if (letters == "fc") return number < 50 ? 0 : 2;
    if (letters.starts_with('b') || letters.starts_with('i') || letters.starts_with('q') ||
        letters.starts_with('h')) {
      return number < 50 ? 0 : 2;
    }
    return 1;
  }
  if (name == "a" || name == "b" || name == "c") return 0;
  return name == "l" || name == "d" || name == "ya" ? 2 : 1;
}

/// Defined terms of PS3.16, annex L, and what else begins so. Parts that share slices with the
/// lungs (HEART, TSPINE, WHOLEBODY) are not among them.
bool namesAnotherPart(const std::string& bodyPart) {
  static constexpr std::array<std::string_view, 24> Others = {
      "head",   "brain", "skull", "orbit",  "sinus", "jaw",   "mandible", "neck",
      "cspine", "abd",   "liver", "kidney", "pelvi", "hip",   "lspine",   "sspine",
      "lumbar", "femur", "thigh", "knee",   "leg",   "ankle", "foot",     "hand"};
  const std::string part = lowerCase(bodyPart);
  if (part.find("chest") != std::string::npos || part.find("thora") != std::string::npos ||
      part.find("lung") != std::string::npos) {
    return false;
  }
  return std::ranges::any_of(
      Others, [&](std::string_view other) { return part.find(other) != std::string::npos; });
}

std::string mm(double value) { return numberText(std::round(value * 100.0) / 100.0) + " mm"; }

}  // namespace

void rate(DicomSeries& series, const DicomHeader& first) {
  series.rating = 0;
  series.reasons.clear();
  if (series.refusal) {
    series.reasons.push_back(series.refusal->sentence);
    return;
  }
  int points = 1;
  const auto say = [&](bool good, const std::string& yes, const std::string& no) {
    points += good ? 1 : 0;
    series.reasons.push_back(good ? yes : no);
  };
  say(std::abs(first.normal().z()) >= AxialCosine, "axial", "not axial");
  const double coverage = series.check.spacingMm * static_cast<double>(series.geometry.size[2]);
  say(coverage >= LeastCoverageMm, "covers " + mm(coverage),
      "covers only " + mm(coverage) + " along the body");
  say(series.check.spacingMm <= ThinMm, "slices " + mm(series.check.spacingMm) + " apart",
      "slices " + mm(series.check.spacingMm) + " apart, thick");
  const bool sound = series.check.gaps.empty() && series.check.duplicates.empty() &&
                     !series.check.tilted() && !series.check.uneven();
  say(sound, "evenly spaced", "slices missing, doubled, tilted or unevenly spaced");
  series.reasons.push_back(std::to_string(series.slices.size()) + " slices");
  series.reasons.push_back(series.kernel.empty() ? "kernel not stated" : "kernel " + series.kernel);
  series.ofAnotherPart = namesAnotherPart(series.bodyPart);
  if (series.imageType.find("DERIVED") != std::string::npos) {
    --points;
    series.reasons.push_back("derived from other images");
  }
  series.rating = std::clamp(points, 1, 5);
  if (series.ofAnotherPart) {
    series.rating = 0;
    series.reasons.push_back("not the chest, body part stated: " + series.bodyPart);
  }
}

bool betterSeries(const DicomSeries& a, const DicomSeries& b) {
  if (a.rating != b.rating) return a.rating > b.rating;
  if (a.refusal.has_value() != b.refusal.has_value()) return !a.refusal.has_value();
  if (a.slices.size() != b.slices.size()) return a.slices.size() > b.slices.size();
  if (std::abs(a.check.spacingMm - b.check.spacingMm) > 0.01) {
    return a.check.spacingMm < b.check.spacingMm;
  }
  if (sharpness(a.kernel) != sharpness(b.kernel)) return sharpness(a.kernel) < sharpness(b.kernel);
  if (a.number != b.number) return a.number < b.number;
  return a.uid < b.uid;
}

}  // namespace pneuma
