#pragma once

namespace pneuma {

/// From now on a signal that ends the window (log-out, Ctrl-C) removes what is half written and
/// what was unpacked of archives, and then ends it as it would have: work that is not saved is
/// offered when it starts again. So does a display that goes away. A second signal ends it at once;
/// signals that this process was started to ignore are ignored.
void tidyUpAtEndSignals();

}  // namespace pneuma
