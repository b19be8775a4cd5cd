#include "pipeline/stiffness_region.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/nearest_triangle.h"

namespace pneuma {
namespace {

constexpr double RimMm = 10.0;

double numberOf(std::string_view text, std::string_view whole) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) {
    return value;
  }
  throw InvalidOption("'" + std::string(text) + "' in the region '" + std::string(whole) +
                      "' is no number");
}

/// 1 within, 0 from RimMm outside on.
double fading(double outsideMm) {
  const double share = std::clamp(outsideMm / RimMm, 0.0, 1.0);
  return 0.5 * (1.0 + std::cos(std::numbers::pi * share));
}

const LobeSurface& lobeOf(const LungModel& model, Lobe lobe) {
  const auto found = std::ranges::find(*model.surfaces, lobe, &LobeSurface::lobe);
  if (found != model.surfaces->end()) return *found;
  throw InvalidOption("there is no " + std::string(longName(lobe)) +
                      " among these surfaces to be stiffer or softer; give its lobes, as 'pneuma "
                      "lobes' makes them, or a ball");
}

bool isIn(const StiffnessRegion& region, Side of, const LungModel& model) {
  return (region.isBall() ? sideOf(region, model) : side(lobeOf(model, region.lobe).lobe)) == of;
}

}  // namespace

Side sideOf(const StiffnessRegion& ball, const LungModel& model) {
  for (const LobeSurface& surface : *model.surfaces) {
    if (side(surface.lobe) != Side::None && bounds(*surface.mesh).contains(ball.centre)) {
      return side(surface.lobe);
    }
  }
  throw InvalidOption("the ball around " + std::to_string(ball.centre.x()) + ", " +
                      std::to_string(ball.centre.y()) + ", " + std::to_string(ball.centre.z()) +
                      " mm is in no lung; centres are in mm, LPS");
}

StiffnessRegion stiffnessRegion(std::string_view text) {
  const std::size_t equals = text.find('=');
  StiffnessRegion region;
  if (equals == std::string_view::npos) {
    throw InvalidOption("the region '" + std::string(text) +
                        "' says no stiffness; give a lobe or a ball and a factor: LLL=0.5 or "
                        "60,-20,-150,15=5");
  }
  region.factor = numberOf(text.substr(equals + 1), text);
  if (region.factor < LeastStiffness || region.factor > MostStiffness) {
    throw InvalidOption("the region '" + std::string(text) +
                        "' is to be 0.01 to 100 times as stiff as healthy lung");
  }
  std::string_view where = text.substr(0, equals);
  if (const std::optional<Lobe> lobe = lobeOfShortName(where)) {
    region.lobe = *lobe;
    return region;
  }
  std::vector<double> numbers;
  while (!where.empty()) {
    const std::size_t comma = where.find(',');
    numbers.push_back(numberOf(where.substr(0, comma), text));
    where = comma == std::string_view::npos ? std::string_view() : where.substr(comma + 1);
  }
  if (numbers.size() != 4 || !(numbers[3] > 0.0)) {
    throw InvalidOption("the region '" + std::string(text) +
                        "' is neither a lobe (RUL, RML, RLL, LUL, LLL) nor a ball: X,Y,Z and a "
                        "radius above 0, mm");
  }
  region.centre = {numbers[0], numbers[1], numbers[2]};
  region.radiusMm = numbers[3];
  return region;
}

std::vector<double> stiffnessAt(std::span<const Vec3> points, Side of, const LungModel& model,
                                std::span<const StiffnessRegion> regions) {
  std::vector<double> stiffness;
  for (const StiffnessRegion& region : regions) {
    if (!isIn(region, of, model)) continue;
    if (stiffness.empty()) stiffness.assign(points.size(), 1.0);
    std::unique_ptr<const NearestTriangle> lobe;
    if (!region.isBall())
      lobe = std::make_unique<NearestTriangle>(*lobeOf(model, region.lobe).mesh);
    parallelFor(points.size(), [&](std::size_t n) {
      const double outside =
          lobe ? lobe->distanceMm(points[n]) : (points[n] - region.centre).norm() - region.radiusMm;
      // Factors fade as powers: half of 4 times as stiff is twice as stiff.
      stiffness[n] *= std::pow(region.factor, fading(outside));
    });
  }
  return stiffness;
}

double complianceOf(Side of, double lungMm3, const LungModel& model,
                    std::span<const StiffnessRegion> regions) {
  double compliance = 1.0;
  for (const StiffnessRegion& region : regions) {
    if (!isIn(region, of, model)) continue;
    const double mm3 = region.isBall()
                           ? 4.0 / 3.0 * std::numbers::pi * std::pow(region.radiusMm, 3.0)
                           : signedVolumeMm3(*lobeOf(model, region.lobe).mesh);
    compliance += std::min(1.0, mm3 / lungMm3) * (1.0 / region.factor - 1.0);
  }
  return std::max(compliance, 1.0 / MostStiffness);
}

Json toJson(std::span<const StiffnessRegion> regions) {
  Json json = Json::array();
  for (const StiffnessRegion& region : regions) {
    Json entry = {{"factor", region.factor}};
    if (region.isBall()) {
      entry["centre_mm"] = {region.centre.x(), region.centre.y(), region.centre.z()};
      entry["radius_mm"] = region.radiusMm;
    } else {
      entry["lobe"] = shortName(region.lobe);
    }
    json.push_back(std::move(entry));
  }
  return json;
}

}  // namespace pneuma
