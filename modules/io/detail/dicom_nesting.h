#pragma once

#include <filesystem>
#include <string>

namespace pneuma {

/// Why vtk-dicom cannot be trusted with a DICOM file: it allocates what an element in one of
/// unknown length says to have, whatever the file holds, and follows sequences in sequences as deep
/// as the stack is. Follows the elements as its parser does (PS3.5, 7), without their values.
/// @returns the end of "FILE ...", "" if nothing is wrong with it; what is cut off outside of
/// sequences is left to the parser, which tells
/// @throws InputMissing if it cannot be read
std::string nestingFault(const std::filesystem::path& file);

}  // namespace pneuma
