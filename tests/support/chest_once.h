#pragma once

#include "pipeline/sample_chest.h"

namespace pneuma::testing {

/// The sample chest as it comes, made once for all tests of a process.
inline const SampleChest& chest() {
  static const SampleChest made = sampleChest();
  return made;
}

}  // namespace pneuma::testing
