#include "cli/slice_arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pneuma::cli {
namespace {

std::optional<double> numberOf(std::string_view text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || rest != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InvalidOption("--slice '" + text + "': " + why);
}

/// "55mm", "-55mm", "P55mm" ...
std::optional<double> positionOf(std::string_view text, SlicePlane plane) {
  if (!text.ends_with("mm")) return std::nullopt;
  text.remove_suffix(2);
  constexpr std::array<std::string_view, 3> Letters = {"LR", "PA", "SI"};
  const std::string_view letters = Letters[static_cast<std::size_t>(normalAxis(plane))];
  double sign = 1.0;
  if (!text.empty() && letters.find(text.front()) != std::string_view::npos) {
    sign = text.front() == letters[0] ? 1.0 : -1.0;
    text.remove_prefix(1);
  }
  const std::optional<double> number = numberOf(text);
  if (!number) return std::nullopt;
  return sign * *number;
}

WantedSlice wantedSlice(const std::string& text) {
  const std::string_view whole = text;
  const std::size_t colon = whole.find(':');
  const auto names = choices(SlicePlane{});
  const auto name = std::ranges::find(names, whole.substr(0, colon));
  if (name == names.end()) refuse(text, "the plane is axial, coronal or sagittal, or all for each");
  WantedSlice wanted;
  wanted.plane = static_cast<SlicePlane>(name - names.begin());
  if (colon == std::string_view::npos) return wanted;
  const std::string_view place = whole.substr(colon + 1);
  wanted.positionMm = positionOf(place, wanted.plane);
  if (wanted.positionMm) return wanted;
  const std::optional<double> number = numberOf(place);
  if (!number || *number < 1.0 || *number > 1e6 || *number != std::floor(*number)) {
    refuse(text, "behind the colon stands a slice's number from 1, or a position such as 55mm");
  }
  wanted.number = static_cast<int>(*number);
  return wanted;
}

}  // namespace

void addSliceArguments(CLI::App& app, SliceArguments& arguments) {
  addRepeatable(app, "--slice", arguments.slices, "PLANE[:N|:Xmm]",
                "Draw this slice of the CT: axial, coronal or sagittal; the middle one, the N-th "
                "from the feet, the front or the right, or the one at X mm (LPS). May be repeated; "
                "all: one of each, and the 3-D view of surfaces and trees that are given too.");
  app.add_option("--labels", arguments.labels, "Lay these labels over the slices.")
      ->type_name("FILE");
  app.add_option("--window", arguments.window,
                 "What lies between black and white: lung, lung-soft, mediastinum, bone, "
                 "emphysema, or WIDTH/LEVEL in HU.")
      ->type_name("NAME|W/L")
      ->default_str(arguments.window);
  app.add_flag("--outline", arguments.outline, "Draw the labels' borders alone.");
  addRepeatable(app, "--mark", arguments.markers, "X,Y,Z",
                "Ring this point in its slice, mm, LPS. May be repeated.");
}

std::vector<WantedSlice> wantedSlices(const std::vector<std::string>& texts) {
  std::vector<WantedSlice> wanted;
  for (const std::string& text : texts.empty() ? std::vector<std::string>{"all"} : texts) {
    if (text == "all") {
      for (const SlicePlane plane : SlicePlanes) wanted.push_back({plane, {}, {}});
    } else {
      wanted.push_back(wantedSlice(text));
    }
  }
  return wanted;
}

bool wantsScene(const std::vector<std::string>& texts) {
  return texts.empty() || std::ranges::find(texts, "all") != texts.end();
}

double positionMm(const WantedSlice& wanted, const ImageGeometry& geometry) {
  const SliceStack stack = sliceStack(geometry, wanted.plane);
  const int axis = normalAxis(wanted.plane);
  const std::string plane(choices(SlicePlane{})[static_cast<std::size_t>(wanted.plane)]);
  if (wanted.number) {
    if (*wanted.number > stack.count) {
      throw InvalidOption("--slice " + plane + ":" + std::to_string(*wanted.number) +
                          ": the CT has " + std::to_string(stack.count) + " " + plane + " slices");
    }
    return stack.positionMm(*wanted.number - 1);
  }
  if (!wanted.positionMm) return stack.positionMm(stack.count / 2);
  const double low = stack.positionMm(0);
  const double high = stack.positionMm(stack.count - 1);
  if (*wanted.positionMm < low - 0.5 * stack.stepMm ||
      *wanted.positionMm > high + 0.5 * stack.stepMm) {
    throw InvalidOption("--slice " + plane + " at " + positionText(axis, *wanted.positionMm) +
                        ": the CT reaches from " + positionText(axis, low) + " to " +
                        positionText(axis, high));
  }
  return stack.positionMm(stack.nearest(*wanted.positionMm));
}

Vec3 markerPoint(const std::string& text) {
  Vec3 point;
  std::string_view rest = text;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = axis < 2 ? rest.find(',') : std::string_view::npos;
    const std::optional<double> number = numberOf(rest.substr(0, comma));
    if (!number || (axis < 2 && comma == std::string_view::npos)) {
      throw InvalidOption("--mark needs X,Y,Z in mm, but '" + text + "' was given");
    }
    point[axis] = *number;
    if (axis < 2) rest.remove_prefix(comma + 1);
  }
  return point;
}

}  // namespace pneuma::cli
