#pragma once

#include <string>

namespace pneuma::cli {

/// The manual page pneuma(1), in roff: every command with its options, made of what the parsers
/// know. The same for every build of one version.
std::string manPage();

}  // namespace pneuma::cli
