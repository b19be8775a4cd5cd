#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// Sum of the lobes' volumes against the lung's, relative: rounding alone.
inline constexpr double MostPartitionError = 1e-12;

/// Something that is measured, and what it may be at most.
struct LobeCheck {
  std::string id;
  double value = 0.0;
  double limit = 0.0;

  bool ok() const { return value <= limit; }
};

/// [{"id", "value", "limit", "ok"}, ...]
Json toJson(std::span<const LobeCheck> checks);

/// What a folder of lobes was found to be.
struct LobeFolder {
  std::vector<InputFile> inputs;
  std::vector<LobeCheck> checks;
  std::vector<std::string> warnings;
};

/// Checks the files that `pneuma lobes` writes, or other surfaces of lobes, all over again:
/// - CLOSED: open, non-manifold and misoriented edges, pinched points of each lobe, and pieces that
///   are turned inside out;
/// - CUTS: pairs of triangles of a lobe that cut each other (exact);
/// - LUNG: the same faults of what encloses all lobes of a lung;
/// - OVERLAP: triangles that two lobes have, turned the same way;
/// - PARTITION: sum of the lobes' volumes against what encloses them;
/// - SHARED: triangles of a fissure's file that are not in both lobes beside it, bit by bit;
/// - VOLUME: volumes against the report beside the files;
/// - LABELS: share of the lobes' voxels in the label image that lie in another lobe's surface.
/// @throws InputMissing, InvalidInput as openLobes(); Cancelled
LobeFolder checkLobes(const std::filesystem::path& folder, const Progress& progress = {});

/// The report of `pneuma check` ("pneuma/check/1"), and the same for people.
Json checkReport(const LobeFolder& folder);
std::string checkText(const LobeFolder& folder);

}  // namespace pneuma
