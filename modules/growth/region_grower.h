#pragma once

#include <cstdint>
#include <vector>

#include "anatomy/airway_tree.h"
#include "growth/division.h"
#include "growth/rescue.h"

namespace pneuma {

/// A branch as growth leaves it. Its proximal end is its parent's tip.
struct RegionBranch {
  int parent = -1;  ///< index in the same list; -1: grows from the inlet
  Vec3 tip = Vec3::Zero();
  double diameterMm = 0.0;
  double flow = 0.0;  ///< share of the whole
  Ending ending = Ending::None;
};

/// A branch that goes on to divide.
struct Sprout {
  int branch = -1;  ///< index in the list of branches; -1: the inlet itself
  Stem stem;
  Region region;
  std::uint64_t key = 0;  ///< names the branch whatever the order of growth, for random changes
  bool given = false;     ///< a central airway: its tip may lie anywhere (rule 9 does not apply)
  bool halve = false;     ///< beyond the paper: its region reaches too far
};

/// Mean and standard deviation of what was seen, summed in the order of growth.
struct Spread {
  double sum = 0.0;
  double squares = 0.0;
  std::size_t count = 0;

  void see(double value);
  void add(const Spread& other);
  double mean() const;
  double deviation() const;
};

/// What happened, for the report.
struct RegionCounts {
  std::size_t failedLeft = 0;   ///< left their region, or nothing was left of it
  std::size_t failedRatio = 0;  ///< could not divide it
  std::size_t turned = 0;       ///< branching planes turned by rule 8a
  std::size_t corrected = 0;    ///< angles enlarged by rule 6a
  std::size_t correctedBelow18 = 0;
  std::size_t correctedDividing = 0;  ///< of branches that go on to divide
  std::size_t correctedDividingBelow18 = 0;
  std::size_t rescuedShortened = 0;
  std::size_t rescuedTurned = 0;
  std::size_t rescuedReentered = 0;
  std::size_t rescuedLedRound = 0;
  std::size_t rescuedDivisions = 0;
  std::size_t dividedForReach = 0;  ///< small enough to end, but their region reaches too far
  std::size_t keptInside = 0;       ///< branches cut short so that they stay inside the organ
  std::size_t halvedForShape = 0;   ///< large enough to go on, but their region is too long
  Spread lengthToDiameter;          ///< of all branches
  Spread rotationDeg;               ///< of all divisions

  void add(const RegionCounts& other);
};

/// Grows one branch after the other by the rules. One grower for each thread.
class RegionGrower {
 public:
  /// @param trunkDiameterMm diameter at the whole flow
  /// @param totalMm3 volume of all organs
  RegionGrower(const KitaokaOptions& options, double trunkDiameterMm, double totalMm3);

  /// Divides a branch: its daughters are appended to `branches`, those that go on to divide to
  /// `sprouts`. Returns how the branch ended if it could not divide, else Ending::None.
  Ending grow(Sprout& sprout, std::vector<RegionBranch>& branches, std::vector<Sprout>& sprouts);

  const RegionCounts& counts() const { return counts_; }

 private:
  /// The cells of one daughter.
  struct Part {
    bool sideA;
    const RowMasks& cells;
    int count;
  };

  Ending rule9Ending(Sprout& sprout);
  double measuredFlow(const Region& region) const;
  void rule8aLastRatio(const Sprout& sprout, Division& division) const;
  void addDaughter(const Sprout& parent, const Division& division, const Part& part,
                   std::vector<RegionBranch>& branches, std::vector<Sprout>& sprouts);
  Turn branchingAngle(const Stem& parent, const DaughterRoom& room, const Vec3& side,
                      const Turn& angle, bool divides);
  double lengthToDiameter(const DaughterRoom& room, const Stem& parent, const Vec3& direction,
                          double diameterMm, std::uint64_t key, bool divides) const;
  bool reachesTooFar(const DaughterRoom& room) const;

  RescuedTip placed(const DaughterRoom& room, const Stem& parent, const Vec3& tip,
                    double diameterMm, bool divides);
  double rotationDeg(const Sprout& sprout) const;

  const KitaokaOptions& options_;
  double trunkDiameterMm_;
  double spacingMm_;  ///< edge of a cube of the mean terminal's volume
  CellGrid grid_;
  RowMasks cellsA_;
  RowMasks cellsB_;
  RegionCounts counts_;
};

/// Names a daughter of the branch with the key `parent`.
std::uint64_t daughterKey(std::uint64_t parent, std::uint64_t which);

}  // namespace pneuma
