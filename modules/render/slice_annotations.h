#pragma once

#include "render/slice_picture.h"

namespace pneuma {

/// Draws crosshair and markers of a slice, and, if the look asks for them, which slice it is,
/// orientation letters on all sides, a scale bar and the window, in the corners round the patient.
void annotate(Picture& picture, const SliceContents& contents, const SliceFrame& frame,
              const SliceLook& look);

}  // namespace pneuma
