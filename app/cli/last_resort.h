#pragma once

namespace pneuma::cli {

/// Opens what the program was started without of standard input, output and error, so that no file
/// that is written takes its place. Writing to such an output fails.
void openStandardFiles();

/// Takes the stack that the limits allow. @throws Error with ExitCode::OutOfMemory if that is too
/// little for any work
void requireStack();

/// From now on, an end that nobody catches removes what is half written; if memory was out, as in a
/// destructor of a library, it says so and ends with the code of that. Libraries print nothing.
void handleLastResort();

}  // namespace pneuma::cli
