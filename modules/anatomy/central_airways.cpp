#include "anatomy/central_airways.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "anatomy/diameter_law.h"
#include "anatomy/lobar_bronchi.h"
#include "core/error.h"
#include "core/units.h"

namespace pneuma {
namespace {

std::string listedLobes(std::span<const LobeRegion> lobes, const std::vector<char>& chosen) {
  std::string text;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    if (chosen[i] == 0) continue;
    if (!text.empty()) text += ", ";
    text += longName(lobes[i].lobe);
  }
  return text;
}

class TemplateBuilder {
 public:
  explicit TemplateBuilder(std::span<const LobeRegion> lobes) : lobes_(lobes) {
    for (const LobeRegion& region : lobes) {
      box_.extend(region.domain->bounds());
      centres_.push_back(innerCentre(region));
      sides_[side(region.lobe) == Side::Left ? 1 : 0] = true;
    }
    scale_ = bronchialScale(lobes);
  }

  AirwayTree build() {
    if (lobes_.size() == 1 && side(lobes_[0].lobe) == Side::None) {
      trunkOnly();
    } else {
      bothLungs();
    }
    return std::move(tree_);
  }

 private:
  int add(int parent, const Vec3& from, const Vec3& to, int generation, Lobe lobe) {
    Branch branch;
    branch.parent = parent;
    branch.proximal = from;
    branch.distal = to;
    branch.radiusMm = scale_ * weibelDiameterMm(generation) / 2.0;
    branch.lobe = lobe;
    branch.origin = Origin::Template;
    return tree_.add(std::move(branch));
  }

  /// A way of at least `lengthMm` from `from` towards the lobe's centre that ends inside the lobe.
  void addLobar(int parent, const Vec3& from, std::size_t region, double lengthMm, int generation) {
    // A little further in, so that the first daughters start well inside.
    const Vec3 end =
        lobarEnd(*lobes_[region].domain, from, centres_[region], lengthMm, 3.0 * scale_);
    add(parent, from, end, generation, lobes_[region].lobe);
  }

  void trunkOnly() {
    const Vec3 centre = centres_[0];
    const double height = box_.sizes().z();
    const Vec3 top(centre.x(), centre.y(), box_.max().z() + 0.15 * height);
    addLobar(-1, top, 0, 0.30 * height, 0);
  }

  void bothLungs() {
    // The carina lies between the lungs, two fifths of the way down.
    Box3 right;
    Box3 left;
    for (const LobeRegion& region : lobes_) {
      (side(region.lobe) == Side::Left ? left : right).extend(region.domain->bounds());
    }
    const double gap = 18.0 * scale_;
    const double x = !sides_[1]   ? right.max().x() + gap
                     : !sides_[0] ? left.min().x() - gap
                                  : (right.max().x() + left.min().x()) / 2.0;
    const Vec3 carina(x, box_.center().y(), box_.max().z() - 0.41 * box_.sizes().z());
    const int trachea = add(-1, carina + Vec3(0.0, 0.0, 142.0 * scale_), carina, 0, Lobe::Central);
    if (sides_[0]) oneLung(trachea, carina, Side::Right, 30.0);
    if (sides_[1]) oneLung(trachea, carina, Side::Left, 50.0);
  }

  std::optional<std::size_t> regionOf(Lobe lobe) const {
    const auto found = std::ranges::find_if(lobes_, [&](const auto& r) { return r.lobe == lobe; });
    if (found == lobes_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - lobes_.begin());
  }

  void oneLung(int trachea, const Vec3& carina, Side which, double mainAngleDeg) {
    const double lateral = which == Side::Left ? 1.0 : -1.0;  // LPS: x grows to the left
    const Vec3 mainDirection =
        Vec3(lateral * std::sin(radians(mainAngleDeg)), 0.15, -std::cos(radians(mainAngleDeg)))
            .normalized();
    const Vec3 mainEnd = carina + mainBronchusMm(which) * scale_ * mainDirection;
    const int main = add(trachea, carina, mainEnd, 1, Lobe::Central);

    std::vector<std::size_t> fromMain;
    std::vector<std::size_t> fromIntermediate;
    for (std::size_t i = 0; i < lobes_.size(); ++i) {
      if (side(lobes_[i].lobe) != which) continue;
      const bool below = lobes_[i].lobe == Lobe::RightMiddle || lobes_[i].lobe == Lobe::RightLower;
      (below ? fromIntermediate : fromMain).push_back(i);
    }
    for (const std::size_t region : fromMain) {
      addLobar(main, mainEnd, region, lobarBronchusMm(lobes_[region].lobe) * scale_, 2);
    }
    if (fromIntermediate.size() == 1)
      addLobar(main, mainEnd, fromIntermediate[0], 26.7 * scale_, 2);
    if (fromIntermediate.size() < 2) return;

    Vec3 centre = Vec3::Zero();
    for (const std::size_t region : fromIntermediate) centre += centres_[region];
    centre /= static_cast<double>(fromIntermediate.size());
    const Vec3 aim = (centre - mainEnd).normalized();
    const Vec3 direction = (mainDirection + aim).normalized();
    const Vec3 end = mainEnd + 29.8 * scale_ * direction;
    const int intermediate = add(main, mainEnd, end, 2, Lobe::Central);
    for (const std::size_t region : fromIntermediate) {
      addLobar(intermediate, end, region, lobarBronchusMm(lobes_[region].lobe) * scale_, 3);
    }
  }

  std::span<const LobeRegion> lobes_;
  std::vector<Vec3> centres_;
  Box3 box_;
  std::array<bool, 2> sides_ = {false, false};
  double scale_ = 1.0;
  AirwayTree tree_;
};

}  // namespace

std::vector<Inlet> assignLobes(AirwayTree& central, std::span<const LobeRegion> lobes) {
  const Children children(central);
  std::vector<Inlet> inlets;
  std::vector<char> without(lobes.size(), 1);
  std::vector<std::optional<Lobe>> lobeBelow(central.size());
  for (std::size_t i = central.size(); i-- > 0;) {
    if (children.isTerminal(i)) {
      lobeBelow[i] = Lobe::Central;
      for (std::size_t region = 0; region < lobes.size(); ++region) {
        if (!lobes[region].domain->contains(central[i].distal)) continue;
        inlets.push_back({i, region});
        without[region] = 0;
        lobeBelow[i] = lobes[region].lobe;
        break;
      }
    }
    central.setLobe(i, lobeBelow[i].value_or(Lobe::Central));
    if (central[i].parent < 0) continue;
    std::optional<Lobe>& above = lobeBelow[static_cast<std::size_t>(central[i].parent)];
    if (!above.has_value()) {
      above = lobeBelow[i];
    } else if (above != lobeBelow[i]) {
      above = Lobe::Central;
    }
  }
  if (inlets.empty()) {
    throw InvalidInput(
        "no end of the central airways lies inside any of the lobes; check that both are of the "
        "same person and in the same frame and units (LPS, mm)");
  }
  if (std::ranges::count(without, 1) > 0) {
    throw InvalidInput("no end of the central airways lies inside the " +
                       listedLobes(lobes, without) +
                       "; extend the airways into it, or leave that lobe out");
  }
  std::ranges::reverse(inlets);
  return inlets;
}

AirwayTree templateAirways(std::span<const LobeRegion> lobes) {
  if (lobes.empty()) throw InvalidInput("there is no lobe to make central airways for");
  return TemplateBuilder(lobes).build();
}

}  // namespace pneuma
