#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/image.h"
#include "core/triangle_mesh.h"

// What a project holds as texts of files that other programs read, and that come back to the bit:
// the numbers of points and triangles, too, which readSurface() does not promise.
namespace pneuma {

/// Values of points or triangles, by the names that they have in a file.
using ByteMarks = std::map<std::string, std::vector<std::uint8_t>>;

/// A surface with values, or points alone.
struct MarkedMesh {
  TriangleMesh mesh;
  ByteMarks ofPoints;
  ByteMarks ofTriangles;
};

/// A PLY (binary, little endian, coordinates as double).
std::string exactPly(const MarkedMesh& mesh);

/// @param name for messages
/// @throws InvalidInput unless it is as exactPly() writes, with triangles of points that there are
MarkedMesh meshOfExactPly(const std::string& content, const std::string& name);

/// An NRRD, not compressed. Its header rounds where the voxels lie: the geometry goes elsewhere.
std::string exactNrrd(const CtImage& image);
std::string exactNrrd(const LabelImage& image);

/// @param geometry that the image had @throws InvalidInput unless it is as exactNrrd() writes
CtImage ctOfExactNrrd(const std::string& content, const ImageGeometry& geometry,
                      const std::string& name);
LabelImage labelsOfExactNrrd(const std::string& content, const ImageGeometry& geometry,
                             const std::string& name);

/// A tree from what treeText(tree, "vtp") gave. @throws as readTree()
AirwayTree treeOfVtpText(const std::string& content, const std::string& name);

}  // namespace pneuma
