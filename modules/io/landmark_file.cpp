#include "io/landmark_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

using CoordinateColumns = std::array<std::size_t, 3>;  // columns of x, y and z
using Cells = std::vector<std::string_view>;

constexpr std::array<std::string_view, 2> RestNames = {"exp", "ee"};
constexpr std::array<std::string_view, 3> MovedNames = {"ei_refined", "ei", "insp"};
constexpr CoordinateColumns FirstThree = {0, 1, 2};
constexpr CoordinateColumns LastThree = {3, 4, 5};

/// By commas where there are some, else by blanks.
Cells cells(std::string_view line) {
  Cells found;
  if (line.find(',') == std::string_view::npos) {
    for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
      found.push_back(word);
    }
    return found;
  }
  for (;;) {
    const std::size_t end = line.find(',');
    found.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return found;
    line.remove_prefix(end + 1);
  }
}

/// The columns of the first name that the head has.
std::optional<CoordinateColumns> columnsNamed(const Cells& head,
                                              std::span<const std::string_view> names,
                                              std::string_view axes) {
  for (const std::string_view name : names) {
    CoordinateColumns places{};
    bool all = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string wanted = std::string(name) + "_" + axes[axis];
      const auto at = std::ranges::find(head, wanted);
      all = all && at != head.end();
      places[axis] = static_cast<std::size_t>(at - head.begin());
    }
    if (all) return places;
  }
  return std::nullopt;
}

Vec3 placeOf(const Cells& values, const CoordinateColumns& places, const std::string& where) {
  Vec3 place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view text = values[places[axis]];
    const std::optional<double> value = parseDouble(text);
    if (!value || !std::isfinite(*value)) {
      throw InvalidInput(where + " has no number where a coordinate belongs: '" +
                         std::string(text) +
                         "'; every landmark needs a place at rest and a moved "
                         "one");
    }
    place[static_cast<Eigen::Index>(axis)] = *value;
  }
  return place;
}

/// Lines of numbers, some columns of which are places.
struct PlaceTable {
  std::string name;                         ///< of the file, in quotation marks
  std::vector<std::size_t> lines;           ///< of each row in the file, from 1
  std::vector<std::array<Vec3, 2>> places;  ///< of the wanted columns, one or two, by row
};

std::string lineOf(const PlaceTable& table, std::size_t row) {
  return table.name + ", line " + std::to_string(table.lines[row]);
}

/// @param wanted columns of the one or two places in a line
/// @param lines of the file behind its head, if it has one
PlaceTable placesIn(const std::filesystem::path& path, Lines lines,
                    std::span<const CoordinateColumns> wanted, std::size_t columns) {
  PlaceTable table{quoted(path), {}, {}};
  while (const std::optional<std::string_view> line = lines.next()) {
    if (trimmed(*line).empty()) continue;
    table.lines.push_back(lines.number());
    const std::string where = lineOf(table, table.lines.size() - 1);
    const Cells values = cells(*line);
    if (values.size() != columns) {
      throw InvalidInput(where + " has " + std::to_string(values.size()) + " values where " +
                         std::to_string(columns) + " belong; is the file complete?");
    }
    std::array<Vec3, 2> places{};
    for (std::size_t n = 0; n < wanted.size(); ++n) places[n] = placeOf(values, wanted[n], where);
    table.places.push_back(places);
  }
  if (table.places.empty()) throw InvalidInput(quoted(path) + " holds no landmarks");
  return table;
}

bool beginsWithNumber(std::string_view line) {
  const Cells values = cells(line);
  return !values.empty() && parseDouble(values.front()).has_value();
}

[[noreturn]] void throwOtherUnit(const std::filesystem::path& path, bool voxels) {
  throw InvalidInput(
      quoted(path) +
      (voxels ? " has columns x, y and z, which are mm, though its landmarks shall be counted in "
                "voxels; name them i, j and k, or leave the volume out"
              : " counts voxels (columns i, j and k); say of which volume"));
}

