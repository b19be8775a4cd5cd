#pragma once

#include <string>

#include "geometry/mesh_doctor.h"
#include "io/json.h"

namespace pneuma::cli {

/// The "health" object of the info and repair reports.
Json toJson(const MeshReport& report);

/// The same for people, as indented lines.
std::string textOf(const MeshReport& report);

}  // namespace pneuma::cli
