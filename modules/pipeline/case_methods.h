#pragma once

#include <string>
#include <vector>

#include "pipeline/project.h"

namespace pneuma {

/// What was done with a person's lungs, in words that a paper can take over.
struct CaseMethods {
  std::string paragraph;
  std::vector<std::string> references;  ///< in the order of the paragraph's numbers [1], [2] ...
};

CaseMethods methodsOf(const ProjectState& state);

}  // namespace pneuma
