#pragma once

namespace pneuma::cli {

/// From now on Ctrl-C, SIGTERM and an alarm are remembered instead of ending the process, so that a
/// command can stop between two steps and leave nothing half written; a file size limit is an error
/// of the write that meets it.
void rememberSignals();

/// The number of the last signal that asked to stop, 0 if there was none.
int receivedSignal();

}  // namespace pneuma::cli
