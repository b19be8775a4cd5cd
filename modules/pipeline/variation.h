#pragma once

#include <cstdint>
#include <tuple>

#include "core/options.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// How much individuals differ in what growth starts from (Kitaoka 1999, "Discussion": the trunk
/// and the organ). Standard deviations of normal distributions, cut off at three of them.
struct VariationOptions {
  double trunkTurnDeg = 0.0;
  double trunkLength = 0.0;
  double organScale = 0.0;

  static constexpr auto fields() {
    using O = VariationOptions;
    return std::tuple{
        Field{"trunk-turn", &O::trunkTurnDeg, "deg", Range{0.0, 20.0},
              "Turn of the template airways about the start of the trunk, to any side."},
        Field{"trunk-length", &O::trunkLength, "", Range{0.0, 0.3},
              "Change of the length of the template airways' trunk, as a share of it."},
        Field{"organ-scale", &O::organScale, "", Range{0.0, 0.3},
              "Change of the size of organ and airways in every direction, as a share of it."},
    };
  }

  bool any() const { return *this != VariationOptions{}; }

  bool operator==(const VariationOptions&) const = default;
};

/// One individual like `model`: lobes and central airways scaled about the centre of the box around
/// the lobes, then template airways turned about the trunk's start and moved by the trunk's change
/// of length. Ends that lay in a lobe stay in it: a turn or length that would take one out is drawn
/// again. The surfaces of the model remain those that were read. The same seed gives the same
/// individual.
/// @throws InvalidOption naming a field out of range; InvalidInput if the trunk shall vary but the
///         central airways were measured, or if of 100 draws none keeps the ends inside; what
///         readyToGrow() throws
LungModel varied(const LungModel& model, const VariationOptions& options, std::uint64_t seed);

}  // namespace pneuma