/// Both places of each landmark in one file.
PlaceTable pairedPlaces(const std::filesystem::path& path, const std::string& text, bool voxels) {
  Lines lines(text);
  const std::string_view first = lines.next().value_or("");
  if (beginsWithNumber(first)) {
    return placesIn(path, Lines(text), std::array{FirstThree, LastThree}, 6);
  }
  const Cells head = cells(first);
  for (const std::string_view axes : {"xyz", "ijk"}) {
    const auto rest = columnsNamed(head, RestNames, axes);
    const auto moved = columnsNamed(head, MovedNames, axes);
    if (!rest || !moved) continue;
    if ((axes == "ijk") != voxels) throwOtherUnit(path, voxels);
    return placesIn(path, lines, std::array{*rest, *moved}, head.size());
  }
  throw InvalidInput(quoted(path) +
                     " is no table of landmark pairs: its first line must name the columns "
                     "exp_x, exp_y, exp_z or ee_x ..., and insp_x, insp_y, insp_z or ei_x ..., or "
                     "every line must hold six numbers");
}

/// One place of each landmark.
PlaceTable singlePlaces(const std::filesystem::path& path, const std::string& text, bool voxels) {
  Lines lines(text);
  const std::string_view first = lines.next().value_or("");
  if (beginsWithNumber(first)) return placesIn(path, Lines(text), std::span(&FirstThree, 1), 3);
  const Cells head = cells(first);
  const bool mm = head == Cells{"x", "y", "z"};
  if (!mm && head != Cells{"i", "j", "k"}) {
    throw InvalidInput(quoted(path) +
                       " is no table of one place of landmarks: it has three numbers in a line, "
                       "or begins with x,y,z or i,j,k");
  }
  if (mm == voxels) throwOtherUnit(path, voxels);
  return placesIn(path, lines, std::span(&FirstThree, 1), 3);
}

/// A counted voxel as a place, mm.
Vec3 placeOfVoxel(const Vec3& counted, const ImageGeometry& scan, int first,
                  const std::string& where) {
  const Vec3 voxel = counted.array() - first;
  for (int axis = 0; axis < 3; ++axis) {
    const int size = scan.size[static_cast<std::size_t>(axis)];
    if (voxel[axis] >= -0.5 && voxel[axis] <= size - 0.5) continue;
    throw InvalidInput(where + ": voxel " + numberText(counted[axis]) +
                       " lies outside of the scan, whose voxels go from " + std::to_string(first) +
                       " to " + std::to_string(size - 1 + first) +
                       " there; is it the landmarks' scan, and is its first voxel " +
                       std::to_string(first) + "?");
  }
  return scan.worldFromVoxel(voxel);
}

}  // namespace

std::vector<LandmarkPair> readLandmarkPairs(const std::filesystem::path& path) {
  return readLandmarkPairs(std::span(&path, 1), std::nullopt);
}

std::vector<LandmarkPair> readLandmarkPairs(std::span<const std::filesystem::path> paths,
                                            const std::optional<LandmarkVoxels>& voxels) {
  constexpr std::size_t Most = 2;
  if (paths.empty() || paths.size() > Most) {
    throw InvalidInput("landmarks are in one file or in two, at rest and moved, but " +
                       std::to_string(paths.size()) + " were given");
  }
  const bool two = paths.size() == Most;
  const std::string text = readFile(paths[0]);
  const PlaceTable rest = two ? singlePlaces(paths[0], text, voxels.has_value())
                              : pairedPlaces(paths[0], text, voxels.has_value());
  std::optional<PlaceTable> other;
  if (two) {
    const std::string movedText = readFile(paths[1]);
    other = singlePlaces(paths[1], movedText, voxels.has_value());
    if (rest.places.size() != other->places.size()) {
      throw InvalidInput(rest.name + " holds " + std::to_string(rest.places.size()) +
                         " landmarks and " + other->name + " " +
                         std::to_string(other->places.size()) + "; each needs both places");
    }
  }
  const PlaceTable& moved = two ? *other : rest;
  std::vector<LandmarkPair> pairs;
  for (std::size_t n = 0; n < rest.places.size(); ++n) {
    LandmarkPair pair{rest.places[n][0], moved.places[n][two ? 0 : 1], Side::None};
    if (voxels) {
      pair.rest = placeOfVoxel(pair.rest, voxels->rest, voxels->first, lineOf(rest, n));
      pair.moved = placeOfVoxel(pair.moved, voxels->moved, voxels->first, lineOf(moved, n));
    }
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace pneuma
