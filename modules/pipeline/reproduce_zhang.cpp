#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "anatomy/box_dimension.h"
#include "anatomy/branch_order.h"
#include "anatomy/cluster_dimension.h"
#include "anatomy/order_ratios.h"
#include "core/joint_progress.h"
#include "core/parallel.h"
#include "growth/free_cluster.h"
#include "growth/outline_aggregation.h"
#include "pipeline/organs.h"
#include "pipeline/reproduce_paper.h"

namespace pneuma {
namespace {

constexpr std::size_t Seeds = 6;

constexpr std::array<PaperTable, 5> ZhangTables = {{
    {"outline", "10,000 particles in the outline of a right lung, means of six seeds"},
    {"shares", "Where 8,000 particles end by what the reaction probability is, pixels of 0.4 mm"},
    {"variations", "What the paper discusses: walls and steps, step length, centre"},
    {"free", "Dimension of clusters in free space, means of four seeds"},
    {"lung", "A million particles in the synthetic right lung, voxels of 0.45 mm"},
}};

constexpr const char* NoFigure = "the paper gives no figure; the limit is a program of our own";
constexpr const char* Known = "the paper gives no figure; the literature on aggregation does";

/// Figures of one experiment, a value for every seed.
struct Runs {
  std::vector<double> particles;
  std::vector<double> walkersPerParticle;
  std::vector<double> tips;  ///< share of the particles
  std::vector<double> branching;
  std::array<std::vector<double>, 3> share;    ///< of the particles, by region
  std::array<std::vector<double>, 3> reached;  ///< of the region
};

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double sd(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += std::pow(value - mean(values), 2);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

/// Strahler's branching ratio over the orders with ten elements or more: the few trunks say
/// nothing.
double branchingRatio(const AirwayTree& tree) {
  constexpr std::size_t Fewest = 10;
  std::vector<std::size_t> all(tree.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<std::size_t> counts = orderRatios(tree, strahlerOrders(tree), all).counts;
  std::erase_if(counts, [](std::size_t count) { return count < Fewest; });
  // From the first to the last order: the mean of the steps between them.
  const double steps = static_cast<double>(counts.size()) - 1.0;
  return std::pow(static_cast<double>(counts.front()) / static_cast<double>(counts.back()),
                  1.0 / steps);
}

Runs run(const OutlineAggregationOptions& options, const Progress& progress) {
  std::vector<OutlineAggregate> grown(Seeds);
  JointProgress joint(progress, Seeds);
  parallelFor(Seeds, [&](std::size_t i) {
    OutlineAggregationOptions own = options;
    own.seed = i + 1;
    grown[i] = growInOutline(own, joint.task(i));
  });
  Runs runs;
  for (const OutlineAggregate& aggregate : grown) {
    const auto count = static_cast<double>(aggregate.cluster.positions.size());
    runs.particles.push_back(count);
    runs.walkersPerParticle.push_back(static_cast<double>(aggregate.walkers) / count);
    runs.tips.push_back(static_cast<double>(aggregate.tips.all) / count);
    runs.branching.push_back(branchingRatio(aggregate.tree));
    for (std::size_t region = 0; region < 3; ++region) {
      runs.share[region].push_back(static_cast<double>(aggregate.stuck[region]) / count);
      runs.reached[region].push_back(aggregate.reached[region]);
    }
  }
  return runs;
}

/// How far the seeds scatter, and what else there is to say.
std::string scatter(const std::vector<double>& values, const std::string& note = {}) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "SD over six seeds %.3g", sd(values));
  return note.empty() ? text.data() : text.data() + ("; " + note);
}

constexpr std::array<const char*, 3> Regions = {"upper", "middle", "lower"};

using Rows = std::vector<ReproducedRow>;

void outlineTable(Rows& rows, const Progress& progress) {
  const Runs runs = run({}, progress.part(0.0, 0.5, "aggregating in the outline"));
  const Runs full =
      run({.particles = 100000}, progress.part(0.5, 1.0, "aggregating in the outline"));
  const double least = *std::ranges::min_element(runs.particles);
  rows = {{"0.6 mm", "particles before saturation, fewest", 10000, least, Limit::difference(0), {}},
          {"0.6 mm", "particles when saturated", 10700, mean(full.particles), Limit::relative(0.1),
           scatter(full.particles, NoFigure)},
          {"0.6 mm", "tips, share of the particles", 0.23, mean(runs.tips), Limit::difference(0.03),
           scatter(runs.tips, NoFigure)},
          {"0.6 mm", "Strahler branching ratio", 5.2, mean(runs.branching), Limit::range(4.8, 5.6),
           scatter(runs.branching, Known)}};
  for (std::size_t region = 0; region < 3; ++region) {
    rows.push_back({"0.6 mm",
                    std::string(Regions[region]) + " region, within 10 pixels of the tree", 1.0,
                    mean(runs.reached[region]), Limit::range(0.5, 1.0),
                    scatter(runs.reached[region], "the paper's picture reaches every region")});
  }
}

void sharesTable(Rows& rows, const Progress& progress) {
  OutlineAggregationOptions options{.particles = 8000, .pixelMm = 0.4};
  const std::array<double, 3> paper = {options.upper, options.middle, options.lower};
  const auto add = [&](const char* name, const Runs& runs, const Limit& limit, const char* note) {
    for (std::size_t region = 0; region < 3; ++region) {
      rows.push_back({name, std::string(Regions[region]) + " share", paper[region],
                      mean(runs.share[region]), limit, scatter(runs.share[region], note)});
    }
  };
  add("launch", run(options, progress.part(0.0, 0.3, "sharing out launches")),
      Limit::difference(0.15), "walkers do not all end in the region they start from");
  options.reaction = ReactionProbability::Sticking;
  add("sticking", run(options, progress.part(0.3, 0.6, "sharing out sticking")), {},
      "the other reading: it hardly steers where the tree grows");
  options.upper = options.middle = options.lower = 1.0;
  add("neither", run(options, progress.part(0.6, 1.0, "sharing out nothing")), {},
      "all key points alike, every walker stays");
}

void variationsTable(Rows& rows, const Progress& progress) {
  const auto add = [&](const char* name, const Runs& runs, const char* note) {
    rows.push_back({name,
                    "particles when saturated",
                    10000,
                    mean(runs.particles),
                    {},
                    scatter(runs.particles, note)});
    rows.push_back({name, "walkers per particle", 1.0, mean(runs.walkersPerParticle), {}, {}});
    for (std::size_t region = 0; region < 3; ++region) {
      rows.push_back({name,
                      std::string(Regions[region]) + " region, within 10 pixels of the tree",
                      1.0,
                      mean(runs.reached[region]),
                      {},
                      scatter(runs.reached[region])});
    }
  };
  constexpr std::uint64_t Many = 100000;
  add("walls absorb, 10,000 steps",
      run({.particles = Many, .wall = Wall::Absorb, .mostSteps = 10000.0},
          progress.part(0.0, 0.7, "absorbing at the wall")),
      "the paper's words; most walkers are lost within a step or two of the wall");
  add("steps of 10 pixels",
      run({.particles = Many, .step = 10, .reach = 10},
          progress.part(0.7, 0.8, "taking long steps")),
      "the paper: coarse, and results scatter");
  add("centre 30 mm lower",
      run({.particles = Many, .seedZMm = -30.0}, progress.part(0.8, 0.9, "moving the centre")),
      "the paper: another centre gives another tree");
  add("centre 40 mm outwards",
      run({.particles = Many, .seedXMm = 40.0}, progress.part(0.9, 1.0, "moving the centre")),
      "the paper: another centre gives another tree");
}

template <int D>
double meanFreeDimension(std::size_t particles, const Progress& progress) {
  constexpr std::size_t FreeSeeds = 4;
  std::vector<double> dimensions(FreeSeeds);
  JointProgress joint(progress, FreeSeeds);
  parallelFor(FreeSeeds, [&](std::size_t i) {
    dimensions[i] = gyrationDimension(freeCluster<D>(particles, i + 1, joint.task(i)));
  });
  return mean(dimensions);
}

void freeTable(Rows& rows, const Progress& progress) {
  rows = {{"plane", "N against radius of gyration, 100,000 particles", 1.71,
           meanFreeDimension<2>(100000, progress.part(0.0, 0.5, "growing in free space")),
           Limit::difference(0.06), Known},
          {"space", "N against radius of gyration, 40,000 particles", 2.5,
           meanFreeDimension<3>(40000, progress.part(0.5, 1.0, "growing in free space")),
           Limit::difference(0.1), Known}};
}

void lungTable(Rows& rows, Reproduction& result, const ReproduceOptions& options,
               const Progress& progress) {
  constexpr double VoxelMm = 0.45;
  const DlaOptions dla{
      .particles = 1000000, .voxelMm = VoxelMm, .shareRul = 0.2, .shareRml = 0.3, .shareRll = 0.5};
  LungModel lung = grow(openOrgan("right-lung"), dla, progress.part(0.0, 0.9, "aggregating"));
  const GrowthResult& grown = lung.growth->result;
  std::vector<Vec3> points;
  std::map<Lobe, double> counts;
  for (const AggregatePoint& point : grown.aggregate) {
    points.push_back(point.position);
    counts[point.lobe] += 1.0 / static_cast<double>(grown.aggregate.size());
  }
  rows.push_back(
      {"1e6", "particles", 1e6, static_cast<double>(points.size()), Limit::difference(0), {}});
  const std::array<std::pair<Lobe, double>, 3> shares = {
      {{Lobe::RightUpper, 0.2}, {Lobe::RightMiddle, 0.3}, {Lobe::RightLower, 0.5}}};
  for (const auto& [lobe, share] : shares) {
    rows.push_back({"1e6",
                    "share of the " + std::string(longName(lobe)),
                    share,
                    counts[lobe],
                    Limit::difference(0.05),
                    {}});
  }
  double judged = 0.0;  // mean of the octaves from 8 to 64 voxels
  for (const BoxDimension& octave : boxDimensions(points, VoxelMm, 6)) {
    const auto voxels = std::lround(octave.boxMm / VoxelMm);
    if (voxels >= 8) judged += octave.dimension / 3.0;
    rows.push_back(
        {"1e6",
         "box slope, " + std::to_string(voxels) + " to " + std::to_string(2 * voxels) + " voxels",
         2.4,
         octave.dimension,
         {},
         voxels < 8 ? "small boxes see single chains of particles" : NoFigure});
  }
  rows.push_back(
      {"1e6", "box slope, 8 to 64 voxels", 2.4, judged, Limit::range(2.3, 2.5), NoFigure});
  rows.push_back({"1e6",
                  "correlation dimension, 8 to 64 voxels",
                  2.4,
                  correlationDimension(points, 8 * VoxelMm, 64 * VoxelMm, 1),
                  {},
                  NoFigure});
  rows.push_back({"1e6",
                  "ends outside their lobe",
                  0,
                  static_cast<double>(lung.growth->outside.ends),
                  Limit::difference(0),
                  {}});
  if (options.figures) result.figures.push_back({"lung", std::move(lung)});
}

void reproduceZhang(const ReproduceOptions& options, Reproduction& result,
                    const Progress& progress) {
  const std::array<double, 6> until = {0.0, 0.03, 0.08, 0.3, 0.4, 1.0};  // shares of the time
  for (std::size_t i = 0; i < ZhangTables.size(); ++i) {
    const bool drawn = options.figures && ZhangTables[i].id == "lung";
    if (!wanted(options, ZhangTables[i].id) && !drawn) continue;
    ReproducedTable table{std::string(ZhangTables[i].id), std::string(ZhangTables[i].name), {}};
    const Progress part = progress.part(until[i], until[i + 1], ZhangTables[i].name);
    if (table.id == "outline") outlineTable(table.rows, part);
    if (table.id == "shares") sharesTable(table.rows, part);
    if (table.id == "variations") variationsTable(table.rows, part);
    if (table.id == "free") freeTable(table.rows, part);
    if (table.id == "lung") lungTable(table.rows, result, options, part);
    if (wanted(options, table.id)) result.tables.push_back(std::move(table));
  }
}

}  // namespace

const Paper& zhang2003() {
  static const Paper paper{"zhang-2003", growthMethod("dla").citation, ZhangTables, reproduceZhang};
  return paper;
}

}  // namespace pneuma
