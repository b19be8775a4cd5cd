#include "segmentation/sheet_peak.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.h"

namespace pneuma {
namespace {

constexpr double StepMm = 0.25;
constexpr double PatchMm = 2.5;
constexpr int PlacesAcross = 3;
constexpr double LeastShare = 2.0 / 3.0;  ///< of the places, that agree
constexpr std::size_t LeastMeasured = 5;  ///< places

using Profile = std::vector<double>;

bool isPeak(const Profile& profile, std::size_t at) {
  return at > 0 && at + 1 < profile.size() && profile[at] >= profile[at - 1] &&
         profile[at] > profile[at + 1];
}

/// Where the parabola through a peak and its neighbours is highest, steps from the peak.
double vertexOf(const Profile& profile, std::size_t at) {
  const double bend = profile[at - 1] - 2.0 * profile[at] + profile[at + 1];
  return bend < 0.0 ? 0.5 * (profile[at - 1] - profile[at + 1]) / bend : 0.0;
}

/// Whether one place has a sheet of its own within so many steps.
bool agrees(const Profile& profile, std::size_t at, std::size_t steps, double least) {
  const std::size_t from = at - std::min(at, steps);
  for (std::size_t n = from; n < profile.size() && n <= at + steps; ++n) {
    if (profile[n] >= least && isPeak(profile, n)) return true;
  }
  return false;
}

}  // namespace

std::optional<double> coherentSheet(const SheetSampler& sheets, const Vec3& p, const Vec3& normal,
                                    const SheetSearch& search) {
  const double cosine = std::cos(radians(search.angleDeg));
  const auto half = static_cast<int>(std::lround(search.reachMm / StepMm)) + 1;
  const auto coherence = static_cast<std::size_t>(std::lround(search.coherenceMm / StepMm));
  const auto count = static_cast<std::size_t>(2 * half + 1);
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  std::vector<Profile> profiles;
  Profile mean(count, 0.0);
  for (int a = 0; a < PlacesAcross; ++a) {
    for (int b = 0; b < PlacesAcross; ++b) {
      const Vec3 place = p + PatchMm * ((a - 1) * u + (b - 1) * v);
      if (!sheets.isMeasured(place)) continue;
      Profile profile(count);
      for (std::size_t n = 0; n < count; ++n) {
        const double away = StepMm * (static_cast<double>(n) - half);
        profile[n] = sheets.strength(place + away * normal, normal, cosine);
        mean[n] += profile[n];
      }
      profiles.push_back(std::move(profile));
    }
  }
  if (profiles.size() < LeastMeasured) return std::nullopt;
  const auto measured = static_cast<double>(profiles.size());
  double strongest = search.leastStrength * measured;
  std::optional<std::size_t> found;
  for (std::size_t n = 1; n + 1 < count; ++n) {
    if (!isPeak(mean, n) || mean[n] < strongest) continue;
    const auto agreeing = std::ranges::count_if(profiles, [&](const Profile& profile) {
      return agrees(profile, n, coherence, search.leastStrength);
    });
    if (static_cast<double>(agreeing) < LeastShare * measured) continue;
    strongest = mean[n];
    found = n;
  }
  if (!found) return std::nullopt;
  return StepMm * (static_cast<double>(*found) - half + vertexOf(mean, *found));
}

}  // namespace pneuma
