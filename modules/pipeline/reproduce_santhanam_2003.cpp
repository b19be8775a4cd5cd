#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "breathing/shot_unshot.h"
#include "breathing/strain_assignment.h"
#include "breathing/strain_directions.h"
#include "breathing/surface_points.h"
#include "breathing/volume_polynomial.h"
#include "core/units.h"
#include "pipeline/detail/sample_walls.h"
#include "pipeline/reproduce_paper.h"

namespace pneuma {
namespace {

constexpr std::array<PaperTable, 6> StrainTables = {
    {{"assignment", "Table 3: initial strain"},
     {"sharing", "Fig. 2: does the sharing of force end?"},
     {"strain", "Shot beside the strain that was assigned"},
     {"volume", "Section 5.3: steps of volume"},
     {"directions", "Section 4.3: directions"},
     {"missing", "What cannot be repeated"}}};

constexpr double DeepMm3 = 1.5e6;  // breathed in for Fig. 7
constexpr const char* NotInPaper = "not in the paper: what it must be by its formulas";

using StrainRows = std::vector<ReproducedRow>;

/// A lung with everything that its strain is made of.
struct StrainedLung {
  explicit StrainedLung(TriangleMesh surface)
      : mesh(std::move(surface)),
        neighbours(mesh),
        strain(initialStrain(mesh, diaphragmaticSurface(mesh), StrainCurve::published())),
        shot(sharedForce(neighbours, strain, strain, ForceSharing::Receiver)),
        normals(pointNormals(mesh)),
        directions(strainDirections(neighbours, shot, normals)) {
    // The paper's strains are shares of a length, 0.4 at the most.
    const double most = *std::ranges::max_element(shot);
    for (double& value : shot) value *= PublishedStrain.front().strain / most;
  }

