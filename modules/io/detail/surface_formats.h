#pragma once

#include <array>
#include <string>
#include <string_view>

/// The single formats behind readSurface() and writeSurface().
namespace pneuma {

/// What a sound file says before VTK reads it.
struct SurfaceHead {
  std::string space;      ///< "LPS", "RAS" or "" as the file says
  std::size_t faces = 0;  ///< triangles or polygons that the reader must come back with
};

// Throw InvalidInput unless the file is complete, its numbers are numbers and its faces name
// existing points. `name` is the file's, in quotation marks, for messages.
SurfaceHead checkStl(const std::string& content, const std::string& name);
SurfaceHead checkObj(const std::string& content, const std::string& name);
SurfaceHead checkPly(const std::string& content, const std::string& name);

/// True for a file of exactly the size that its number of triangles asks for, and for text that
/// begins as an ASCII STL does.
bool looksLikeStl(const std::string& content);

/// True if the first lines are those of an OBJ file.
bool looksLikeObj(std::string_view content);

/// "LPS" or "RAS" if `text` holds SPACE=LPS or SPACE=RAS, otherwise "".
std::string spaceIn(std::string_view text);

inline constexpr std::size_t StlHeadBytes = 80;
inline constexpr std::size_t StlTriangleBytes = 50;

/// OBJ is plain text without any end, so Pneuma's files begin with how much is to come:
/// "# Pneuma surface: 4 points, 4 triangles".
inline constexpr std::string_view ObjTitle = "# Pneuma surface: ";

}  // namespace pneuma
