#pragma once

#include <string>

#include "io/json.h"
#include "pipeline/project.h"

namespace pneuma::cli {

/// What `pneuma info` tells of a project.
Json projectJson(const Project& project);
std::string projectText(const Project& project);

}  // namespace pneuma::cli
