#include "cli/mesh_report.h"

#include "cli/text.h"

namespace pneuma::cli {
namespace {

Json pointJson(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

std::string yesNo(bool value) { return value ? "yes" : "no"; }

}  // namespace

Json toJson(const MeshReport& report) {
  Json json = {
      {"healthy", report.healthy()},
      {"fit_to_grow", report.fitToGrow()},
      {"points", report.points},
      {"triangles", report.triangles},
      {"components", report.components},
      {"open_edges", report.openEdges},
      {"non_manifold_edges", report.nonManifoldEdges},
      {"non_manifold_points", report.nonManifoldVertices},
      {"misoriented_edges", report.misorientedEdges},
      {"degenerate_triangles", report.degenerateTriangles},
      {"duplicate_triangles", report.duplicateTriangles},
      {"self_intersections", nullptr},
      {"closed", report.closed},
      {"manifold", report.manifold},
      {"oriented_outwards", report.orientedOutwards},
      {"volume_ml", report.volumeMl},
      {"area_mm2", report.areaMm2},
      {"box_mm", {{"min", pointJson(report.box.min())}, {"max", pointJson(report.box.max())}}},
      {"units_guess", report.unitsGuess},
  };
  if (report.selfIntersectionsCounted) json["self_intersections"] = report.selfIntersections;
  return json;
}

std::string textOf(const MeshReport& report) {
  const auto count = [](std::size_t n) { return grouped(static_cast<double>(n)); };
  const Vec3 size = report.box.sizes();
  return table({
      {"triangles", count(report.triangles)},
      {"points", count(report.points)},
      {"pieces", count(report.components)},
      {"size", fixed(size.x(), 1) + " x " + fixed(size.y(), 1) + " x " + fixed(size.z(), 1)},
      {"units, guessed", report.unitsGuess},
      {"volume", fixed(report.volumeMl, 1) + " ml"},
      {"area", fixed(report.areaMm2 / 100.0, 1) + " cm2"},
      {"closed", yesNo(report.closed)},
      {"manifold", yesNo(report.manifold)},
      {"oriented outwards", yesNo(report.orientedOutwards)},
      {"open edges", count(report.openEdges)},
      {"non-manifold edges", count(report.nonManifoldEdges)},
      {"non-manifold points", count(report.nonManifoldVertices)},
      {"misoriented edges", count(report.misorientedEdges)},
      {"degenerate triangles", count(report.degenerateTriangles)},
      {"duplicate triangles", count(report.duplicateTriangles)},
      {"self-intersections", report.selfIntersectionsCounted ? count(report.selfIntersections)
                                                             : std::string("not counted")},
  });
}

}  // namespace pneuma::cli
