#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace pneuma {

/// A surface as it stands in a file, converted to LPS but to nothing else.
struct SurfaceFile {
  TriangleMesh mesh;                ///< equal points joined, polygons cut into triangles
  std::string format;               ///< "STL", "OBJ", "PLY", "VTP"
  std::string space;                ///< "LPS" or "RAS" as the file says, "" if it does not
  std::vector<std::uint8_t> lobes;  ///< of each triangle, by a VTP's array "lobe"; none without one
  std::vector<std::string> notes;   ///< whole sentences: what was converted or left out
};

/// Reads STL (binary or ASCII), OBJ, PLY or VTP. The content decides on the format, then the
/// extension. Sizes are checked before anything is allocated.
/// @throws InputMissing, InvalidInput (empty, truncated, garbage, NaN, no triangles), Unsupported
SurfaceFile readSurface(const std::filesystem::path& path);

/// True if the extension is one of readSurface's.
bool isSurfaceFileName(const std::filesystem::path& path);

/// What a file says about the coordinates in it.
struct SurfaceTags {
  std::string space = "LPS";  ///< "LPS" or "RAS"
  std::string units = "mm";   ///< "mm", "cm" or "m"
};

/// Values of the triangles of a surface, by the names that their arrays have in a file.
using TriangleMarks = std::map<std::string, std::vector<std::uint8_t>>;

/// Writes STL (binary), PLY, OBJ or VTP by the extension. Coordinates are written as they are;
/// the file says by `tags` what they are.
/// @param marks one value for each triangle; only VTP holds them
/// @throws OutputFailed; Unsupported for another extension
void writeSurface(const std::filesystem::path& path, const TriangleMesh& mesh,
                  const SurfaceTags& tags = {}, const TriangleMarks& marks = {});

/// Values of the points and triangles of a surface for VTP, by the names of their arrays.
struct SurfaceArrays {
  std::map<std::string, std::vector<Vec3>> pointVectors;
  std::map<std::string, std::vector<double>> pointValues;
  TriangleMarks triangleMarks;
  std::map<std::string, double> fieldValues;  ///< one each for the whole surface
};

/// Writes a VTP with arrays: as many values as points, or as triangles.
/// @throws OutputFailed
void writeVtpSurface(const std::filesystem::path& path, const TriangleMesh& mesh,
                     const SurfaceArrays& arrays);

}  // namespace pneuma
