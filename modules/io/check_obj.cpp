#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "io/detail/surface_formats.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

/// VTK's reader takes lines in pieces of this size.
constexpr std::size_t LineLimit = 1000;

class ObjCheck {
 public:
  ObjCheck(std::string_view content, const std::string& name)
      : content_(content), lines_(content), name_(name) {}

  SurfaceHead run() {
    while (const std::optional<std::string_view> next = lines_.next()) {
      std::string_view line = *next;
      if (line.size() > LineLimit) throw wrong("is longer than 1000 characters");
      if (line.starts_with('#')) takeComment(line);
      const std::string_view keyword = takeWord(line);
      if (keyword == "v") checkVertex(line);
      if (keyword == "vt") ++texturePoints_;
      if (keyword == "vn") ++normals_;
      if (keyword == "f") checkFace(line);
    }
    requireComplete();
    return head_;
  }

 private:
  InvalidInput wrong(const std::string& what) const {
    return InvalidInput(name_ + ", line " + std::to_string(lines_.number()) + " " + what +
                        "; mend or export the file anew");
  }

  void takeComment(std::string_view line) {
    if (head_.space.empty()) head_.space = spaceIn(line);
    if (line.starts_with(ObjTitle)) declared_ = line.substr(ObjTitle.size());
  }

  void checkVertex(std::string_view line) {
    ++points_;
    for (int i = 0; i < 3; ++i) {
      const std::optional<double> number = parseDouble(takeWord(line));
      if (!number.has_value() || !std::isfinite(*number)) throw wrong("has no three coordinates");
    }
  }

  void checkFace(std::string_view line) {
    ++head_.faces;
    int corners = 0;
    std::size_t slashes = 0;
    for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
      if (word == "\\") throw wrong("is continued on the next; write every face on one line");
      checkCorner(word);
      const auto here = static_cast<std::size_t>(std::ranges::count(word, '/'));
      if (corners > 0 && here != slashes) throw wrong("writes its corners in different ways");
      slashes = here;
      ++corners;
    }
    if (corners < 3) throw wrong("is a face with fewer than three corners");
  }

  /// A point, or a point and what else it has: 3, 3/1, 3/1/2 or 3//2.
  void checkCorner(std::string_view word) {
    const std::string_view all = word;
    for (int field = 0; field < 3; ++field) {
      const std::size_t end = word.find('/');
      const std::string_view text = word.substr(0, end);
      const std::optional<std::int64_t> index = parseInteger(text);
      if (index.value_or(0) < 0) {
        throw wrong("counts points backwards (" + std::to_string(*index) + "), which is not read");
      }
      const bool leftOut = field == 1 && text.empty() && end != std::string_view::npos;
      if (field > 0 && text.empty() && !leftOut) {
        throw wrong("ends a corner with a slash; leave such slashes out");
      }
      if (index.value_or(0) == 0 && !leftOut) {
        throw wrong("names a point that is none: \"" + std::string(all) + "\"");
      }
      highest_[static_cast<std::size_t>(field)] =
          std::max(highest_[static_cast<std::size_t>(field)], index.value_or(0));
      if (end == std::string_view::npos) return;
      word.remove_prefix(end + 1);
    }
    throw wrong("names a point that is none: \"" + std::string(all) + "\"");
  }

  void requireComplete() const {
    constexpr std::array<const char*, 3> Named = {"point", "texture point", "normal"};
    const std::array<std::int64_t, 3> there = {points_, texturePoints_, normals_};
    for (std::size_t n = 0; n < Named.size(); ++n) {
      if (highest_[n] <= there[n]) continue;
      throw InvalidInput(name_ + " is cut off or damaged: a face names " + Named[n] + " " +
                         std::to_string(highest_[n]) + " of " + std::to_string(there[n]) +
                         "; get it anew");
    }
    const std::string found =
        std::to_string(points_) + " points, " + std::to_string(head_.faces) + " triangles";
    if (!declared_.empty() && (declared_ != found || !content_.ends_with('\n'))) {
      throw InvalidInput(name_ + " is cut off: it should have " + std::string(declared_) +
                         " but has " + found + "; get it anew");
    }
  }

  std::string_view content_;
  Lines lines_;
  const std::string& name_;
  SurfaceHead head_;
  std::string_view declared_;
  std::int64_t points_ = 0;
  std::int64_t texturePoints_ = 0;
  std::int64_t normals_ = 0;
  std::array<std::int64_t, 3> highest_{};  ///< point, texture point and normal that faces name
};

}  // namespace

bool looksLikeObj(std::string_view content) {
  constexpr std::string_view Keywords = " v vn vt f o g s mtllib usemtl ";
  if (content.substr(0, 4096).find('\0') != std::string_view::npos) return false;
  Lines lines(content);
  while (const std::optional<std::string_view> next = lines.next()) {
    std::string_view line = *next;
    if (trimmed(line).empty() || line.starts_with('#')) continue;
    std::string keyword = " ";
    keyword += takeWord(line);
    keyword += ' ';
    return Keywords.find(keyword) != std::string_view::npos;
  }
  return false;
}

SurfaceHead checkObj(const std::string& content, const std::string& name) {
  // Some of them are blanks for VTK and not here.
  const bool isText = std::ranges::none_of(content, [](char c) {
    return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r';
  });
  if (!isText) {
    throw InvalidInput(name + " is damaged or no OBJ: it is not text; get it anew");
  }
  return ObjCheck(content, name).run();
}

}  // namespace pneuma
