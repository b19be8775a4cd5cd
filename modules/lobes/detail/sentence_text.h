#pragma once

#include <string>

#include "core/math.h"

namespace pneuma {

/// "-12.3 mm"
std::string lengthText(double mm);

/// "(12, -3, 40) mm"
std::string placeText(const Vec3& p);

}  // namespace pneuma
