#include "io/landmark_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

using CoordinateColumns = std::array<std::size_t, 3>;  // columns of x, y and z

constexpr std::array<std::string_view, 2> RestNames = {"exp", "ee"};
constexpr std::array<std::string_view, 3> MovedNames = {"ei_refined", "ei", "insp"};

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> found;
  for (;;) {
    const std::size_t end = line.find(',');
    found.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return found;
    line.remove_prefix(end + 1);
  }
}

/// The columns of the first name that the head has.
std::optional<CoordinateColumns> columnsNamed(const std::vector<std::string_view>& head,
                                              std::span<const std::string_view> names) {
  for (const std::string_view name : names) {
    CoordinateColumns places{};
    bool all = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string wanted = std::string(name) + "_" + "xyz"[axis];
      const auto at = std::ranges::find(head, wanted);
      all = all && at != head.end();
      places[axis] = static_cast<std::size_t>(at - head.begin());
    }
    if (all) return places;
  }
  return std::nullopt;
}

Vec3 placeOf(const std::vector<std::string_view>& values, const CoordinateColumns& places,
             const std::string& where) {
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

}  // namespace

std::vector<LandmarkPair> readLandmarkPairs(const std::filesystem::path& path) {
  const std::string text = readFile(path);
  Lines lines(text);
  const std::string_view first = lines.next().value_or("");
  const std::vector<std::string_view> head = cells(first);
  const std::optional<CoordinateColumns> rest = columnsNamed(head, RestNames);
  const std::optional<CoordinateColumns> moved = columnsNamed(head, MovedNames);
  if (!rest || !moved) {
    throw InvalidInput(quoted(path) +
                       " is no table of landmark pairs: its first line must name the columns "
                       "exp_x, exp_y, exp_z or ee_x ..., and insp_x, insp_y, insp_z or ei_x ...");
  }
  std::vector<LandmarkPair> pairs;
  while (const std::optional<std::string_view> line = lines.next()) {
    if (trimmed(*line).empty()) continue;
    const std::string where = quoted(path) + ", line " + std::to_string(lines.number());
    const std::vector<std::string_view> values = cells(*line);
    if (values.size() != head.size()) {
      throw InvalidInput(where + " has " + std::to_string(values.size()) +
                         " values, the first line names " + std::to_string(head.size()) +
                         " columns; is the file complete?");
    }
    pairs.push_back({placeOf(values, *rest, where), placeOf(values, *moved, where), Side::None});
  }
  if (pairs.empty()) throw InvalidInput(quoted(path) + " holds no landmarks");
  return pairs;
}

}  // namespace pneuma
