#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// How a built-in organ differs from its default.
struct OrganOptions {
  double sizeMl = 0.0;  ///< volume; 0: the organ's own
  std::filesystem::path airwayTable =
      {};  ///< central airways instead of the organ's own; may be empty

  static constexpr auto fields() {
    return std::tuple{Field{"organ-size", &OrganOptions::sizeMl, "ml", Range{0.0, 1e5},
                            "Volume of a built-in organ; 0: its own."}};
  }
};

/// Names of the built-in organs: "right-lung" (Huang 2004); "simple", "sphere", "cylinder", "cube"
/// and "thorax" (Kitaoka 1999).
std::span<const std::string_view> organNames();

/// A built-in organ with its central airways, as a model that can be grown in. A table of airways
/// is for the organ's own size and is enlarged with it.
/// @throws InvalidOption for an unknown name, a size out of range, or a table for the right lung;
///         InputMissing, InvalidInput (see readAirwayTable, growPredefined; a size no organ has)
LungModel openOrgan(std::string_view name, const OrganOptions& options = {});

/// The regions of an organ as closed surfaces, for pictures; sampled on a lattice of `cellMm`.
std::shared_ptr<const std::vector<LobeSurface>> surfacesOf(const std::vector<LobeRegion>& regions,
                                                           double cellMm);

}  // namespace pneuma
