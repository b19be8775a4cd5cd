#pragma once

#include "core/progress.h"
#include "document/snapshot.h"
#include "pipeline/project.h"

namespace pneuma {

/// What a project keeps of a snapshot; the rest is made anew from it.
ProjectState stateOf(const Snapshot& snapshot);

/// The snapshot of a state without its breath.
/// @param before of the same case, with which it may share things
Snapshot snapshotOf(const ProjectState& state, const Snapshot& before);

/// Makes lungs breathe as they did when they were saved.
/// @throws as breathe()
std::shared_ptr<const Breath> breathOf(const ProjectState& state, const Progress& progress);

}  // namespace pneuma
