#include "pipeline/lobe_preview.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "lobes/height_table.h"
#include "pipeline/detail/surface_contour.h"

namespace pneuma {
namespace {

constexpr std::size_t Block = 4096;   ///< points that a thread takes at once
constexpr std::size_t FewKnots = 40;  ///< with more a table is faster than the formula

std::vector<float> heightsOf(const HeightSurface& surface, const std::vector<Vec3>& points,
                             const Box3& box) {
  std::vector<float> heights(points.size());
  std::optional<HeightTable> table;
  if (surface.knots.size() > FewKnots) table.emplace(surface, box);
  parallelFor((points.size() + Block - 1) / Block, [&](std::size_t block) {
    const std::size_t end = std::min(points.size(), (block + 1) * Block);
    for (std::size_t i = block * Block; i < end; ++i) {
      heights[i] = static_cast<float>(table ? table->height(points[i]) : surface.height(points[i]));
    }
  });
  return heights;
}

/// The value that a share of the others is below.
double quantile(std::vector<float> values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = std::min(static_cast<std::size_t>(share * static_cast<double>(values.size())),
                             values.size() - 1);
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(rank));
  return values[rank];
}

}  // namespace

LobePreview::LobePreview(std::shared_ptr<const LungShape> lung, const FissureSurfaces& fissures)
    : lung_(std::move(lung)),
      oblique_(lung_->side == Side::Right ? Fissure::RightOblique : Fissure::LeftOblique),
      hasHorizontal_(lung_->side == Side::Right) {
  for (const Fissure fissure : fissuresOf(lung_->side)) set(fissure, fissures.at(fissure));
}

void LobePreview::set(Fissure fissure, const HeightSurface& surface) {
  Heights& heights = fissures_[fissure];
  heights.surface = surface;
  heights.ofPoints = std::make_shared<const std::vector<float>>(
      heightsOf(surface, lung_->mesh->points, lung_->extent.bounds));
  heights.inside = heightsOf(surface, lung_->inside, lung_->extent.bounds);
}

void LobePreview::shift(Fissure fissure, double byMm) {
  Heights& heights = fissures_.at(fissure);
  heights.surface.quadratic[0] += byMm;
  const auto by = static_cast<float>(byMm);
  auto ofPoints = std::make_shared<std::vector<float>>(*heights.ofPoints);
  for (float& height : *ofPoints) height -= by;
  heights.ofPoints = std::move(ofPoints);
  for (float& height : heights.inside) height -= by;
}

void LobePreview::moveTo(const LobeShares& shares) {
  shift(oblique_, quantile(fissures_.at(oblique_).inside, shares.back()));
  if (!hasHorizontal_) return;
  const std::vector<float>& oblique = fissures_.at(oblique_).inside;
  const std::vector<float>& all = fissures_.at(Fissure::RightHorizontal).inside;
  std::vector<float> inFront;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (oblique[i] >= 0.0F) inFront.push_back(all[i]);
  }
  shift(Fissure::RightHorizontal,
        quantile(std::move(inFront), shares[1] / (shares[0] + shares[1])));
}

Lobe LobePreview::lobeOf(float oblique, float horizontal) const {
  return lobeBy(side(), oblique < 0.0F, horizontal < 0.0F);
}

Lobe LobePreview::lobeAt(const Vec3& p) const {
  const auto height = [&](Fissure f) { return static_cast<float>(surface(f).height(p)); };
  return lobeOf(height(oblique_), hasHorizontal_ ? height(Fissure::RightHorizontal) : 0.0F);
}

std::vector<Lobe> LobePreview::lobes() const {
  const std::vector<float>& oblique = *heights(oblique_);
  const std::vector<float>* horizontal =
      hasHorizontal_ ? heights(Fissure::RightHorizontal).get() : nullptr;
  std::vector<Lobe> lobes(oblique.size());
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    lobes[i] = lobeOf(oblique[i], horizontal != nullptr ? (*horizontal)[i] : 0.0F);
  }
  return lobes;
}

std::vector<SurfaceLine> LobePreview::contour(Fissure fissure) const {
  const std::vector<SurfaceLine> lines = zeroLines(*lung_->mesh, *heights(fissure));
  if (fissure == oblique_) return lines;
  return above(lines, surface(oblique_));
}

TriangleMesh LobePreview::patch(Fissure fissure, double spacingMm) const {
  const TriangleMesh whole =
      filled(zeroLines(*lung_->mesh, *heights(fissure)), surface(fissure), spacingMm);
  return fissure == oblique_ ? whole : above(whole, surface(oblique_));
}

std::map<Lobe, double> LobePreview::volumesMm3() const {
  std::map<Lobe, double> volumes;
  for (const Lobe lobe : lobesOf(side())) volumes[lobe] = 0.0;
  const std::vector<float>& oblique = fissures_.at(oblique_).inside;
  const std::vector<float>* horizontal =
      hasHorizontal_ ? &fissures_.at(Fissure::RightHorizontal).inside : nullptr;
  const double each = lung_->volumeMm3 / static_cast<double>(oblique.size());
  for (std::size_t i = 0; i < oblique.size(); ++i) {
    volumes[lobeOf(oblique[i], horizontal != nullptr ? (*horizontal)[i] : 0.0F)] += each;
  }
  return volumes;
}

}  // namespace pneuma
