#include "io/detail/volume_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "core/error.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

/// Sine of the smallest angle between an axis and the plane of the others that is still a volume:
/// 0.6 degrees. A gantry tilts by 30 degrees at most.
constexpr double LeastSine = 0.01;

/// What lies between the finest picture of a piece of lung and the thickest slices, mm. The limits
/// may be missed by what single precision loses.
constexpr double LeastSpacing = 0.01 * (1.0 - 1e-6);
constexpr double MostSpacing = 100.0 * (1.0 + 1e-6);

/// Of the first voxel from the origin: an absurd one leaves no digits for millimetres.
constexpr double FarthestMm = 1e5;

/// More voxels than any scanner makes, few enough for sums of bytes never to overflow.
constexpr double MostVoxels = 1e12;

std::string timesText(std::span<const std::int64_t> sizes) {
  std::string text;
  for (const std::int64_t size : sizes) {
    if (!text.empty()) text += " x ";
    appendNumber(text, size);
  }
  return text;
}

std::string spacingText(const Vec3& spacing) {
  return numberText(spacing.x()) + ", " + numberText(spacing.y()) + " and " +
         numberText(spacing.z());
}

}  // namespace

std::string excerpt(std::string_view text) {
  constexpr std::size_t Longest = 60;
  std::string shown = "\"";
  for (const char c : text.substr(0, Longest)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown += text.size() > Longest ? "...\"" : "\"";
}

std::vector<double> numbersOf(std::string_view text, std::size_t count, const std::string& field,
                              const std::string& name) {
  std::vector<double> numbers;
  bool sound = true;
  std::string_view rest = text;
  for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
    const std::optional<double> number = parseDouble(word);
    sound = sound && number.has_value();
    numbers.push_back(number.value_or(0.0));
  }
  if (!sound || numbers.size() != count) {
    throw InvalidInput(name + " has " + field + " = " + excerpt(trimmed(text)) + "; it needs " +
                       std::to_string(count) + (count == 1 ? " number" : " numbers") +
                       ": correct the header or get the file anew");
  }
  return numbers;
}

std::int64_t wholeNumberOf(std::string_view text, const std::string& field,
                           const std::string& name) {
  const std::optional<std::int64_t> number = parseInteger(text);
  if (!number.has_value()) {
    throw InvalidInput(name + " has " + field + " = " + excerpt(trimmed(text)) +
                       "; it needs a whole number: correct the header or get the file anew");
  }
  return *number;
}

std::array<int, 3> checkedSize(std::span<const std::int64_t> sizes, const std::string& name) {
  double voxels = 1.0;
  for (const std::int64_t size : sizes) {
    if (size < 1) {
      throw InvalidInput(name + " says it has " + timesText(sizes) +
                         " voxels; every axis needs some: get the file anew");
    }
    voxels *= static_cast<double>(size);
  }
  if (voxels > MostVoxels || std::ranges::max(sizes) > std::numeric_limits<int>::max()) {
    throw InvalidInput(name + " says it has " + timesText(sizes) +
                       " voxels, more than any scanner makes; its header is damaged, or it is not "
                       "the right file");
  }
  if (sizes.size() < 3) {
    throw Unsupported(name + " is a picture of " + timesText(sizes) +
                      " pixels; give a volume with many slices");
  }
  if (std::any_of(sizes.begin() + 3, sizes.end(), [](std::int64_t n) { return n > 1; })) {
    throw Unsupported(name + " has " + timesText(sizes) +
                      " values, several to a voxel (4-D or vectors); export one volume of them");
  }
  if (std::any_of(sizes.begin(), sizes.begin() + 3, [](std::int64_t n) { return n == 1; })) {
    throw Unsupported(name + " is a single slice of " + timesText(sizes.first(3)) +
                      " voxels; give the whole volume");
  }
  return {static_cast<int>(sizes[0]), static_cast<int>(sizes[1]), static_cast<int>(sizes[2])};
}

void requirePositive(const Vec3& spacing, const std::string& name) {
  if (spacing.allFinite() && (spacing.array() > 0.0).all()) return;
  throw InvalidInput(name + " says its voxels lie " + spacingText(spacing) +
                     " mm apart; these must be positive numbers: correct the header");
}

ImageGeometry checkedGeometry(const std::array<int, 3>& size, const Mat3& steps, const Vec3& origin,
                              const std::string& name) {
  if (!steps.allFinite() || !origin.allFinite()) {
    throw InvalidInput(name + " has a position or direction that is no number; get it anew");
  }
  if (origin.cwiseAbs().maxCoeff() > FarthestMm) {
    throw InvalidInput(name + " says it begins more than 100 m away from the scanner's middle; " +
                       "correct the position in its header");
  }
  ImageGeometry geometry;
  geometry.size = size;
  geometry.origin = origin;
  geometry.spacing = steps.colwise().norm();
  requirePositive(geometry.spacing, name);
  if (geometry.spacing.minCoeff() < LeastSpacing || geometry.spacing.maxCoeff() > MostSpacing) {
    throw InvalidInput(name + " says its voxels lie " + spacingText(geometry.spacing) +
                       " mm apart, not 0.01 to 100 mm; correct the spacing or its unit in the "
                       "header");
  }
  geometry.direction = steps * geometry.spacing.cwiseInverse().asDiagonal();
  if (!(std::abs(geometry.direction.determinant()) >= LeastSine)) {
    throw InvalidInput(name +
                       " has axes that lie in one plane, so that no voxel has a place of its own; "
                       "correct the directions in its header");
  }
  return geometry;
}

double mmPer(std::string_view unit, const std::string& name) {
  const std::string text = lowerCase(trimmed(unit));
  if (text == "mm" || text == "millimeter" || text == "millimeters") return 1.0;
  if (text == "cm") return 10.0;
  if (text == "m" || text == "meter" || text == "meters") return 1000.0;
  if (text == "um" || text == "\xc2\xb5m" || text == "\xce\xbcm" || text == "micron" ||
      text == "microns") {
    return 1e-3;
  }
  throw Unsupported(name + " measures in " + excerpt(unit) + "; give it in mm, cm, m or um");
}

std::filesystem::path detachedFile(const std::filesystem::path& header, std::string_view named) {
  const std::string_view file = trimmed(named);
  const std::string name = quoted(header);
  if (file.empty()) {
    throw InvalidInput(name + " does not name the file of its voxels; get it anew");
  }
  if (file == "LIST" || file.starts_with("LIST ") || file.find('%') != std::string_view::npos) {
    throw Unsupported(name + " has its voxels in several files (" + excerpt(file) +
                      "); save it as one file");
  }
  if (file.find_first_of("/\\") != std::string_view::npos || file == "." || file == ".." ||
      file.find('\0') != std::string_view::npos) {
    throw InvalidInput(name + " names the file of its voxels as " + excerpt(file) +
                       "; only a plain name in the same folder is followed: put it there and "
                       "correct the header");
  }
  std::filesystem::path data = header.parent_path() / file;
  std::error_code ignored;
  if (!std::filesystem::exists(data, ignored)) {
    throw InputMissing(name + " has its voxels in " + quoted(data) +
                       ", which is not there; put it beside the header");
  }
  return data;
}

}  // namespace pneuma