  TriangleMesh mesh;
  VertexNeighbours neighbours;
  std::vector<double> strain;
  std::vector<double> shot;
  std::vector<Vec3> normals;
  std::vector<Vec3> directions;
};

double meanValue(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double covariance(std::span<const double> a, std::span<const double> b) {
  const double meanA = meanValue(a);
  const double meanB = meanValue(b);
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += (a[n] - meanA) * (b[n] - meanB);
  return sum / static_cast<double>(a.size());
}

double pearson(std::span<const double> a, std::span<const double> b) {
  return covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
}

double variationPercent(std::span<const double> values) {
  return 100.0 * std::sqrt(covariance(values, values)) / meanValue(values);
}

void assignmentTable(StrainRows& rows) {
  const StrainCurve published = StrainCurve::published();
  const StrainCurve smooth = strainCurve(StrainPreset::Smooth);
  constexpr std::array<const char*, 3> Names = {"0", "0.5", "1"};
  for (std::size_t n = 0; n < PublishedStrain.size(); ++n) {
    const StrainPoint& point = PublishedStrain[n];
    rows.push_back({Names[n], "strain", point.strain, published.at(point.r),
                    Limit::difference(1e-12), "exponential to the middle, then gaussian"});
    rows.push_back({Names[n], "strain, without the corner", point.strain, smooth.at(point.r),
                    Limit::difference(1e-12), "ours: monotone cubic through the same points"});
  }
  constexpr double Near = 1e-9;
  const auto corner = [](const StrainCurve& curve) {
    return std::abs(curve.slope(0.5 + Near) - curve.slope(0.5 - Near));
  };
  rows.push_back({"0.5", "corner, change of slope", NotPublished, corner(published),
                  Limit::range(0.27, 0.28),
                  "the only exponential and gaussian through the table meet in a corner"});
  rows.push_back({"0.5", "corner without it", NotPublished, corner(smooth), Limit::range(0.0, 1e-6),
                  NotInPaper});
}

void sharingTable(StrainRows& rows, const StrainedLung& lung) {
  const std::vector<double> force(lung.strain.size(), 1.0);
  const auto radius = [&](ForceSharing sharing) {
    return sharingRadius(lung.neighbours, lung.strain, sharing);
  };
  constexpr double Tried = 100.0;
  const SharedForce printed = sharedInTurns(lung.neighbours, lung.strain, force,
                                            ForceSharing::Printed, {.relaxationsPerNode = Tried});
  const char* never =
      "the paper repeats \"until all UnShot = 0\"; as printed that is never: what a point "
      "receives adds up to what its neighbours pass on";
  rows.push_back({"as printed", "spectral radius", NotPublished, radius(ForceSharing::Printed),
                  Limit::range(1.0 - 1e-6, 1.0 + 1e-6), never});
  rows.push_back({"as printed",
                  "largest UnShot after 100 relaxations a point, of the first",
                  0.0,
                  printed.left,
                  {},
                  never});
  const SharedForce turns =
      sharedInTurns(lung.neighbours, lung.strain, force, ForceSharing::Receiver);
  const SharedForce sweeps =
      sharedBySweeps(lung.neighbours, lung.strain, force, ForceSharing::Receiver);
  const char* itself = "a point belongs to its own clique";
  rows.push_back({"with itself", "spectral radius", NotPublished, radius(ForceSharing::Receiver),
                  Limit::range(0.84, 0.87), itself});
  rows.push_back({"with itself", "largest UnShot at the end, of the first", 0.0, turns.left,
                  Limit::difference(1e-6), itself});
  rows.push_back({"with itself", "relaxations a point, largest first", NotPublished,
                  turns.relaxationsPerNode, Limit::range(40.0, 60.0),
                  "the cost of the paper's Fig. 2 with a heap instead of its linear search"});
  rows.push_back({"with itself", "relaxations a point, in sweeps", NotPublished,
                  sweeps.relaxationsPerNode, Limit::range(20.0, 70.0), NotInPaper});
  const std::vector<double> solved =
      sharedForce(lung.neighbours, lung.strain, force, ForceSharing::Receiver);
  double most = 0.0;
  for (std::size_t n = 0; n < solved.size(); ++n) {
    most = std::max(most, std::abs(turns.shot[n] / solved[n] - 1.0));
  }
  rows.push_back({"with itself", "largest difference to the solved equation", NotPublished, most,
                  Limit::range(0.0, 1e-4), NotInPaper});
}

void strainTable(StrainRows& rows, const StrainedLung& lung) {
  const std::vector<double> force(lung.strain.size(), 1.0);
  std::vector<double> valence;
  for (std::size_t n = 0; n < force.size(); ++n) {
    valence.push_back(static_cast<double>(lung.neighbours.of(n).size()));
  }
  const auto shot = [&](const std::vector<double>& load, ForceSharing sharing) {
    return sharedForce(lung.neighbours, lung.strain, load, sharing);
  };
  const std::vector<double> uniform = shot(force, ForceSharing::Receiver);
  const std::vector<double> sender = shot(force, ForceSharing::Sender);
  const char* constant =
      "\"an equal force applied on every node\": Shot is then nearly constant and the curve of "
      "Table "
      "3 is forgotten";
  rows.push_back({"equal force", "variation of Shot, %", NotPublished, variationPercent(uniform),
                  Limit::range(0.0, 10.0), constant});
  rows.push_back({"equal force",
                  "correlation with the strain",
                  NotPublished,
                  pearson(uniform, lung.strain),
                  {},
                  constant});
  rows.push_back({"force by strain", "variation of Shot, %", NotPublished,
                  variationPercent(lung.shot), Limit::range(20.0, 80.0), NotInPaper});
  rows.push_back({"force by strain", "correlation with the strain", NotPublished,
                  pearson(lung.shot, lung.strain), Limit::range(0.97, 1.0),
                  "\"Shot[i] is the new strain\": this needs a force that has the strain in it"});
  rows.push_back({"sender's rule", "correlation with the number of neighbours", NotPublished,
                  pearson(sender, valence), Limit::range(0.9, 1.0),
                  "equal force, the rule of 2008: it shows the mesh, not the lung"});
}

double stepErrorPercent(const StrainedLung& lung, double ml) {
  VolumeSteps steps(lung.mesh, lung.shot, lung.directions);
  steps.step(1000.0 * ml);
  const double gained = signedVolumeMm3(steps.surface()) - signedVolumeMm3(lung.mesh);
  return 100.0 * std::abs(gained / (1000.0 * ml) - 1.0);
}

void volumeTable(StrainRows& rows, const StrainedLung& lung) {
  const char* linear = "the volume is a cubic of the step; exact volumes: see breathing.md";
  rows.push_back({"1.5 ml", "volume missed, %", 0.0, stepErrorPercent(lung, 1.5),
                  Limit::difference(0.1), linear});
  rows.push_back({"50 ml", "volume missed, %", 0.0, stepErrorPercent(lung, 50.0),
                  Limit::difference(2.0), linear});
  rows.push_back({"500 ml", "volume missed, %", 0.0, stepErrorPercent(lung, 500.0),
                  Limit::difference(15.0), linear});
  // "It is the surface area for a given volume": j by the area.
  VolumeSteps steps(lung.mesh, lung.shot, lung.directions);
  double delivered = 0.0;
  const std::vector<Vec3> areas = vertexAreaVectors(lung.mesh);
  for (std::size_t n = 0; n < areas.size(); ++n) {
    delivered += steps.displacement()[n].dot(areas[n]) / areaMm2(lung.mesh);
  }
  rows.push_back({"50 ml",
                  "volume delivered by j / area, %",
                  100.0,
                  100.0 * delivered,
                  {},
                  "the paper's words; j / area has the right dimension and the wrong size"});
  for (int n = 0; n < 333; ++n) steps.step(1500.0);
  for (int n = 0; n < 333; ++n) steps.step(-1500.0);
  double most = 0.0;
  for (std::size_t n = 0; n < areas.size(); ++n) {
    most = std::max(most, (steps.surface().points[n] - lung.mesh.points[n]).norm());
  }
  rows.push_back({"333 in, 333 out", "distance from the beginning, mm", 0.0, most,
                  Limit::difference(1e-10), "500 ml in steps of 1.5 ml"});
  rows.push_back({"a point", "operations for a step", 3.0, 3.0, Limit::difference(0.0),
                  "three additions; counted in the code, as in the paper, not measured"});
}

/// Root mean square and largest, deg.
std::array<double, 2> anglesBetween(std::span<const Vec3> a, std::span<const Vec3> b) {
  std::array<double, 2> angles{};
  for (std::size_t n = 0; n < a.size(); ++n) {
    const double angle = degrees(angleBetween(a[n], b[n]));
    angles[0] += angle * angle / static_cast<double>(a.size());
    angles[1] = std::max(angles[1], angle);
  }
  angles[0] = std::sqrt(angles[0]);
  return angles;
}

void directionTable(StrainRows& rows, const StrainedLung& lung) {
  const std::array<double, 2> once = anglesBetween(lung.directions, lung.normals);
  std::vector<Vec3> many = lung.directions;
  for (int pass = 1; pass < 20; ++pass) {
    many = strainDirections(lung.neighbours, lung.shot, many);
  }
  const std::array<double, 2> often = anglesBetween(many, lung.normals);
  const char* onePass = "one pass from old normals to new; the paper does not say how often";
  rows.push_back({"one pass", "angle to the normal, rms, deg", NotPublished, once[0],
                  Limit::range(0.0, 15.0), onePass});
  rows.push_back({"one pass", "angle to the normal, largest, deg", NotPublished, once[1],
                  Limit::range(0.0, 90.0), "no point goes inwards"});
  rows.push_back({"20 passes",
                  "angle to the normal, rms, deg",
                  NotPublished,
                  often[0],
                  {},
                  "repeated it smooths without an end"});
  rows.push_back({"20 passes",
                  "angle to the normal, largest, deg",
                  NotPublished,
                  often[1],
                  {},
                  "repeated it smooths without an end"});
}

void missingTable(StrainRows& rows, const StrainedLung& lung) {
  const auto points = static_cast<double>(lung.mesh.points.size());
  rows.push_back({"coarse lung",
                  "points",
                  255.0,
                  points,
                  {},
                  "the paper's two models are not to be had; the right lung of our sample stands "
                  "for both"});
  rows.push_back({"fine lung",
                  "points",
                  3e6,
                  points,
                  {},
                  "of the Visible Human; the paper's \"interactive frame rates\" for it on a "
                  "GeForce 4 have no figure, and its 81 operations for a point of a NURBS surface "
                  "are another method's"});
}

/// Lungs at rest and breathed in, all surfaces whole lungs.
void addStrainFigures(const std::map<Side, TriangleMesh>& walls, Reproduction& result) {
  std::vector<LobeSurface> rest;
  std::vector<LobeSurface> inspired;
  double wholeMm3 = 0.0;
  for (const auto& [side, wall] : walls) wholeMm3 += signedVolumeMm3(wall);
  for (const auto& [side, wall] : walls) {
    const StrainedLung lung(wall);
    const VolumeSteps steps(lung.mesh, lung.shot, lung.directions);
    const double restMm3 = signedVolumeMm3(wall);
    const double wanted = restMm3 * (1.0 + DeepMm3 / wholeMm3);
    const double scale =
        scaleForVolume(volumePolynomial(wall, steps.displacement()), wanted).value_or(0.0);
    TriangleMesh moved = wall;
    for (std::size_t n = 0; n < moved.points.size(); ++n) {
      moved.points[n] += scale * steps.displacement()[n];
    }
    const Lobe lobe = side == Side::Right ? Lobe::RightLower : Lobe::LeftLower;
    rest.push_back({lobe, "rest", std::make_shared<const TriangleMesh>(wall), {}});
    inspired.push_back({lobe, "inspired", std::make_shared<const TriangleMesh>(moved), {}});
  }
  for (auto& [name, surfaces] : {std::pair("rest", &rest), std::pair("inspired", &inspired)}) {
    LungModel model;
    model.surfaces = std::make_shared<const std::vector<LobeSurface>>(std::move(*surfaces));
    result.figures.push_back({name, std::move(model)});
  }
}

void reproduceSanthanam2003(const ReproduceOptions& options, Reproduction& result,
                            const Progress& progress) {
  const std::map<Side, TriangleMesh> walls = sampleWalls();
  const StrainedLung lung(walls.at(Side::Right));
  double done = 0.1;
  for (const PaperTable& named : StrainTables) {
    progress.report(done);
    done += 0.15;
    if (!wanted(options, named.id)) continue;
    ReproducedTable table{std::string(named.id), std::string(named.name), {}};
    if (table.id == "assignment") assignmentTable(table.rows);
    if (table.id == "sharing") sharingTable(table.rows, lung);
    if (table.id == "strain") strainTable(table.rows, lung);
    if (table.id == "volume") volumeTable(table.rows, lung);
    if (table.id == "directions") directionTable(table.rows, lung);
    if (table.id == "missing") missingTable(table.rows, lung);
    result.tables.push_back(std::move(table));
  }
  if (options.figures) addStrainFigures(walls, result);
}

}  // namespace

const Paper& santhanam2003() {
  static const Paper paper{
      "santhanam-2003",
      "Santhanam, Pattanaik, Rolland, Norfleet, Imielinska. Physiologically-based modeling and "
      "visualization of deformable lungs. Pacific Graphics 2003",
      StrainTables, reproduceSanthanam2003};
  return paper;
}

}  // namespace pneuma
