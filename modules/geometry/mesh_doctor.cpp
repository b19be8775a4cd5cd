#include "geometry/mesh_doctor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/units.h"
#include "geometry/mesh_topology.h"
#include "geometry/self_intersections.h"

namespace pneuma {
namespace {

/// Height below this part of the longest side: rounding decides which way such a triangle faces.
constexpr double FlatHeight = 1e-12;

bool hasNoArea(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3 u = mesh.points[t[1]] - mesh.points[t[0]];
  const Vec3 v = mesh.points[t[2]] - mesh.points[t[0]];
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
  return u.cross(v).norm() <= FlatHeight * longest;
}

/// A piece of a surface that is closed by itself.
struct Piece {
  TriangleMesh mesh;  ///< shares nothing; only the points it uses
  Box3 box;
  double signedVolumeMm3 = 0.0;
};

std::vector<Piece> pieces(const TriangleMesh& mesh, const MeshTopology& topology) {
  std::vector<Piece> pieces(topology.components);
  std::vector<std::uint32_t> newIndex(mesh.points.size());
  std::vector<std::uint32_t> seenBy(mesh.points.size(), static_cast<std::uint32_t>(pieces.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t of = topology.componentOf[t];
    if (of >= pieces.size()) continue;
    Piece& piece = pieces[of];
    std::array<std::uint32_t, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k];
      if (seenBy[v] != of) {
        seenBy[v] = of;
        newIndex[v] = static_cast<std::uint32_t>(piece.mesh.points.size());
        piece.mesh.points.push_back(mesh.points[v]);
        piece.box.extend(mesh.points[v]);
      }
      triangle[k] = newIndex[v];
    }
    piece.mesh.triangles.push_back(triangle);
  }
  for (Piece& piece : pieces) piece.signedVolumeMm3 = signedVolumeMm3(piece.mesh);
  return pieces;
}

/// How often the closed surface winds around `p`: 1 inside if it faces outwards, -1 if inwards.
double windingNumber(const TriangleMesh& mesh, const Vec3& p) {
  double solidAngle = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    // Van Oosterom and Strackee 1983
    const Vec3 a = mesh.points[i] - p;
    const Vec3 b = mesh.points[j] - p;
    const Vec3 c = mesh.points[k] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    solidAngle += 2.0 * std::atan2(a.dot(b.cross(c)),
                                   la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return solidAngle / (4.0 * std::numbers::pi);
}

/// Every piece faces away from what the surface encloses: outwards, or inwards if it lies in
/// another piece and walls off a cavity.
bool facesOutwards(const TriangleMesh& mesh, const MeshTopology& topology,
                   const Progress& progress) {
  const std::vector<Piece> all = pieces(mesh, topology);
  for (const Piece& piece : all) {
    progress.throwIfStopped();
    double around = 0.0;
    for (const Piece& other : all) {
      if (&other == &piece || !other.box.contains(piece.mesh.points[0])) continue;
      around += windingNumber(other.mesh, piece.mesh.points[0]);
    }
    const bool cavity = std::lround(around) == 1;
    if (!cavity && std::lround(around) != 0) return false;
    if (cavity ? piece.signedVolumeMm3 >= 0.0 : piece.signedVolumeMm3 <= 0.0) return false;
  }
  return !all.empty();
}

/// The unit in which the surface has the size of a lung or a lobe.
std::string unitsOf(const Box3& box) {
  const double longest = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  if (longest >= 50.0 && longest < 500.0) return "mm";
  if (longest >= 5.0 && longest < 50.0) return "cm";
  if (longest >= 0.05 && longest < 0.5) return "m";
  return "unknown";
}

std::string counted(std::size_t n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string shortNumber(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

}  // namespace

bool MeshReport::healthy() const { return fitToGrow() && selfIntersections == 0; }

bool MeshReport::fitToGrow() const {
  constexpr std::size_t TrianglesPerIntersection = 200;
  return closed && manifold && orientedOutwards && degenerateTriangles == 0 &&
         duplicateTriangles == 0 && volumeMl > 0.0 &&
         selfIntersections * TrianglesPerIntersection <= triangles;
}

MeshReport examine(const TriangleMesh& mesh, SelfIntersections ask, const Progress& progress) {
  requireSound(mesh);
  progress.report(0.0);
  MeshReport report;
  report.points = mesh.points.size();
  report.triangles = mesh.triangles.size();
  report.areaMm2 = areaMm2(mesh);
  report.box = bounds(mesh);
  report.unitsGuess = unitsOf(report.box);
  for (const auto& triangle : mesh.triangles) {
    report.degenerateTriangles += hasNoArea(mesh, triangle) ? 1 : 0;
  }
  const MeshTopology found = topology(mesh);
  report.components = found.components;
  report.openEdges = found.openEdges;
  report.nonManifoldEdges = found.nonManifoldEdges;
  report.nonManifoldVertices = found.nonManifoldVertices;
  report.misorientedEdges = found.misorientedEdges;
  report.duplicateTriangles = found.duplicateTriangles;
  report.closed = found.components > 0 && found.oddEdges == 0;
  report.manifold =
      found.components > 0 && found.nonManifoldEdges == 0 && found.nonManifoldVertices == 0;
  progress.report(0.3);
  if (report.closed && report.misorientedEdges == 0) {
    report.orientedOutwards = facesOutwards(mesh, found, progress);
  }
  if (report.closed) report.volumeMl = millilitres(std::abs(signedVolumeMm3(mesh)));
  if (ask == SelfIntersections::Ask) {
    report.selfIntersections = selfIntersecting(mesh, progress).pairs;
    report.selfIntersectionsCounted = true;
  }
  progress.report(1.0);
  return report;
}

std::vector<std::string> complaints(const MeshReport& report) {
  const std::string repair = "; run `pneuma repair` on it";
  std::vector<std::string> list;
  const auto complain = [&](std::size_t n, const std::string& one, const std::string& many,
                            const std::string& rest) {
    if (n > 0) list.push_back("The surface has " + counted(n, one, many) + rest + ".");
  };
  if (report.triangles == 0) {
    list.push_back("The surface has no triangles; export it again.");
    return list;
  }
  complain(report.openEdges, "open edge", "open edges",
           ", so that it encloses nothing; run `pneuma repair` to close its holes");
  complain(report.nonManifoldEdges, "edge", "edges",
           " where more than two triangles meet" + repair);
  complain(report.nonManifoldVertices, "point", "points",
           " where it touches itself (non-manifold)" + repair);
  complain(report.misorientedEdges, "edge", "edges",
           " across which the orientation flips" + repair);
  complain(report.degenerateTriangles, "triangle", "triangles", " without area" + repair);
  complain(report.duplicateTriangles, "triangle", "triangles", " more than once" + repair);
  complain(report.selfIntersections, "pair", "pairs", " of triangles that cut each other" + repair);
  if (report.closed && report.misorientedEdges == 0 && !report.orientedOutwards) {
    list.push_back(
        report.volumeMl > 0.0
            ? "The surface is inside-out, or a piece of it is; run `pneuma repair` on it."
            : "The surface is closed but encloses no volume; export it again.");
  }
  const std::string length = shortNumber(report.box.sizes().maxCoeff()) + " mm long";
  if (report.unitsGuess == "cm" || report.unitsGuess == "m") {
    list.push_back("The surface is " + length +
                   ", far too short for a lobe: its coordinates seem to be in " +
                   (report.unitsGuess == "m" ? "metres" : "centimetres") +
                   "; convert it with `pneuma export --from-units " + report.unitsGuess + "`.");
  } else if (report.unitsGuess == "unknown") {
    list.push_back("The surface is " + length +
                   ", which no lung is in any common unit; check its units.");
  }
  return list;
}

}  // namespace pneuma
