#include "growth/outline_aggregation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "core/error.h"

namespace pneuma {
namespace {

using Cell = LatticeCell<2>;
using Vec2 = Eigen::Vector2d;

constexpr int KeyPoints = 80;

// Our right lung from the front: x from the midline outwards, z up, mm; the carina is the origin.
const std::vector<Vec2>& outline() {
  static const std::vector<Vec2> corners = {
      {50, 112},   {70, 105},   {85, 95},    {108, 60},  {122, 15},  {132, -35}, {140, -85},
      {143, -130}, {140, -160}, {118, -138}, {90, -118}, {60, -108}, {38, -112}, {24, -122},
      {22, -95},   {20, -60},   {22, -30},   {20, 0},    {24, 40},   {34, 80},   {42, 103}};
  return corners;
}

// Main bronchus, upper lobar, intermediate and lower bronchus: from, to, diameter.
struct FirstAirway {
  Vec2 from;
  Vec2 to;
  int parent;
  double diameterMm;
};

const std::array<FirstAirway, 3> FirstAirways = {
    {{{2, 0}, {24, -22}, -1, 12.2}, {{24, -22}, {46, 0}, 0, 8.3}, {{24, -22}, {44, -58}, 0, 8.3}}};

// Shares of the area from the top down: where the regions part.
constexpr std::array<double, 3> AreaShares = {0.36, 0.18, 0.46};

bool insideOutline(const Vec2& p) {
  const std::vector<Vec2>& corners = outline();
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Vec2& a = corners[i];
    const Vec2& b = corners[j];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) inside = !inside;
  }
  return inside;
}

/// From the plane of the model to LPS: the right lung lies at negative x.
Vec3 lpsOf(const Vec2& p) { return {-p.x(), 0.0, p.y()}; }

/// Nothing is refused in the plane; its volume is its area, 1 mm thick.
class Plane : public Domain {
 public:
  explicit Plane(double areaMm2) : areaMm2_(areaMm2) {}

  bool contains(const Vec3&) const override { return true; }

  bool containsSegment(const Vec3&, const Vec3&) const override { return true; }

  double distanceToWall(const Vec3&) const override { return 0.0; }

  Box3 bounds() const override { return {Vec3(-150, 0, -170), Vec3(0, 1, 120)}; }

  double volumeMm3() const override { return areaMm2_; }

 private:
  double areaMm2_;
};

class OutlineGrower {
 public:
  OutlineGrower(const OutlineAggregationOptions& options, const Progress& progress)
      : options_(options),
        progress_(progress),
        first_(-10.0, -175.0),
        lattice_(Cell(static_cast<int>(165.0 / options.pixelMm) + 1,
                      static_cast<int>(300.0 / options.pixelMm) + 1)) {}

  OutlineAggregate run() {
    openPixels();
    findRegions();
    std::vector<LaunchGroup<2>> groups = launchGroups();
    plantAirways();
    Aggregation<2> aggregation(lattice_,
                               {options_.wall, options_.mostSteps, options_.step, options_.reach});
    Random random(options_.seed);
    const AggregationResult grown =
        aggregation.run(options_.particles, std::move(groups), random, progress_);
    std::ranges::copy(grown.stuck, result_.started.begin());
    result_.walkers = grown.launches;
    result_.end = grown.end;
    takeParticles(grown);
    result_.tips = appendAggregate(result_.tree, result_.cluster, {1, 0});
    for (std::size_t i = 0; i < result_.tree.size(); ++i) {
      if (result_.tree[i].origin == Origin::Grown)
        result_.tree.setRadiusMm(i, options_.pixelMm / 2);
    }
    measureReach(grown);
    for (const Vec2& corner : outline()) result_.outline.push_back(lpsOf(corner));
    return std::move(result_);
  }

 private:
  Vec2 centre(const Cell& cell) const { return first_ + options_.pixelMm * cell.cast<double>(); }

  Cell cellOf(const Vec2& p) const {
    return ((p - first_) / options_.pixelMm).array().round().matrix().cast<int>();
  }

  void openPixels() {
    Cell cell;
    for (cell[1] = 0; cell[1] < lattice_.size()[1]; ++cell[1])
      for (cell[0] = 0; cell[0] < lattice_.size()[0]; ++cell[0]) {
        if (!insideOutline(centre(cell))) continue;
        lattice_.setOpen(cell);
        inside_.push_back(cell);
      }
  }

  /// Heights that cut the area from the top in AreaShares.
  void findRegions() {
    // From the lowest row up.
    const auto rowAfter = [&](double share) {
      const auto rank = static_cast<std::size_t>(share * static_cast<double>(inside_.size()));
      return centre(inside_[rank]).y();
    };
    heights_ = {rowAfter(AreaShares[1] + AreaShares[2]), rowAfter(AreaShares[2])};
  }

  std::size_t regionOf(const Vec2& p) const {
    return p.y() >= heights_[0] ? 0 : p.y() >= heights_[1] ? 1 : 2;
  }

