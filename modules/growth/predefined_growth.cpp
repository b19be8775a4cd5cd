#include "growth/predefined_growth.h"

#include <map>

#include "anatomy/segment.h"
#include "core/error.h"
#include "growth/inlet_regions.h"

namespace pneuma {
namespace {

/// A branch of the table that was grown.
struct Grown {
  int branch = 0;
  Sprout sprout;
};

class TableGrower {
 public:
  TableGrower(const PredefinedAirways& table, const LobeRegion& organ,
              const KitaokaOptions& options)
      : table_(table), organ_(organ), options_(options), grid_(options.grid) {}

  AirwayTree run() {
    addRoot();
    for (const PredefinedBifurcation& bifurcation : table_.bifurcations) addDaughters(bifurcation);
    return std::move(tree_);
  }

 private:
  void addRoot() {
    const Vec3 direction = table_.direction.normalized();
    Branch root;
    root.proximal = table_.start;
    root.distal = table_.start + table_.lengthMm * direction;
    root.radiusMm = table_.diameterMm / 2.0;
    root.lobe = organ_.lobe;
    root.origin = Origin::Template;
    Sprout sprout;
    sprout.given = true;
    sprout.stem = {root.distal, direction, widestAcross(organ_.domain->bounds(), direction), 1.0};
    sprout.region.organ = organ_.domain.get();
    sprout.region.box = organ_.domain->bounds();
    sprout.region.ancestors.push_back({root.proximal, root.distal, root.radiusMm});
    grown_.emplace(table_.root, Grown{tree_.add(root), std::move(sprout)});
  }

  void addDaughters(const PredefinedBifurcation& bifurcation) {
    const auto found = grown_.find(bifurcation.parent);
    if (found == grown_.end()) {
      throw InvalidInput("the table of airways divides '" + bifurcation.parent +
                         "' before it is there; list a parent's own bifurcation first");
    }
    Grown parent = found->second;
    const Stem& stem = parent.sprout.stem;
    const Vec3 flat = acrossOf(bifurcation.hint, stem.direction);
    const Turn azimuth = Turn::ofDegrees(bifurcation.azimuthDeg);
    const Vec3 side = azimuth.cosine * flat + azimuth.sine * stem.direction.cross(flat);
    const Turn a = Turn::ofDegrees(bifurcation.a.angleDeg);
    const Turn b = Turn::ofDegrees(bifurcation.b.angleDeg);
    const Vec3 directionA = a.cosine * stem.direction + a.sine * side;
    const Vec3 directionB = b.cosine * stem.direction - b.sine * side;
    const Wedge wedge = givenSide(stem, directionA, directionB);
    RowMasks cellsA;
    RowMasks cellsB;
    const int cells = grid_.lay(parent.sprout.region);
    const int cellsOfA = grid_.select(wedge, grid_.cells(), cellsA);
    grid_.selectRest(cellsA, cellsB);
    addDaughter(parent, bifurcation.a, directionA, wedge, cellsA, cellsOfA, cells);
    addDaughter(parent, bifurcation.b, directionB, wedge.rest(), cellsB, cells - cellsOfA, cells);
  }

  void addDaughter(const Grown& parent, const PredefinedDaughter& daughter, const Vec3& direction,
                   const Wedge& side, const RowMasks& mask, int count, int cells) {
    if (count == 0) {
      throw InvalidInput("the airway '" + daughter.name +
                         "' of the table gets no part of the organ; check the angles and the hint "
                         "of its bifurcation");
    }
    const Sprout& from = parent.sprout;
    Sprout sprout = from;
    sprout.stem.flow = from.stem.flow * count / cells;
    const double diameter =
        rule6Diameter(sprout.stem.flow, table_.diameterMm, options_.diameterExponent);
    Branch branch;
    branch.parent = parent.branch;
    branch.proximal = from.stem.tip;
    branch.distal = from.stem.tip + daughter.lengthToDiameter * diameter * direction;
    branch.radiusMm = diameter / 2.0;
    branch.lobe = organ_.lobe;
    branch.segment = segmentOfName(daughter.name).value_or(0);
    branch.origin = Origin::Template;
    sprout.stem.tip = branch.distal;
    sprout.stem.direction = direction;
    sprout.region.walls.push_back(side);
    sprout.region.cuts.push_back(side);
    sprout.region.ancestors.push_back({branch.proximal, branch.distal, branch.radiusMm});
    sprout.region.box = grid_.boxOf(mask);
    const int index = tree_.add(std::move(branch));
    if (!grown_.emplace(daughter.name, Grown{index, std::move(sprout)}).second) {
      throw InvalidInput("the table of airways names '" + daughter.name + "' twice");
    }
  }

  const PredefinedAirways& table_;
  const LobeRegion& organ_;
  const KitaokaOptions& options_;
  CellGrid grid_;
  AirwayTree tree_;
  std::map<std::string, Grown> grown_;
};

}  // namespace

AirwayTree growPredefined(const PredefinedAirways& table, const LobeRegion& organ,
                          const KitaokaOptions& options) {
  return TableGrower(table, organ, options).run();
}

}  // namespace pneuma
