#include "document/fissure_traces.h"

#include <utility>

namespace pneuma {

std::shared_ptr<const FissureTraces> fissureTraces(LobeEdits edits, TracedFissures fissures) {
  auto traces = std::make_shared<FissureTraces>();
  traces->edits = std::move(edits);
  for (const auto& [fissure, traced] : fissures) {
    if (!traced.complete) continue;
    traces->parts[fissure] = std::make_shared<const ShownParts>(traced.used.surface, *traced.patch,
                                                                traced.complete->onSheet);
  }
  traces->fissures = std::move(fissures);
  return traces;
}

}  // namespace pneuma
