#pragma once

#include <string>

#include "core/error.h"

namespace pneuma::testing {

/// The sentence of the InvalidInput that `work` ends with; "" if it ends well.
template <class Work>
std::string refusalOf(const Work& work) {
  try {
    work();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

}  // namespace pneuma::testing
