#pragma once

#include "core/image.h"
#include "core/progress.h"

namespace pneuma {

/// Takes gas of stomach and bowel that hangs together with a lung through a thin dome of the
/// diaphragm out of that lung (its label becomes 0), and returns how much it was, ml.
///
/// Gas is what in the lower third of the lungs is as thin as air over a wide space (under -930 HU
/// when blurred by 2 mm, 20 ml or more), is uniform (standard deviation under 35 HU), and opens
/// into the lung on a small part of its surface only, through something denser: a wall that the
/// slices blur. What goes over into the lung on a wide front is emphysema, and stays.
/// @param labels 10 and 20 in the air of the lungs
double removeGasPockets(const CtImage& ct, LabelImage& labels, const Progress& progress = {});

}  // namespace pneuma
