#pragma once

class QObject;

namespace pneuma {

/// From now on a signal that ends the window (log-out, Ctrl-C) removes what is half written and
/// what was unpacked of archives, and then ends it as it would have: work that is not saved is
/// offered when it starts again. So does a display that goes away.
/// @param owner lives as long as the program's event loop
void tidyUpAtEndSignals(QObject* owner);

}  // namespace pneuma
