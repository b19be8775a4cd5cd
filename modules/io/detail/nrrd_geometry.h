#pragma once

#include "io/detail/header_lines.h"
#include "io/volume_file.h"

namespace pneuma {

/// Size and place of an NRRD volume, LPS, mm; frame and assumptions go into `header`.
/// @throws InvalidInput, Unsupported
void readNrrdGeometry(const HeaderFields& fields, VolumeHeader& header, const std::string& name);

}  // namespace pneuma
