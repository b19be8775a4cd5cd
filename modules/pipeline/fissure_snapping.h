#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "core/progress.h"
#include "pipeline/fissure_surfaces.h"
#include "pipeline/lung_model.h"
#include "segmentation/fissure_sheetness.h"

namespace pneuma {

/// How fissures are drawn onto what shows in a CT.
struct SnapOptions {
  double pointsMm = 3.0;
  double surfaceMm = 15.0;
  double angleDeg = 30.0;
  double coherenceMm = 2.0;
  double strength = 4.0;

  static constexpr auto fields() {
    return std::tuple{
        Field{"snap-points", &SnapOptions::pointsMm, "mm", Range{0.5, 10.0},
              "How far a given point is drawn onto a fissure that shows in the CT."},
        Field{"snap-surface", &SnapOptions::surfaceMm, "mm", Range{0.5, 25.0},
              "How far around a proposed fissure or a plane the real one is looked for."},
        Field{"snap-angle", &SnapOptions::angleDeg, "deg", Range{5.0, 60.0},
              "How far what shows in the CT may be turned against the fissure."},
        Field{"snap-coherence", &SnapOptions::coherenceMm, "mm", Range{0.5, 5.0},
              "How far it may be off in the places around, and off a fissure that it completes."},
        Field{"snap-strength", &SnapOptions::strength, "HU/mm2", Range{0.5, 100.0},
              "Sheetness that a fissure must have."},
    };
  }

  bool operator==(const SnapOptions&) const = default;
};

/// Of thicker slices nothing of a fissure is left to be found: 1 to 2 % of it.
inline constexpr double ThickestSliceMm = 1.5;

bool hasThinSlices(const ImageGeometry& geometry);

inline bool hasThinSlices(const CtImage& ct) { return hasThinSlices(ct.geometry); }

/// @throws Unsupported unless hasThinSlices()
void requireThinSlices(const CtImage& ct);

/// Sheets in one lung of a model's CT: about a second, to be done once and kept.
/// @param model with CT, its labels and the lung's surface
/// @throws as requireThinSlices() and fissureSheetness(); InvalidInput if the CT is another's
SheetnessImage fissureSheets(const LungModel& model, Side side, const Progress& progress = {});

/// Points of a fissure after snapping.
struct SnappedPoints {
  std::vector<Vec3> points;           ///< LPS, mm
  std::vector<std::uint8_t> onSheet;  ///< 1 where a sheet was found; the others stay as they were
};

/// Draws points along the normal of their surface onto the strongest coherent sheet.
SnappedPoints snapPoints(const SheetnessImage& sheets, const HeightSurface& surface,
                         const std::vector<Vec3>& points, const SnapOptions& options = {});

/// What became of one fissure.
struct FissureSnapping {
  SnappedPoints points;      ///< that were given
  double shareBefore = 0.0;  ///< of the surface within the lung that has a sheet within 1 mm
  double shareAfter = 0.0;   ///< no less
};

using FissureSnappings = std::map<Fissure, FissureSnapping>;

/// Draws the fissures of one lung onto sheets. Given points go one by one, and a surface through
/// them is made anew. A proposal or plane goes as a whole: a smooth sheet is looked for in its
/// surroundings, and where there is none the surface has what is beside it. A fissure that would
/// lie on no more of a sheet than before stays (docs/algorithms/snapping.md).
/// @param given the points of these fissures
/// @param warnings gets whole sentences
/// @throws InvalidOption, Cancelled
FissureSnappings snapFissures(UsedFissures& fissures, const SheetnessImage& sheets,
                              const GivenFissures& given, const LobeOptions& lobeOptions,
                              const SnapOptions& options, std::vector<std::string>& warnings,
                              const Progress& progress = {});

/// How much of a fissure shows.
struct Completeness {
  double share = 0.0;                 ///< of the patch's area, in [0, 1]
  std::vector<std::uint8_t> onSheet;  ///< of its triangles: 1 where a coherent sheet is
};

/// The share of a contact between lobes that lies on a coherent sheet. Its rim, 2 mm wide, cannot
/// be measured; it does not count, and has the marks of what is beside it.
Completeness completeness(const SheetnessImage& sheets, const TriangleMesh& patch,
                          const SnapOptions& options = {}, const Progress& progress = {});

}  // namespace pneuma
