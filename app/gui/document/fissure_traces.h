#pragma once

#include <map>
#include <memory>

#include "pipeline/fissure_tracing.h"
#include "pipeline/lobe_edits.h"

namespace pneuma {

/// How the fissures of some edits lie in the lungs, and where they show in the CT.
struct FissureTraces {
  LobeEdits edits;
  TracedFissures fissures;
  std::map<Fissure, std::shared_ptr<const ShownParts>> parts;  ///< of those whose completeness
                                                               ///< is known
};

/// @param fissures of the edits
std::shared_ptr<const FissureTraces> fissureTraces(LobeEdits edits, TracedFissures fissures);

/// What shows of fissures in a CT, by lung; as long as CT and labels are the same.
struct CtSheets {
  std::shared_ptr<const CtImage> ct;
  std::shared_ptr<const LabelImage> labels;
  std::map<Side, std::shared_ptr<const SheetnessImage>> of;
};

}  // namespace pneuma
