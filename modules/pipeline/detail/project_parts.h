#pragma once

#include "io/tree_file.h"
#include "pipeline/detail/project_reader.h"
#include "pipeline/detail/project_writer.h"
#include "pipeline/project.h"

// The members of everything that a project keeps but lungs in a CT and the project itself, each
// listed once for saving and opening.
namespace pneuma {

template <class Archive, class T>
requires Is<T, ImageGeometry>

void describe(Archive& archive, T& geometry) {
  archive("size", geometry.size);
  archive("spacing", geometry.spacing);
  archive("origin", geometry.origin);
  archive("direction", geometry.direction);
}

template <class Archive, class T>
requires Is<T, LabelImage>

void describe(Archive& archive, T& labels) {
  bool empty = labels.voxels.empty();
  archive("empty", empty);
  if (empty) return;
  archive("geometry", labels.geometry);
  if constexpr (Archive::Reading) {
    labels = labelsOfExactNrrd(archive.file("file"), labels.geometry, archive.where());
  } else {
    archive.file("file", "labels", ".nrrd", exactNrrd(labels));
  }
}

template <class Archive, class T>
requires Is<T, TriangleMesh>

void describe(Archive& archive, T& mesh) {
  if constexpr (Archive::Reading) {
    mesh = meshOfExactPly(archive.file("file"), archive.where()).mesh;
  } else {
    archive.file("file", "surfaces", ".ply", exactPly({mesh, {}, {}}));
  }
}

template <class Archive, class T>
requires Is<T, AirwayTree>

void describe(Archive& archive, T& tree) {
  std::size_t branches = tree.size();
  archive("branches", branches);
  if (branches == 0) return;
  if constexpr (Archive::Reading) {
    tree = treeOfVtpText(archive.file("file"), archive.where());
    if (tree.size() != branches) archive.fail("has a tree of another size");
  } else {
    archive.file("file", "trees", ".vtp", treeText(tree, "vtp"));
  }
}

template <class Archive, class T>
requires Is<T, Box3>

void describe(Archive& archive, T& box) {
  archive("low", box.min());
  archive("high", box.max());
}

template <class Archive, class T>
requires Is<T, MeshReport>

void describe(Archive& archive, T& report) {
  archive("points", report.points);
  archive("triangles", report.triangles);
  archive("components", report.components);
  archive("open_edges", report.openEdges);
  archive("non_manifold_edges", report.nonManifoldEdges);
  archive("non_manifold_vertices", report.nonManifoldVertices);
  archive("misoriented_edges", report.misorientedEdges);
  archive("degenerate_triangles", report.degenerateTriangles);
  archive("duplicate_triangles", report.duplicateTriangles);
  archive("self_intersections", report.selfIntersections);
  archive("self_intersections_counted", report.selfIntersectionsCounted);
  archive("closed", report.closed);
  archive("manifold", report.manifold);
  archive("oriented_outwards", report.orientedOutwards);
  archive("volume_ml", report.volumeMl);
  archive("area_mm2", report.areaMm2);
  archive("box", report.box);
  archive("units_guess", report.unitsGuess);
}

template <class Archive, class T>
requires Is<T, LobeSurface>

void describe(Archive& archive, T& surface) {
  archive("lobe", surface.lobe);
  archive.named(std::string(shortName(surface.lobe)));
  archive("name", surface.name);
  archive("mesh", surface.mesh);
  archive("health", surface.health);
  if constexpr (Archive::Reading) {
    if (!surface.mesh) archive.fail("has no mesh");
  }
}

/// So that a list of surfaces can be shared.
template <class Archive, class T>
requires Is<T, std::vector<LobeSurface>>

void describe(Archive& archive, T& surfaces) { archive("surfaces", surfaces); }

template <class Archive, class T>
requires Is<T, FissurePlane>

void describe(Archive& archive, T& plane) {
  archive("point", plane.point);
  archive("normal", plane.normal);
}

template <class Archive, class T>
requires Is<T, FissureEquation>

void describe(Archive& archive, T& equation) {
  archive("origin", equation.origin);
  archive("coefficients", equation.coefficients);
}

template <class Archive, class T>
requires Is<T, FissurePatch>

void describe(Archive& archive, T& patch) {
  std::string name = patch.file.filename().string();  // folders may carry names of people
  archive("name", name);
  if constexpr (Archive::Reading) patch.file = name;
  archive("mesh", patch.mesh);
  archive("notes", patch.notes);
  if constexpr (Archive::Reading) {
    if (!patch.mesh) archive.fail("has no mesh");
  }
}

template <class Archive, class T>
requires Is<T, GivenFissure>

void describe(Archive& archive, T& given) {
  archive("points", given.points);
  archive("weights", given.weights);
  archive("plane", given.plane);
  archive("equation", given.equation);
  archive("patch", given.patch);
}

template <class Archive, class T>
requires Is<T, FissureEdit>

void describe(Archive& archive, T& edit) {
  archive("method", edit.method);
  archive("points", edit.points);
  archive("weights", edit.weights);
  archive("handles", edit.handles);
  archive("read", edit.read);
}

template <class Archive, class T>
requires Is<T, LobeEdits>

void describe(Archive& archive, T& edits) {
  archive("fissures", edits.fissures);
  archive("options", edits.options);
  archive("shares", edits.shares);
  archive("snap", edits.snap);
}

template <class Archive, class T>
requires Is<T, FissureReview>

void describe(Archive& archive, T& review) {
  archive("edits", review.edits);
  archive("skipped", review.skipped);
}

template <class Archive, class T>
requires Is<T, HeightSurface>

void describe(Archive& archive, T& surface) {
  archive("centre", surface.centre);
  archive("axes", surface.axes);
  archive("scale", surface.scale);
  archive("quadratic", surface.quadratic);
  archive("knots", surface.knots);
  archive("weights", surface.weights);
  if constexpr (Archive::Reading) {
    if (surface.knots.size() != surface.weights.size()) archive.fail("has knots without weights");
  }
}

template <class Archive, class T>
requires Is<T, FissureSheet>

void describe(Archive& archive, T& sheet) {
  archive("mesh", sheet.mesh);
  archive("extend_mm", sheet.extendMm);
}

template <class Archive, class T>
requires Is<T, UsedFissure>

void describe(Archive& archive, T& used) {
  archive("surface", used.surface);
  archive("sheet", used.sheet);
  archive("source", used.source);
  archive("points", used.points);
  archive("left_out_mm", used.leftOutMm);
  archive("mean_mm", used.meanMm);
  archive("coverage", used.coverage);
  archive("largest_mm", used.largestMm);
}

template <class Archive, class T>
requires Is<T, SplitReport>

void describe(Archive& archive, T& report) {
  archive("rounds", report.rounds);
  archive("pieces_joined", report.piecesJoined);
  archive("joined_mm3", report.joinedMm3);
  archive("contact_mm2", report.contactMm2);
  archive("lowest_mm", report.lowestMm);
  archive("highest_mm", report.highestMm);
  archive("moved_mm", report.movedMm);
}

template <class Archive, class T>
requires Is<T, RegionComplex>

void describe(Archive& archive, T& complex) {
  if constexpr (Archive::Reading) {
    MarkedMesh marked = meshOfExactPly(archive.file("file"), archive.where());
    const auto& behind = marked.ofTriangles["behind"];
    const auto& front = marked.ofTriangles["front"];
    const std::size_t count = marked.mesh.triangles.size();
    if (behind.size() != count || front.size() != count) archive.fail("has facets of no region");
    complex.points = std::move(marked.mesh.points);
    complex.facets.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      complex.facets[i] = {marked.mesh.triangles[i], behind[i], front[i]};
    }
  } else {
    MarkedMesh marked{{complex.points, {}}, {}, {}};
    for (const Facet& facet : complex.facets) {
      marked.mesh.triangles.push_back(facet.corners);
      marked.ofTriangles["behind"].push_back(facet.behind);
      marked.ofTriangles["front"].push_back(facet.front);
    }
    archive.file("file", "surfaces", ".ply", exactPly(marked));
  }
}

