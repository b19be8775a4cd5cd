#pragma once

#include <string>

class vtkTextProperty;

namespace pneuma {

/// The font file of pictures: Inter where it is installed, else empty (VTK's own font).
const std::string& fontFile();

/// Gives a text the picture's font. @param pixels height of capitals and descenders together
void setFont(vtkTextProperty* property, int pixels);

}  // namespace pneuma
