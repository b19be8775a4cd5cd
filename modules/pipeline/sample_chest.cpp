#include "pipeline/sample_chest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "anatomy/diameter_law.h"
#include "core/error.h"
#include "core/parallel.h"
#include "pipeline/contour.h"
#include "pipeline/sample_lung.h"

namespace pneuma {
namespace {

/// The values that tell the lobes of a lung apart at a point, each positive on one side.
struct Levels {
  double pleura = 0.0;
  double aboveOblique = 0.0;
  double aboveHorizontal = 0.0;
};

/// Positive inside the lobe, 0 on its wall. The two sides of a fissure are exact negatives, so that
/// surfaces made of them meet in the same points.
double levelIn(Lobe lobe, const Levels& at) {
  switch (lobe) {
    case Lobe::RightUpper:
      return std::min({at.pleura, at.aboveOblique, at.aboveHorizontal});
    case Lobe::RightMiddle:
      return std::min({at.pleura, at.aboveOblique, -at.aboveHorizontal});
    case Lobe::LeftUpper:
      return std::min(at.pleura, at.aboveOblique);
    default:
      return std::min(at.pleura, -at.aboveOblique);
  }
}

Levels levelsAt(const SampleLung& shape, const Vec3& lps) {
  const Vec3 p = shape.modelFromLps(lps);
  return {shape.pleura(p), shape.aboveOblique(p), shape.aboveHorizontal(p)};
}

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

/// A lattice over a lung with the levels at its nodes.
class LungLattice {
 public:
  LungLattice(const SampleLung& shape, double cellMm) : cellMm_(cellMm) {
    const Box3 box = shape.bounds();
    origin_ = box.min() - cellMm * Vec3(1.37, 1.29, 1.43);
    size_ = ((box.max() - origin_) / cellMm).array().ceil().matrix().cast<int>() +
            Eigen::Vector3i::Constant(2);
    const std::size_t plane =
        static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y());
    levels_.resize(plane * static_cast<std::size_t>(size_.z()));
    parallelFor(static_cast<std::size_t>(size_.z()), [&](std::size_t k) {
      std::size_t node = k * plane;
      for (int j = 0; j < size_.y(); ++j) {
        for (int i = 0; i < size_.x(); ++i) {
          const Vec3 p = origin_ + cellMm_ * Vec3(i, j, static_cast<double>(k));
          levels_[node++] = awayFromZero(levelsAt(shape, p));
        }
      }
    });
  }

  /// mm^3, by the nodes inside.
  double volumeMm3(Lobe lobe) const {
    const auto inside =
        std::ranges::count_if(levels_, [&](const Levels& at) { return levelIn(lobe, at) > 0.0; });
    return static_cast<double>(inside) * cellMm_ * cellMm_ * cellMm_;
  }

  TriangleMesh surface(Lobe lobe) const {
    vtkNew<vtkDoubleArray> scalars;
    scalars->SetNumberOfValues(static_cast<vtkIdType>(levels_.size()));
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      scalars->SetValue(static_cast<vtkIdType>(i), levelIn(lobe, levels_[i]));
    }
    vtkNew<vtkImageData> image;
    image->SetDimensions(size_.x(), size_.y(), size_.z());
    image->SetOrigin(origin_.data());
    image->SetSpacing(cellMm_, cellMm_, cellMm_);
    image->GetPointData()->SetScalars(scalars);
    return contourOf(*image, 0.0);
  }

 private:
  /// Keeps the wall a little off the nodes: no triangle without area.
  Levels awayFromZero(const Levels& at) const {
    const auto keptOff = [&](double level) {
      const double least = 0.02 * cellMm_;
      return std::abs(level) >= least ? level : level < 0.0 ? -least : least;
    };
    return {keptOff(at.pleura), keptOff(at.aboveOblique), keptOff(at.aboveHorizontal)};
  }

  double cellMm_;
  Vec3 origin_;
  Eigen::Vector3i size_;
  std::vector<Levels> levels_;
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
