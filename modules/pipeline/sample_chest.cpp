#include "pipeline/sample_chest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "anatomy/diameter_law.h"
#include "core/error.h"
#include "pipeline/detail/lung_lattice.h"
#include "pipeline/sample_lung.h"

namespace pneuma {
namespace {

/// A lobe as its formulas say.
class FormulaLobe : public Domain {
 public:
  FormulaLobe(const SampleLung& shape, Lobe lobe, double volumeMm3)
      : shape_(shape), lobe_(lobe), volumeMm3_(volumeMm3) {}

  bool contains(const Vec3& p) const override { return bounds().contains(p) && level(p) > 0.0; }

  /// A lower bound: the level is 1-Lipschitz in the lung's box.
  double distanceToWall(const Vec3& p) const override {
    const double toBox = bounds().exteriorDistance(p);
    return toBox > 0.0 ? toBox : std::abs(level(p));
  }

  Box3 bounds() const override { return shape_.bounds(); }

  double volumeMm3() const override { return volumeMm3_; }

 private:
  double level(const Vec3& p) const { return levelIn(lobe_, levelsAt(shape_, p)); }

  SampleLung shape_;
  Lobe lobe_;
  double volumeMm3_;
};

/// Central airways with the lengths of Huang 2004 (right) and of Weibel's left main bronchus; each
/// lobar bronchus is aimed at its lobe and ends well inside it.
class CentralAirways {
 public:
  explicit CentralAirways(const SampleChest& chest) : chest_(chest) {}

  AirwayTree build() {
    const int trachea = add(-1, {0.0, 0.0, 120.0}, Vec3::Zero(), 0, Lobe::Central);
    const int rightMain = add(trachea, Vec3::Zero(), {-12.1, 3.6, -20.9}, 1, Lobe::Central);
    addLobar(rightMain, Lobe::RightUpper, 2);
    const int intermediate = add(rightMain, tree_[1].distal, {-34.6, 9.0, -39.7}, 2, Lobe::Central);
    addLobar(intermediate, Lobe::RightMiddle, 3);
    addLobar(intermediate, Lobe::RightLower, 3);
    const int leftMain = add(trachea, Vec3::Zero(), {36.0, 8.0, -30.0}, 1, Lobe::Central);
    addLobar(leftMain, Lobe::LeftUpper, 2);
    addLobar(leftMain, Lobe::LeftLower, 2);
    return std::move(tree_);
  }

 private:
  int add(int parent, const Vec3& from, const Vec3& to, int generation, Lobe lobe) {
    Branch branch;
    branch.parent = parent;
    branch.proximal = from;
    branch.distal = to;
    branch.radiusMm = weibelDiameterMm(generation) / 2.0;
    branch.lobe = lobe;
    branch.origin = Origin::Template;
    return tree_.add(std::move(branch));
  }

  /// Leads from the parent's end towards the lobe's centre of mass, at least as long as a lobar
  /// bronchus is and as far as it takes to be clear of the lobe's wall.
  void addLobar(int parent, Lobe lobe, int generation) {
    constexpr double LeastMm = 15.0;
    constexpr double ClearMm = 3.0;
    const auto index = static_cast<std::size_t>(lobe) - 1;
    const Domain& domain = *chest_.truth[index].domain;
    const Vec3 from = tree_[static_cast<std::size_t>(parent)].distal;
    const Vec3 way = centreOfMass(*chest_.lobes[index].mesh) - from;
    const double whole = way.norm();
    for (double length = LeastMm; length < whole; length += 1.0) {
      const Vec3 end = from + way * (length / whole);
      if (!domain.contains(end) || domain.distanceToWall(end) < ClearMm) continue;
      add(parent, from, end, generation, lobe);
      return;
    }
    throw InvalidInput("the sample's " + std::string(longName(lobe)) +
                       " does not take a bronchus; this is a fault of the sample's formulas");
  }

  /// Of the volume that a closed surface encloses.
  static Vec3 centreOfMass(const TriangleMesh& mesh) {
    Vec3 moment = Vec3::Zero();
    double volume = 0.0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3& p = mesh.points[a];
      const Vec3& q = mesh.points[b];
      const Vec3& r = mesh.points[c];
      const double six = p.dot(q.cross(r));
      moment += six / 4.0 * (p + q + r);
      volume += six;
    }
    return moment / volume;
  }

  const SampleChest& chest_;
  AirwayTree tree_;
};

}  // namespace

SampleChest sampleChest(double cellMm, const Progress& progress) {
  if (!(cellMm >= 0.5 && cellMm <= 6.0)) {
    throw InvalidOption("the sample's lattice must have cells of 0.5 to 6 mm, not of " +
                        std::to_string(cellMm) + " mm");
  }
  SampleChest chest;
  for (const Side lung : {Side::Right, Side::Left}) {
    const SampleLung shape = sampleLung(lung);
    for (const SampleFissure& fissure : shape.fissures()) chest.fissures.push_back(fissure);
    progress.report(static_cast<double>(chest.lobes.size()) / 5.0);
    const LungLattice lattice(shape, cellMm);
    for (const Lobe lobe : FiveLobes) {
      if (side(lobe) != lung) continue;
      progress.report(static_cast<double>(chest.lobes.size()) / 5.0);
      LobeSurface surface;
      surface.lobe = lobe;
      surface.name = std::string(shortName(lobe));
      surface.mesh = std::make_shared<const TriangleMesh>(lattice.surface(lobe));
      surface.health =
          examine(*surface.mesh, SelfIntersections::Ask,
                  progress.part(static_cast<double>(chest.lobes.size()) / 5.0,
                                static_cast<double>(chest.lobes.size() + 1) / 5.0, "sample"));
      chest.lobes.push_back(std::move(surface));
      chest.truth.push_back(
          {lobe, std::make_shared<FormulaLobe>(shape, lobe, lattice.volumeMm3(lobe))});
    }
  }
  chest.central = CentralAirways(chest).build();
  progress.report(1.0);
  return chest;
}

}  // namespace pneuma