  /// Key points at equal distances along the outline, moved inwards to the first pixel inside.
  std::vector<LaunchGroup<2>> launchGroups() {
    const std::array<double, 3> reaction = {options_.upper, options_.middle, options_.lower};
    const double sum = std::accumulate(reaction.begin(), reaction.end(), 0.0);
    const bool launch = options_.reaction == ReactionProbability::Launch;
    if (launch && std::abs(sum - 1.0) > 1e-6) {
      throw InvalidOption("upper, middle and lower sum to " + textOf(sum) +
                          "; shares of the walkers must sum to 1");
    }
    std::vector<LaunchGroup<2>> groups(3);
    const std::vector<Vec2>& corners = outline();
    double length = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      length += (corners[(i + 1) % corners.size()] - corners[i]).norm();
    }
    std::size_t side = 0;
    double before = 0.0;
    for (int k = 0; k < KeyPoints; ++k) {
      const double at = length * k / KeyPoints;
      Vec2 way = corners[(side + 1) % corners.size()] - corners[side];
      while (at > before + way.norm()) {
        before += way.norm();
        ++side;
        way = corners[(side + 1) % corners.size()] - corners[side];
      }
      const Vec2 point = corners[side] + way.normalized() * (at - before);
      const Vec2 inwards(way.y() / way.norm(), -way.x() / way.norm());  // corners run clockwise
      Cell cell = cellOf(point);
      for (double depth = 0.0; !lattice_.open(cell) && depth < 20.0;
           depth += options_.pixelMm / 2) {
        cell = cellOf(point + depth * inwards);
      }
      const std::size_t region = regionOf(point);
      groups[region].sites.push_back(cell);
      result_.keyPointRegions.push_back(region);
      result_.keyPoints.push_back(lpsOf(centre(cell)));
    }
    for (std::size_t i = 0; i < groups.size(); ++i) {
      groups[i].share = launch ? reaction[i] : static_cast<double>(groups[i].sites.size());
      groups[i].sticking = launch ? 1.0 : reaction[i];
    }
    return groups;
  }

  void plantAirways() {
    const Vec2 shift(options_.seedXMm, options_.seedZMm);
    bool any = false;
    for (const FirstAirway& airway : FirstAirways) {
      Branch branch;
      branch.parent = airway.parent;
      branch.proximal = lpsOf(airway.from + shift);
      branch.distal = lpsOf(airway.to + shift);
      branch.radiusMm = airway.diameterMm / 2.0;
      branch.origin = Origin::Template;
      const int index = result_.tree.add(branch);
      const Vec2 way = airway.to - airway.from;
      const int steps = static_cast<int>(std::ceil(2.0 * way.norm() / options_.pixelMm));
      for (int k = steps; k >= 0; --k) {
        const Vec2 at = airway.from + shift + way * k / steps;
        const Cell cell = cellOf(at);
        if (!lattice_.holds(cell) || lattice_.inCluster(cell)) continue;
        any = any || lattice_.open(cell);
        lattice_.addToCluster(cell);
        placeOf_.emplace(lattice_.number(cell), ~static_cast<std::int32_t>(seeds().size()));
        seeds().push_back({lpsOf(at), index, {}});
      }
    }
    if (!any) {
      throw InvalidOption("the first airways, shifted by " + textOf(options_.seedXMm) + " and " +
                          textOf(options_.seedZMm) +
                          " mm, lie outside the lung; choose smaller seed-x and seed-z");
    }
  }

  std::vector<AirwaySeed>& seeds() { return result_.cluster.seeds; }

  void takeParticles(const AggregationResult& grown) {
    LobeAggregate& cluster = result_.cluster;
    const double pixelMm2 = options_.pixelMm * options_.pixelMm;
    cluster.region = {Lobe::RightLung,
                      std::make_shared<Plane>(pixelMm2 * static_cast<double>(inside_.size()))};
    cluster.voxelMm = options_.pixelMm;
    for (const AggregateParticle& particle : grown.particles) {
      cluster.parents.push_back(placeOf_.at(particle.parent));
      placeOf_.emplace(particle.cell, static_cast<std::int32_t>(cluster.positions.size()));
      const Vec2 at = centre(lattice_.cellOf(particle.cell));
      cluster.positions.push_back(lpsOf(at));
      ++result_.stuck[regionOf(at)];
    }
  }

  void measureReach(const AggregationResult& grown) {
    constexpr int Within = 10;
    std::vector<char> near(static_cast<std::size_t>(lattice_.size().prod()), 0);
    for (const AggregateParticle& particle : grown.particles) {
      const Cell cell = lattice_.cellOf(particle.cell);
      for (int y = -Within; y <= Within; ++y)
        for (int x = -Within; x <= Within; ++x) {
          const Cell other = cell + Cell(x, y);
          if (x * x + y * y > Within * Within || !lattice_.holds(other)) continue;
          near[lattice_.number(other)] = 1;
        }
    }
    std::array<double, 3> all = {};
    for (const Cell& cell : inside_) {
      const std::size_t region = regionOf(centre(cell));
      all[region] += 1.0;
      result_.reached[region] += near[lattice_.number(cell)];
    }
    for (std::size_t i = 0; i < all.size(); ++i) result_.reached[i] /= all[i];
  }

  const OutlineAggregationOptions& options_;
  const Progress& progress_;
  Vec2 first_;  ///< centre of the first pixel
  AggregationLattice<2> lattice_;
  std::vector<Cell> inside_;
  std::array<double, 2> heights_ = {};
  std::unordered_map<std::uint32_t, std::int32_t> placeOf_;  ///< pixel to particle, or ~seed
  OutlineAggregate result_;
};

}  // namespace

OutlineAggregate growInOutline(const OutlineAggregationOptions& options, const Progress& progress) {
  requireValid(options);
  return OutlineGrower(options, progress).run();
}

}  // namespace pneuma
