#include "document/project_snapshot.h"

#include <utility>

#include "document/breath.h"
#include "document/text.h"
#include "pipeline/split_lobes.h"

namespace pneuma {

ProjectState stateOf(const Snapshot& snapshot) {
  ProjectState state;
  state.name = snapshot.name.toStdString();
  state.model = snapshot.model;
  state.lungOptions = snapshot.lungOptions;
  state.lungsFollow = snapshot.lungsFollow();
  state.lobeEdits = snapshot.lobeEdits;
  state.splitEdits = snapshot.splitEdits;
  state.reviews = snapshot.reviews;
  state.grownIn = snapshot.grownIn;
  if (snapshot.breath) state.breath = snapshot.breath->options;
  return state;
}

Snapshot snapshotOf(const ProjectState& state, const Snapshot& before) {
  Snapshot snapshot = nextSnapshot(before, state.model);
  snapshot.name = qtText(state.name);
  snapshot.lungOptions = state.lungOptions;
  snapshot.drawn = state.lungsFollow ? state.model.corrections : nullptr;
  snapshot.lobeEdits = state.lobeEdits;
  snapshot.splitEdits = state.splitEdits;
  snapshot.reviews = state.reviews;
  snapshot.grownIn = state.grownIn;
  snapshot.breath = nullptr;
  if (state.model.lobes == nullptr) {
    snapshot.traces = nullptr;
  } else if (!snapshot.traces || state.model.lobes != before.model.lobes) {
    snapshot.traces = fissureTraces(
        state.splitEdits, tracedFissures(*state.model.lobes, inputsOf(state.splitEdits).given));
  }
  return snapshot;
}

std::shared_ptr<const Breath> breathOf(const ProjectState& state, const Progress& progress) {
  BreathingLungs lungs = breathe(state.model, *state.breath, progress);
  Json report = breatheReport(state.model, lungs, *state.breath);
  return breathOf(state.model, std::move(lungs), *state.breath, std::move(report));
}

}  // namespace pneuma
