#pragma once

#include "pipeline/kitaoka_tables.h"

namespace pneuma {

/// "A 3D model of the human airway tree" of Kitaoka 1999: what the text and Fig. 7 say of the
/// thorax.
KitaokaTable kitaokaThoraxTable();

/// What the text says beyond tables and thorax.
KitaokaTable kitaokaClaimsTable();

}  // namespace pneuma
