#include "io/detail/nrrd_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "io/detail/text_fields.h"
#include "io/detail/volume_fields.h"

namespace pneuma {
namespace {

constexpr double Absent = std::numeric_limits<double>::quiet_NaN();

/// What the header says of one axis of the array, also of one that is none of space.
struct Axis {
  std::int64_t size = 0;
  std::optional<Vec3> step;  ///< in the file's frame and unit; none for "none"
  double spacing = Absent;
  double low = Absent;  ///< axis min
  bool cell = true;     ///< the samples stand in the middle of cells, not at their corners
};

std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::string_view word = takeWord(text); !word.empty(); word = takeWord(text)) {
    words.push_back(word);
  }
  return words;
}

InvalidInput wrongCount(const std::string& field, const HeaderFields& fields, std::size_t axes,
                        const std::string& name) {
  return InvalidInput(name + " has \"" + field + ": \" " + excerpt(fields[field]) +
                      ", but it needs a value for each of its " + std::to_string(axes) +
                      " axes; its header is damaged: get it anew");
}

/// "(1,0,0)" at the beginning of `text`, which is taken off. @throws InvalidInput
Vec3 takeVector(std::string_view& text, const std::string& field, const std::string& name) {
  const std::size_t end = text.find(')');
  if (!text.starts_with('(') || end == std::string_view::npos) {
    throw InvalidInput(name + " has " + excerpt(text) + " in its " + field +
                       "; a vector like (1,0,0) was expected: get it anew");
  }
  std::string numbers(text.substr(1, end - 1));
  std::ranges::replace(numbers, ',', ' ');
  text.remove_prefix(end + 1);
  text = trimmed(text);
  const std::vector<double> values = numbersOf(numbers, 3, field, name);
  return {values[0], values[1], values[2]};
}

void readDirections(const HeaderFields& fields, std::vector<Axis>& axes, const std::string& name) {
  const std::string field = "space directions";
  if (!fields.has(field)) return;
  std::string_view rest = fields[field];
  for (Axis& axis : axes) {
    if (rest.empty()) throw wrongCount(field, fields, axes.size(), name);
    if (rest.starts_with("none")) {
      rest = trimmed(rest.substr(4));
    } else {
      axis.step = takeVector(rest, field, name);
    }
  }
  if (!rest.empty()) throw wrongCount(field, fields, axes.size(), name);
}

void readNumbers(const HeaderFields& fields, const std::string& field, std::vector<Axis>& axes,
                 double Axis::*member, const std::string& name) {
  if (!fields.has(field)) return;
  const std::vector<double> numbers = numbersOf(fields[field], axes.size(), field, name);
  for (std::size_t i = 0; i < axes.size(); ++i) axes[i].*member = numbers[i];
}

void refuseOtherKinds(const HeaderFields& fields, const std::vector<Axis>& axes,
                      const std::string& name) {
  if (!fields.has("kinds")) return;
  const std::vector<std::string_view> kinds = wordsOf(fields["kinds"]);
  if (kinds.size() != axes.size()) throw wrongCount("kinds", fields, axes.size(), name);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::string kind = lowerCase(kinds[i]);
    const bool ofSpace = kind == "domain" || kind == "space" || kind == "???" || kind == "none";
    if (ofSpace || axes[i].size == 1) continue;
    throw Unsupported(name + " has " + std::to_string(axes[i].size) +
                      " values to a voxel (an axis of kind " + excerpt(kinds[i]) +
                      "); export one volume of them");
  }
}

std::vector<Axis> axesOf(const HeaderFields& fields, const std::string& name) {
  const std::int64_t dimension = wholeNumberOf(fields["dimension"], "dimension", name);
  if (dimension < 1 || dimension > 16) {
    throw InvalidInput(name + " has dimension = " + std::to_string(dimension) +
                       "; a volume has 3: get it anew");
  }
  std::vector<Axis> axes(static_cast<std::size_t>(dimension));
  const std::vector<std::string_view> sizes = wordsOf(fields["sizes"]);
  if (sizes.size() != axes.size()) throw wrongCount("sizes", fields, axes.size(), name);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    axes[i].size = wholeNumberOf(sizes[i], "sizes", name);
  }
  refuseOtherKinds(fields, axes, name);
  readDirections(fields, axes, name);
  readNumbers(fields, "spacings", axes, &Axis::spacing, name);
  readNumbers(fields, "axis mins", axes, &Axis::low, name);
  const std::vector<std::string_view> centres = wordsOf(fields["centerings"]);
  for (std::size_t i = 0; i < std::min(centres.size(), axes.size()); ++i) {
    axes[i].cell = lowerCase(centres[i]) != "node";
  }
  return axes;
}

/// The three axes of space; others of one sample are left out.
std::vector<Axis> spatialAxes(std::vector<Axis> axes, const std::string& name) {
  const bool directed = std::ranges::any_of(axes, [](const Axis& a) { return a.step.has_value(); });
  for (auto axis = axes.begin(); axis != axes.end() && axes.size() > 3;) {
    const bool spare = axis->size == 1 && !(directed && axis->step.has_value());
    axis = spare ? axes.erase(axis) : axis + 1;
  }
  std::vector<std::int64_t> sizes;
  for (const Axis& axis : axes) sizes.push_back(axis.size);
  checkedSize(sizes, name);
  axes.resize(3);
  return axes;
}

