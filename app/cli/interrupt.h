#pragma once

namespace pneuma::cli {

/// From now on Ctrl-C, SIGTERM, the end of the terminal (SIGHUP), of the time on a processor
/// (SIGXCPU), of who reads what is printed (SIGPIPE) and an alarm are remembered instead of ending
/// the process, so that a command can stop between two steps and leave nothing half written. SIGHUP
/// (`nohup`) and SIGPIPE stay ignored where they are. A file size limit is an error of the write
/// that meets it.
void rememberSignals();

/// The number of the first signal that asked to stop, 0 if there was none.
int receivedSignal();

/// True if what the command prints goes into a pipe that nobody reads any more.
bool nobodyReads();

}  // namespace pneuma::cli