template <class Archive, class T>
requires Is<T, SplitLung>

void describe(Archive& archive, T& lung) {
  archive("side", lung.side);
  archive.named(std::string(name(lung.side)));
  archive("complex", lung.complex);
  archive("reports", lung.reports);
}

template <class Archive, class T>
requires Is<T, SnappedPoints>

void describe(Archive& archive, T& points) {
  archive("points", points.points);
  archive("on_sheet", points.onSheet);
}

template <class Archive, class T>
requires Is<T, FissureSnapping>

void describe(Archive& archive, T& snapping) {
  archive("points", snapping.points);
  archive("share_before", snapping.shareBefore);
  archive("share_after", snapping.shareAfter);
}

template <class Archive, class T>
requires Is<T, Completeness>

void describe(Archive& archive, T& complete) {
  archive("share", complete.share);
  archive("on_sheet", complete.onSheet);
}

template <class Archive, class T>
requires Is<T, LobeShape>

void describe(Archive& archive, T& shape) {
  archive("faults", shape.faults);
  archive("pieces", shape.pieces);
  archive("genus", shape.genus);
  archive("area_mm2", shape.areaMm2);
}

template <class Archive, class T>
requires Is<T, PartedLobe>

void describe(Archive& archive, T& parted) {
  archive("name", parted.name);
  archive("lobe", parted.lobe);
  archive("used", parted.used);
  archive("report", parted.report);
  archive("below", parted.below);
  archive("above", parted.above);
  archive("patch", parted.patch);
  archive("lobe_mm3", parted.lobeMm3);
  archive("below_mm3", parted.belowMm3);
  archive("above_mm3", parted.aboveMm3);
}

template <class Archive, class T>
requires Is<T, LobesOfLungs>

void describe(Archive& archive, T& lobes) {
  archive("fissures", lobes.fissures);
  archive("lungs", lobes.lungs);
  archive("lung_mm3", lobes.lungMm3);
  archive("lobe_mm3", lobes.lobeMm3);
  archive("snapped", lobes.snapped);
  archive("complete", lobes.complete);
  archive("shapes", lobes.shapes);
  archive("parted", lobes.parted);
  archive("warnings", lobes.warnings);
}

}  // namespace pneuma
