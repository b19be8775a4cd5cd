#include "pipeline/detail/lung_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "core/disjoint_sets.h"
#include "core/parallel.h"
#include "pipeline/contour.h"

namespace pneuma {

LungLevels levelsAt(const SampleLung& shape, const Vec3& lps) {
  return {shape.pleura(shape.modelFromLps(lps)), shape.oblique.above(lps),
          shape.horizontal ? shape.horizontal->above(lps) : 0.0};
}

double levelIn(Lobe lobe, const LungLevels& at) {
  switch (lobe) {
    case Lobe::RightLung:
    case Lobe::LeftLung:
      return at.pleura;
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

LungLattice::LungLattice(const SampleLung& shape, double cellMm)
    : side_(shape.side), cellMm_(cellMm), leastLevel_(0.02 * cellMm) {
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
  joinCrumbs();
}

double LungLattice::volumeMm3(Lobe lobe) const {
  const auto inside =
      std::ranges::count_if(levels_, [&](const LungLevels& at) { return levelIn(lobe, at) > 0.0; });
  return static_cast<double>(inside) * cellMm_ * cellMm_ * cellMm_;
}

TriangleMesh LungLattice::surface(Lobe lobe) const {
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

LungLevels LungLattice::awayFromZero(const LungLevels& at) const {
  const auto keptOff = [&](double level) {
    return std::abs(level) >= leastLevel_ ? level : std::copysign(leastLevel_, level);
  };
  return {keptOff(at.pleura), keptOff(at.aboveOblique), keptOff(at.aboveHorizontal)};
}

/// Where a lobe tapers, nodes of it may hang together with no others: they go to the lobe beside
/// them, or outside, so that every lobe is one piece.
void LungLattice::joinCrumbs() {
  const std::size_t row = static_cast<std::size_t>(size_.x());
  const std::array<std::size_t, 3> steps = {1, row, row * static_cast<std::size_t>(size_.y())};
  std::vector<Lobe> lobes(levels_.size());
  for (std::size_t node = 0; node < levels_.size(); ++node) lobes[node] = lobeAt(node);
  // The lattice's border lies outside, so that every node of a lobe has all its neighbours.
  DisjointSets pieces(levels_.size());
  for (std::size_t node = 0; node < levels_.size(); ++node) {
    if (lobes[node] == Lobe::Whole) continue;
    for (const std::size_t step : steps) {
      if (lobes[node + step] == lobes[node]) {
        pieces.join(static_cast<std::uint32_t>(node), static_cast<std::uint32_t>(node + step));
      }
    }
  }
  std::map<std::uint32_t, std::size_t> sizes;
  for (std::size_t node = 0; node < levels_.size(); ++node) {
    if (lobes[node] != Lobe::Whole) ++sizes[pieces.find(static_cast<std::uint32_t>(node))];
  }
  std::map<Lobe, std::uint32_t> largest;
  for (const auto& [piece, size] : sizes) {
    const auto found = largest.try_emplace(lobes[piece], piece).first;
    if (size > sizes.at(found->second)) found->second = piece;
  }
  const auto whole = [&](std::size_t node) {
    return lobes[node] != Lobe::Whole &&
           pieces.find(static_cast<std::uint32_t>(node)) == largest.at(lobes[node]);
  };
  for (std::size_t node = 0; node < levels_.size(); ++node) {
    if (lobes[node] == Lobe::Whole || whole(node)) continue;
    Lobe beside = Lobe::Whole;
    for (const std::size_t step : steps) {
      for (const std::size_t neighbour : {node - step, node + step}) {
        if (whole(neighbour)) beside = lobes[neighbour];
      }
    }
    give(node, beside);
  }
}

/// Makes a node one of that lobe. @param lobe Lobe::Whole: outside
void LungLattice::give(std::size_t node, Lobe lobe) {
  LungLevels& at = levels_[node];
  if (lobe == Lobe::Whole) {
    at.pleura = -leastLevel_;
    return;
  }
  const bool lower = lobe == Lobe::RightLower || lobe == Lobe::LeftLower;
  const auto turned = [&](double level, bool above) {
    return (level > 0.0) == above ? level : std::copysign(leastLevel_, above ? 1.0 : -1.0);
  };
  at.aboveOblique = turned(at.aboveOblique, !lower);
  if (!lower) at.aboveHorizontal = turned(at.aboveHorizontal, lobe != Lobe::RightMiddle);
}

/// Lobe::Whole: none.
Lobe LungLattice::lobeAt(std::size_t node) const {
  for (const Lobe lobe : FiveLobes) {
    if (side(lobe) == side_ && levelIn(lobe, levels_[node]) > 0.0) return lobe;
  }
  return Lobe::Whole;
}

}  // namespace pneuma
