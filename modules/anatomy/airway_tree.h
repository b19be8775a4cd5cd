#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "anatomy/lobe.h"
#include "core/math.h"

namespace pneuma {

/// Where a branch comes from.
enum class Origin : std::uint8_t { Measured = 0, Template = 1, Grown = 2 };

/// Why growth stopped at a terminal.
enum class Ending : std::uint8_t {
  None = 0,        ///< it did not stop here, or the method does not say
  Flow = 1,        ///< what it serves is small enough: as it should be
  LeftRegion = 2,  ///< its end left the region it serves, or nothing is left of that region: failed
  Ratio = 3,       ///< its region can not be divided evenly enough: failed
};

/// A point of a centreline between the ends of its branch.
struct CentrelinePoint {
  Vec3 position;  ///< LPS, mm
  double radiusMm = 0.0;
};

/// An airway from one bifurcation to the next. Measured branches, and those grown by aggregation,
/// follow their centreline through `via`; others are straight.
struct Branch {
  int parent = -1;  ///< index in the tree, smaller than the branch's own; -1 for the root
  Vec3 proximal = Vec3::Zero();  ///< end towards the mouth, LPS, mm
  Vec3 distal = Vec3::Zero();    ///< end towards the alveoli, LPS, mm
  double radiusMm = 0.0;
  Lobe lobe = Lobe::Whole;
  std::uint8_t segment = 0;  ///< bronchopulmonary segment (anatomy/segment.h), 0 if unknown
  Origin origin = Origin::Grown;
  double suppliedMl = 0.0;  ///< lung supplied at this branch's own end, not through its children
  Ending ending = Ending::None;
  std::vector<CentrelinePoint> via = {};  ///< proximal to distal, without the ends
};

/// Length along the centreline, mm.
double lengthMm(const Branch& branch);

/// Unit vector from the proximal to the distal end; zero if they coincide.
Vec3 direction(const Branch& branch);

/// A bronchial tree. Parents are stored before their children, so that what flows down the tree is
/// a forward loop and what sums up is a backward one.
class AirwayTree {
 public:
  /// Adds a branch and returns its index. @throws InvalidInput if its parent is not stored yet
  int add(Branch branch);

  void reserve(std::size_t branches) { branches_.reserve(branches); }

  std::size_t size() const { return branches_.size(); }

  bool empty() const { return branches_.empty(); }

  const Branch& operator[](std::size_t i) const { return branches_[i]; }

  auto begin() const { return branches_.begin(); }

  auto end() const { return branches_.end(); }

  std::span<const Branch> branches() const { return branches_; }

  /// Of the whole branch, the points of its centreline included.
  void setRadiusMm(std::size_t i, double radiusMm) {
    branches_[i].radiusMm = radiusMm;
    for (CentrelinePoint& point : branches_[i].via) point.radiusMm = radiusMm;
  }

  void setLobe(std::size_t i, Lobe lobe) { branches_[i].lobe = lobe; }

  void setSegment(std::size_t i, std::uint8_t segment) { branches_[i].segment = segment; }

  void setOrigin(std::size_t i, Origin origin) { branches_[i].origin = origin; }

  void setEnding(std::size_t i, Ending ending) { branches_[i].ending = ending; }

  void setSuppliedMl(std::size_t i, double ml) { branches_[i].suppliedMl = ml; }

 private:
  std::vector<Branch> branches_;
};

/// The children of every branch, in the order they are stored.
class Children {
 public:
  explicit Children(const AirwayTree& tree);

  std::span<const int> of(std::size_t branch) const {
    return std::span(ids_).subspan(
        static_cast<std::size_t>(offsets_[branch]),
        static_cast<std::size_t>(offsets_[branch + 1] - offsets_[branch]));
  }

  bool isTerminal(std::size_t branch) const { return offsets_[branch] == offsets_[branch + 1]; }

 private:
  std::vector<int> offsets_;
  std::vector<int> ids_;
};

std::size_t terminalCount(const AirwayTree& tree);

/// The tree with every branch that has exactly one child joined to that child: the joined branch
/// keeps the way through the former junction in `via`, the mean radius by length, and the child's
/// lobe, segment and origin.
AirwayTree contractChains(const AirwayTree& tree);

}  // namespace pneuma
