#include "render/camera.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/options.h"
#include "core/units.h"

namespace pneuma {
namespace {

struct NamedView {
  std::string_view name;
  std::string_view letter;
  ViewDirection direction;
};

constexpr std::array<NamedView, 6> NamedViews = {{{"anterior", "a", {0.0, 0.0}},
                                                  {"posterior", "p", {180.0, 0.0}},
                                                  {"left", "l", {90.0, 0.0}},
                                                  {"right", "r", {-90.0, 0.0}},
                                                  {"superior", "s", {0.0, 90.0}},
                                                  {"inferior", "i", {0.0, -90.0}}}};

std::optional<double> numberIn(std::string_view text, double low, double high) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.size() > 1 && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && value >= low && value <= high ? std::optional(value) : std::nullopt;
}

[[noreturn]] void throwUnknownView(std::string_view text) {
  std::vector<std::string_view> names;
  for (const NamedView& view : NamedViews) names.push_back(view.name);
  const std::string_view nearest = nearestWord(text, names);
  throw InvalidOption(
      "view '" + std::string(text) + "' is unknown" +
      (nearest.empty() ? "" : " (did you mean '" + std::string(nearest) + "'?)") +
      "; use anterior, posterior, left, right, superior, inferior, one of A P L R S I, or "
      "AZIMUTH,ELEVATION in degrees such as 30,10 (azimuth -360 to 360, elevation -90 to 90)");
}

}  // namespace

ViewDirection viewDirection(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const NamedView& view : NamedViews) {
    if (lower == view.name || lower == view.letter) return view.direction;
  }
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) throwUnknownView(text);
  const std::optional<double> azimuth = numberIn(text.substr(0, comma), -360.0, 360.0);
  const std::optional<double> elevation = numberIn(text.substr(comma + 1), -90.0, 90.0);
  if (!azimuth.has_value() || !elevation.has_value()) throwUnknownView(text);
  return {*azimuth, *elevation};
}

ViewAxes axesOf(ViewDirection direction) {
  const double az = radians(direction.azimuthDeg);
  const double el = radians(direction.elevationDeg);
  const Vec3 towardsEye(std::sin(az) * std::cos(el), -std::cos(az) * std::cos(el), std::sin(el));
  const Vec3 up(-std::sin(az) * std::sin(el), std::cos(az) * std::sin(el), std::cos(el));
  return {up.cross(towardsEye), up, towardsEye};
}

ViewDirection viewDirectionOf(const Vec3& towardsEye, const Vec3& up) {
  const double elevation = std::asin(std::clamp(towardsEye.z(), -1.0, 1.0));
  // From straight above or below the azimuth shows in the up vector alone.
  const bool steep = std::hypot(towardsEye.x(), towardsEye.y()) < 1e-6;
  const Vec3 level = steep ? Vec3(up * (towardsEye.z() > 0.0 ? -1.0 : 1.0)) : towardsEye;
  return {degrees(std::atan2(level.x(), -level.y())), degrees(elevation)};
}

std::string orientationLetters(const Vec3& direction) {
  constexpr double Noticeable = 0.30;  // a tilt below 17 degrees is not worth a letter
  std::vector<std::pair<double, char>> sides = {
      {std::abs(direction.x()), direction.x() > 0.0 ? 'L' : 'R'},
      {std::abs(direction.y()), direction.y() > 0.0 ? 'P' : 'A'},
      {std::abs(direction.z()), direction.z() > 0.0 ? 'S' : 'I'}};
  std::stable_sort(sides.begin(), sides.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string letters;
  for (const auto& [share, letter] : sides) {
    if (share > Noticeable && letters.size() < 2) letters += letter;
  }
  return letters;
}

CameraPose framed(std::span<const Vec3> points, ViewDirection direction, int width, int height,
                  const Insets& insets) {
  const ViewAxes axes = axesOf(direction);
  CameraPose pose;
  pose.up = axes.up;
  if (points.empty()) {
    pose.eye = 1000.0 * axes.towardsEye;
    return pose;
  }
  // Slopes of the four planes through the eye that bound what is left for the organ.
  const double slope = std::tan(radians(0.5 * ViewAngleDeg));
  const double perPixel = 2.0 * slope / height;
  const double left = (0.5 * width - insets.left) * perPixel;
  const double right = (0.5 * width - insets.right) * perPixel;
  const double bottom = (0.5 * height - insets.bottom) * perPixel;
  const double top = (0.5 * height - insets.top) * perPixel;
  // A point (x, y, z) in view axes lies left of the right plane of an eye at (ex, ey, ez) if
  // x - ex <= (ez - z) right, that is x + z right <= ex + ez right. So one maximum over the points
  // per plane says how far the eye must stand back.
  double maxRight = -std::numeric_limits<double>::infinity();
  double maxLeft = maxRight;
  double maxTop = maxRight;
  double maxBottom = maxRight;
  double near = maxRight;
  double far = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) {
    const double x = p.dot(axes.right);
    const double y = p.dot(axes.up);
    const double z = p.dot(axes.towardsEye);
    maxRight = std::max(maxRight, x + z * right);
    maxLeft = std::max(maxLeft, -x + z * left);
    maxTop = std::max(maxTop, y + z * top);
    maxBottom = std::max(maxBottom, -y + z * bottom);
    near = std::max(near, z);
    far = std::min(far, z);
  }
  const double z = std::max(
      {(maxRight + maxLeft) / (right + left), (maxTop + maxBottom) / (top + bottom), near + 1.0});
  const double x = 0.5 * ((maxRight - z * right) - (maxLeft - z * left));
  const double y = 0.5 * ((maxTop - z * top) - (maxBottom - z * bottom));
  pose.eye = x * axes.right + y * axes.up + z * axes.towardsEye;
  pose.focus = pose.eye + (0.5 * (near + far) - z) * axes.towardsEye;
  return pose;
}

}  // namespace pneuma
