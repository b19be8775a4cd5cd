#include "segmentation/trachea.h"

#include <algorithm>
#include <numbers>

namespace pneuma {
namespace {

// What a trachea looks like in a slice, and how much it may change to the next.
constexpr double LeastMm2 = 40.0;
constexpr double MostMm2 = 900.0;
constexpr double MostElongated = 3.0;
constexpr double LeastFill = 0.5;
constexpr double FromMiddleMm = 45.0;
constexpr double StepMm = 5.0;
constexpr double AreaRatio = 1.8;
constexpr double UpperPart = 0.6;  ///< of the slices
constexpr double LeastLengthMm = 20.0;
// The root lies below the larynx, where the section is this small and round.
constexpr double RootMm2 = 450.0;
constexpr double RootFill = 0.65;

/// Every spot that could be a trachea, slice by slice from the top.
std::vector<std::vector<TracheaSection>> candidates(const CtImage& ct, const InnerAir& air) {
  const Vec3& spacing = ct.geometry.spacing;
  const int top = ct.geometry.size[2] - 1;
  const int lowest = static_cast<int>(top * (1.0 - UpperPart));
  std::vector<std::vector<TracheaSection>> bySlice(static_cast<std::size_t>(top - lowest + 1));
  for (std::size_t p = 0; p < air.inSlices.all.size(); ++p) {
    const VoxelComponent& part = air.inSlices.all[p];
    const int k = part.low.z();
    if (k < lowest) continue;
    TracheaSection section;
    section.slice = k;
    section.part = static_cast<std::uint32_t>(p);
    section.centre = part.centre();
    section.areaMm2 = static_cast<double>(part.voxels) * spacing.x() * spacing.y();
    const Vec3 box = (part.high - part.low).cast<double>() + Vec3::Ones();
    const double width = box.x() * spacing.x();
    const double height = box.y() * spacing.y();
    section.fill = section.areaMm2 / (width * height);
    const bool round = width < MostElongated * height && height < MostElongated * width &&
                       section.fill >= LeastFill;
    const bool central = std::abs(section.centre.x() - air.bodyCentre) * spacing.x() < FromMiddleMm;
    if (section.areaMm2 > LeastMm2 && section.areaMm2 < MostMm2 && round && central) {
      bySlice[static_cast<std::size_t>(top - k)].push_back(section);
    }
  }
  return bySlice;
}

bool continues(const TracheaSection& above, const TracheaSection& below, const Vec3& spacing) {
  const Vec3 step = (below.centre - above.centre).cwiseProduct(spacing);
  const double reach = std::max(StepMm, spacing.z());
  const double ratio = below.areaMm2 / above.areaMm2;
  return step.head<2>().norm() <= reach && ratio < AreaRatio && ratio > 1.0 / AreaRatio;
}

}  // namespace

Trachea findTrachea(const CtImage& ct, const InnerAir& air) {
  struct Link {
    double score = 0.0;
    int above = -1;  ///< in the slice above
  };

  const auto bySlice = candidates(ct, air);
  std::vector<std::vector<Link>> links(bySlice.size());
  std::size_t bestSlice = 0;
  int best = -1;
  double bestScore = 0.0;
  for (std::size_t s = 0; s < bySlice.size(); ++s) {
    for (const TracheaSection& section : bySlice[s]) {
      Link link;
      for (std::size_t a = 0; s > 0 && a < bySlice[s - 1].size(); ++a) {
        if (links[s - 1][a].score > link.score &&
            continues(bySlice[s - 1][a], section, ct.geometry.spacing)) {
          link = {links[s - 1][a].score, static_cast<int>(a)};
        }
      }
      // A round section counts a little more, so that bowel of the same length loses.
      link.score += std::min(1.0, section.fill / (std::numbers::pi / 4.0));
      if (link.score > bestScore) {
        bestScore = link.score;
        bestSlice = s;
        best = static_cast<int>(links[s].size());
      }
      links[s].push_back(link);
    }
  }
  Trachea trachea;
  for (std::size_t s = bestSlice; best >= 0; --s) {
    const auto at = static_cast<std::size_t>(best);
    trachea.sections.push_back(bySlice[s][at]);
    best = links[s][at].above;
  }
  std::reverse(trachea.sections.begin(), trachea.sections.end());
  if (trachea.lengthMm(ct.geometry) < LeastLengthMm) return {};
  const auto root =
      std::find_if(trachea.sections.begin(), trachea.sections.end(),
                   [](const auto& s) { return s.areaMm2 <= RootMm2 && s.fill >= RootFill; });
  if (root != trachea.sections.end()) {
    trachea.root = static_cast<std::size_t>(root - trachea.sections.begin());
  }
  return trachea;
}

}  // namespace pneuma