/// Turns the file's frame into LPS. @throws Unsupported
Mat3 lpsFromSpace(const HeaderFields& fields, VolumeHeader& header, const std::string& name) {
  header.space = fields["space"];
  const std::string space = lowerCase(fields["space"]);
  if (space == "left-posterior-superior" || space == "lps") return Mat3::Identity();
  if (space == "right-anterior-superior" || space == "ras")
    return turnedRound(Mat3(Mat3::Identity()));
  if (space == "left-anterior-superior" || space == "las") {
    return Vec3(1.0, -1.0, 1.0).asDiagonal().toDenseMatrix();
  }
  if (space.ends_with("-time") || space == "rast" || space == "last" || space == "lpst") {
    throw Unsupported(name + " is a volume over time (space " + excerpt(header.space) +
                      "); export one volume of it");
  }
  if (space == "3d-right-handed" || space == "scanner-xyz" || space.empty()) {
    header.notes.push_back(
        name +
        (space.empty() ? " does not name its space" : " has the space " + excerpt(header.space)) +
        ", which does not tell how the patient lies: it was taken for "
        "left-posterior-superior, so left and right may be swapped.");
    return Mat3::Identity();
  }
  throw Unsupported(name + " has the space " + excerpt(header.space) +
                    ", in which left and right cannot be told; save it as left-posterior-superior");
}

/// Millimetres in the unit of the frame or of the axes.
double mmPerUnit(const HeaderFields& fields, const std::string& name) {
  const std::string_view text = fields.firstOf({"space units", "units"});
  double mm = 0.0;
  for (std::size_t open = text.find('"'); open != std::string_view::npos;) {
    const std::size_t close = text.find('"', open + 1);
    if (close == std::string_view::npos) break;
    const std::string_view unit = trimmed(text.substr(open + 1, close - open - 1));
    open = text.find('"', close + 1);
    if (unit.empty() || unit == "???") continue;
    const double next = mmPer(unit, name);
    if (mm != 0.0 && next != mm) {
      throw Unsupported(name + " measures its axes in different units; give all in mm");
    }
    mm = next;
  }
  return mm == 0.0 ? 1.0 : mm;
}

/// For files without space directions.
void assumeDirections(std::vector<Axis>& axes, VolumeHeader& header, const std::string& name) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (std::isnan(axes[i].spacing)) {
      throw InvalidInput(name +
                         " does not say how far its voxels lie apart; add \"space "
                         "directions\" or \"spacings\" to its header");
    }
    axes[i].step = axes[i].spacing * Vec3::Unit(static_cast<Eigen::Index>(i));
  }
  requirePositive({axes[0].spacing, axes[1].spacing, axes[2].spacing}, name);
  header.notes.push_back(name +
                         " has no space directions: its axes were taken to run along those "
                         "of its space.");
}

Vec3 originOf(const HeaderFields& fields, const std::vector<Axis>& axes, VolumeHeader& header,
              const std::string& name) {
  if (fields.has("space origin")) {
    std::string_view text = fields["space origin"];
    const Vec3 origin = takeVector(text, "space origin", name);
    if (text.empty()) return origin;
    throw InvalidInput(name + " has more than one vector as its space origin; correct the header");
  }
  Vec3 origin = Vec3::Zero();
  bool known = true;
  for (const Axis& axis : axes) {
    known = known && std::isfinite(axis.low);
    if (known)
      origin += axis.step->normalized() * (axis.low + (axis.cell ? 0.5 : 0.0) * axis.step->norm());
  }
  if (known) return origin;
  header.notes.push_back(name + " has no space origin: its first voxel was put at the origin.");
  return Vec3::Zero();
}

}  // namespace

void readNrrdGeometry(const HeaderFields& fields, VolumeHeader& header, const std::string& name) {
  std::vector<Axis> axes = spatialAxes(axesOf(fields, name), name);
  const Mat3 lpsFromFile = lpsFromSpace(fields, header, name) * mmPerUnit(fields, name);
  const auto hasStep = [](const Axis& axis) { return axis.step.has_value(); };
  if (std::ranges::none_of(axes, hasStep)) {
    assumeDirections(axes, header, name);
  } else if (!std::ranges::all_of(axes, hasStep)) {
    throw Unsupported(name +
                      " has several values to a voxel (an axis without direction); export "
                      "one volume of them");
  }
  const Vec3 origin = originOf(fields, axes, header, name);
  Mat3 steps;
  std::array<int, 3> size{};
  for (std::size_t i = 0; i < 3; ++i) {
    steps.col(static_cast<Eigen::Index>(i)) = *axes[i].step;
    size[i] = static_cast<int>(axes[i].size);
  }
  header.geometry = checkedGeometry(size, lpsFromFile * steps, lpsFromFile * origin, name);
}

}  // namespace pneuma
