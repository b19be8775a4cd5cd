#pragma once

#include <string>

namespace pneuma {

/// Why nothing can be drawn here, as the beginning of a sentence; empty if it can.
/// Asks the X server itself: VTK would end the process where there is none.
std::string displayProblem();

}  // namespace pneuma
