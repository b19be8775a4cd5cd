#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/error.h"
#include "io/detail/surface_formats.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

constexpr std::size_t FirstTriangle = StlHeadBytes + 4;

/// Number of triangles that a binary STL says to have.
std::size_t declaredTriangles(const std::string& content) {
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + StlHeadBytes, sizeof(count));
  return count;
}

bool isBinaryStl(const std::string& content) {
  return content.size() >= FirstTriangle &&
         content.size() == FirstTriangle + StlTriangleBytes * declaredTriangles(content);
}

bool isAsciiStl(std::string_view content) {
  const std::string head = lowerCase(trimmed(content.substr(0, 4096)));
  return head.starts_with("solid") && head.find('\0') == std::string::npos &&
         head.find("facet", 5) != std::string::npos;
}

SurfaceHead checkAscii(std::string_view content, const std::string& name) {
  // VTK's reader takes a text with others for binary, and its letters for a number of triangles.
  const bool isAscii = std::ranges::all_of(
      content, [](char c) { return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r'); });
  if (!isAscii) {
    throw InvalidInput(name +
                       " has letters beyond ASCII, such as umlauts, which a text STL cannot "
                       "have, or is damaged; replace them, or export the file anew");
  }
  SurfaceHead head;
  head.space = spaceIn(content.substr(0, content.find('\n')));
  std::size_t vertices = 0;
  bool closed = false;
  Lines lines(content);
  while (const std::optional<std::string_view> next = lines.next()) {
    const std::string line = lowerCase(trimmed(*next));
    if (line.empty()) continue;
    closed = line.starts_with("endsolid");
    if (line.starts_with("endfacet")) ++head.faces;
    if (!line.starts_with("vertex")) continue;
    ++vertices;
    std::string_view rest = std::string_view(line).substr(6);
    for (int i = 0; i < 3; ++i) {
      const std::optional<double> number = parseDouble(takeWord(rest));
      if (!number.has_value() || !std::isfinite(*number)) {
        throw InvalidInput(name + ", line " + std::to_string(lines.number()) +
                           ": a vertex needs three numbers; is the file cut off or damaged?");
      }
    }
  }
  if (!closed || vertices != 3 * head.faces) {
    throw InvalidInput(name + " is cut off or damaged: it has " + std::to_string(head.faces) +
                       " triangles, " + std::to_string(vertices) + " corners and " +
                       (closed ? "an" : "no") + " \"endsolid\" at its end; get it anew");
  }
  return head;
}

}  // namespace

bool looksLikeStl(const std::string& content) {
  return isBinaryStl(content) || isAsciiStl(content);
}

SurfaceHead checkStl(const std::string& content, const std::string& name) {
  if (isBinaryStl(content)) {
    return {spaceIn(std::string_view(content).substr(0, StlHeadBytes)), declaredTriangles(content)};
  }
  if (isAsciiStl(content)) return checkAscii(content, name);
  if (content.size() < FirstTriangle) {
    throw InvalidInput(name + " is cut off or no STL: it has only " +
                       std::to_string(content.size()) + " bytes; get it anew");
  }
  const std::size_t count = declaredTriangles(content);
  throw InvalidInput(name + " is cut off, damaged or no STL: it says it has " +
                     std::to_string(count) + " triangles, which take " +
                     std::to_string(FirstTriangle + StlTriangleBytes * count) + " bytes, but has " +
                     std::to_string(content.size()) + "; get it anew");
}

}  // namespace pneuma
