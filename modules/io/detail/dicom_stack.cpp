#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "io/detail/dicom_header.h"

namespace pneuma {
namespace {

constexpr double SamePlaceMm = 0.01;   // slices closer than this stand in one place
constexpr double GapInSpacings = 1.5;  // a step as long as this leaves out a slice

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2.0;
}

}  // namespace

int SeriesCheck::missing() const {
  int sum = 0;
  for (const SliceGap& gap : gaps) sum += gap.missing;
  return sum;
}

SeriesCheck checkedStack(const std::vector<DicomSlice>& slices, const Vec3& normal) {
  SeriesCheck check;
  std::vector<std::size_t> places;  // one slice of each place
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const bool same =
        !places.empty() &&
        (slices[i].position - slices[places.back()].position).dot(normal) < SamePlaceMm;
    if (same) {
      check.duplicates.push_back(i);
    } else {
      places.push_back(i);
    }
  }
  if (places.size() < 2) return check;
  std::vector<double> steps;
  for (std::size_t p = 1; p < places.size(); ++p) {
    steps.push_back((slices[places[p]].position - slices[places[p - 1]].position).dot(normal));
  }
  check.spacingMm = median(steps);
  const Vec3 first = slices[places.front()].position;
  const Vec3 axis = slices[places.back()].position - first;
  check.tiltDeg = degrees(angleBetween(axis, normal));
  for (std::size_t p = 0; p < places.size(); ++p) {
    const Vec3 way = slices[places[p]].position - first;
    // Where the axis crosses the plane of this slice.
    const Vec3 expected = axis * (way.dot(normal) / axis.dot(normal));
    check.sidewaysMm = std::max(check.sidewaysMm, (way - expected).norm());
    if (p == 0) continue;
    const double step = steps[p - 1];
    if (step < GapInSpacings * check.spacingMm) {
      check.unevenMm = std::max(check.unevenMm, std::abs(step - check.spacingMm));
      continue;
    }
    SliceGap gap;
    gap.below = places[p - 1];
    gap.above = places[p];
    const double count = std::max(1.0, std::round(step / check.spacingMm) - 1.0);
    gap.missing = static_cast<int>(std::min(count, 1e6));
    const Vec3 from = slices[places[p - 1]].position;
    const Vec3 to = slices[places[p]].position;
    for (int m = 1; m <= std::min(gap.missing, 1000); ++m) {
      gap.where.push_back(from + (to - from) * (m / (gap.missing + 1.0)));
    }
    check.gaps.push_back(gap);
  }
  return check;
}

}  // namespace pneuma
