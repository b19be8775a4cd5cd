#pragma once

namespace pneuma {

/// Makes what VTK keeps once for the whole process safe for pictures that are drawn on several
/// threads at a time, as a film or a report is beside the window: its texts, which share one cache
/// of glyphs without a lock, and its log of times. To be called before VTK draws or measures a
/// text; calls after the first do nothing.
void prepareVtk();

}  // namespace pneuma
