#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/fissure.h"
#include "core/math.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// A fissure as a plane, LPS, mm. The normal may have any length and either direction; above is
/// where it points up or to the front.
struct FissurePlane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
};

/// The normal of a plane that lies level, is tilted about the axis to the left, which raises its
/// back edge, and then turned about the axis to the back, which lowers its left edge.
Vec3 planeNormal(double tiltRad, double turnRad);

/// A fissure as an equation (Huang 2004, 2.3), LPS, mm: with x, y, z counted from the origin,
///   z = c0 + c1 x + c2 y + c3 x^2 + c4 x y + c5 y^2.
struct FissureEquation {
  Vec3 origin = Vec3::Zero();
  std::array<double, 6> coefficients{};
};

/// A fissure as a surface from a file, LPS, mm.
struct FissurePatch {
  std::filesystem::path file;
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<std::string> notes;  ///< whole sentences, of reading it
};

/// How a fissure is given: by a plane, an equation or a surface, or else by points that were set
/// upon it, LPS, mm.
struct GivenFissure {
  std::vector<Vec3> points;
  std::vector<double> weights;  ///< of the points; empty: all the same
  std::optional<FissurePlane> plane;
  std::optional<FissureEquation> equation;
  std::optional<FissurePatch> patch;
};

using GivenFissures = std::map<Fissure, GivenFissure>;

/// A fissure that not everybody has, and the lobe it parts.
struct AccessoryFissure {
  std::string name;  ///< small letters, digits and dashes, other than the three fissures' names
  Lobe lobe = Lobe::Whole;
  GivenFissure fissure;
};

/// What a file tells of fissures.
struct FissureFile {
  GivenFissures fissures;
  std::vector<AccessoryFissure> accessory;
};

/// Reads fissures: our JSON (schema pneuma/fissures/1); markups of 3D Slicer, .mrk.json or the
/// older .fcsv, LPS or RAS, whose points' labels or lists name the fissure (right-oblique-3, RH);
/// or the CSV of the Chest Imaging Platform (columns region, type, x, y, z; RIGHTLUNG,
/// LEFTLUNG or a lobe beside the fissure, OBLIQUEFISSURE or HORIZONTALFISSURE, in any case; other
/// rows are left out). Points without a place are left
/// out of markups.
/// @throws InputMissing; InvalidInput naming file and row or entry; Unsupported for another format
FissureFile readFissureFile(const std::filesystem::path& path);

/// A fissure by a surface. @throws as readSurface()
FissurePatch readFissurePatch(const std::filesystem::path& path);

/// The same without accessory fissures.
GivenFissures readFissures(const std::filesystem::path& path);

/// The same for a file that has to give every fissure by a plane.
/// @throws as readFissures(); InvalidInput naming one that is given otherwise
GivenFissures readPlanes(const std::filesystem::path& path);

/// The files of surfaces that fissures are given by.
std::vector<std::filesystem::path> patchFiles(const FissureFile& file);

/// Writes our JSON, or .mrk.json, .fcsv or .csv as readFissures() reads them, LPS.
/// @throws OutputFailed; Unsupported for another extension, or for what a format does not have
void writeFissures(const std::filesystem::path& path, const GivenFissures& fissures,
                   const std::vector<AccessoryFissure>& accessory = {});

/// Throws now what writeFissures() would for the extension. @throws Unsupported
void requireFissureFileName(const std::filesystem::path& path);

}  // namespace pneuma
