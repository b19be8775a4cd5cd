#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include "core/error.h"
#include "io/detail/surface_formats.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

/// VTK's reader has fixed room for lines and for the corners of a face.
constexpr std::size_t PlyLineLimit = 4000;
constexpr std::int64_t CornerLimit = 255;
constexpr std::size_t LongestName = 40;  // as messages repeat it

enum class Kind { Signed, Unsigned, Real };

struct Type {
  Kind kind = Kind::Signed;
  std::size_t bytes = 0;  ///< 0: unknown
};

Type typeNamed(std::string_view name) {
  if (name == "char" || name == "int8") return {Kind::Signed, 1};
  if (name == "uchar" || name == "uint8") return {Kind::Unsigned, 1};
  if (name == "short" || name == "int16") return {Kind::Signed, 2};
  if (name == "ushort" || name == "uint16") return {Kind::Unsigned, 2};
  if (name == "int" || name == "int32") return {Kind::Signed, 4};
  if (name == "uint" || name == "uint32") return {Kind::Unsigned, 4};
  if (name == "float" || name == "float32") return {Kind::Real, 4};
  if (name == "double" || name == "float64") return {Kind::Real, 8};
  return {};
}

struct Property {
  std::string name;
  Type type;
  Type countType;  ///< of a list; no bytes if it is none

  bool isList() const { return countType.bytes > 0; }
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> result;
  constexpr std::string_view Blanks = " \t\r";
  for (std::size_t begin = line.find_first_not_of(Blanks); begin != std::string_view::npos;
       begin = line.find_first_not_of(Blanks, begin)) {
    const std::size_t end = std::min(line.find_first_of(Blanks, begin), line.size());
    result.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return result;
}

class PlyCheck {
 public:
  PlyCheck(std::string_view content, const std::string& name) : rest_(content), name_(name) {}

  SurfaceHead run() {
    readHeader();
    for (const Element& element : elements_) {
      if (element.name == "vertex") points_ = element.count;
      if (element.name == "face") head_.faces = static_cast<std::size_t>(element.count);
    }
    requireProperties();
    requireMembers("vertex", {"x", "y", "z"}, false);
    requireMembers("face", {"vertex_indices"}, true);
    for (const Element& element : elements_) {
      for (std::int64_t i = 0; i < element.count; ++i) {
        if (format_ == "ascii") {
          checkLine(element);
        } else {
          checkBytes(element);
        }
      }
    }
    return head_;
  }

 private:
  InvalidInput damaged(const std::string& what) const {
    return InvalidInput(name_ + " is cut off or damaged: " + what + "; get it anew");
  }

  std::string_view takeLine() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos && rest_.empty()) throw damaged("it ends too early");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line.size() > PlyLineLimit) throw damaged("it has a line of more than 4000 characters");
    return line;
  }

  void readHeader() {
    takeLine();  // "ply"
    for (;;) {
      const std::string_view line = takeLine();
      const std::vector<std::string_view> fields = words(line);
      if (fields.empty()) throw damaged("it has an empty line in its header");
      if (line.find('\0') != std::string_view::npos) throw damaged("its header is not text");
      if (fields[0] == "end_header" && fields.size() == 1) break;
      if (fields[0] == "comment") {
        if (head_.space.empty()) head_.space = spaceIn(line);
      } else if (fields[0] == "format" && fields.size() == 3 && format_.empty()) {
        format_ = fields[1];
      } else if (fields[0] == "element") {
        addElement(fields);
      } else if (fields[0] == "property") {
        addProperty(fields);
      } else if (fields[0] != "obj_info") {
        throw damaged("its header has a line that starts with \"" +
                      std::string(fields[0].substr(0, LongestName)) + "\"");
      }
    }
    if (format_ != "ascii" && format_ != "binary_little_endian" && format_ != "binary_big_endian") {
      throw damaged("its format is \"" + std::string(format_) + "\"");
    }
  }

  void addElement(const std::vector<std::string_view>& fields) {
    const std::optional<std::int64_t> count =
        fields.size() == 3 ? parseInteger(fields[2]) : std::nullopt;
    if (!count || *count < 0 || *count > static_cast<std::int64_t>(rest_.size())) {
      throw damaged("it says how many items of a kind it has, but that cannot be");
    }
    elements_.push_back({std::string(fields[1]), *count, {}});
  }

  void addProperty(const std::vector<std::string_view>& fields) {
    Property property;
    property.name = fields.back();
    if (fields.size() == 5 && fields[1] == "list") {
      property.countType = typeNamed(fields[2]);
      property.type = typeNamed(fields[3]);
      if (property.countType.bytes == 0 || property.countType.kind == Kind::Real) {
        throw damaged("its property \"" + property.name + "\" has an unknown type");
      }
    } else if (fields.size() == 3) {
      property.type = typeNamed(fields[1]);
    }
    if (property.type.bytes == 0 || elements_.empty()) {
      throw damaged("its property \"" + property.name + "\" has an unknown type or no element");
    }
    elements_.back().properties.push_back(std::move(property));
  }

  /// VTK's reader writes past its memory at elements without any, and takes one for another where
  /// two have a name.
  void requireProperties() const {
    for (const Element& element : elements_) {
      if (element.properties.empty()) {
        throw damaged("its element \"" + element.name.substr(0, LongestName) +
                      "\" has no property");
      }
    }
    std::set<std::string_view> names;
    for (const Element& element : elements_) {
      if (names.insert(element.name).second) continue;
      throw damaged("it has two elements \"" + element.name.substr(0, LongestName) + "\"");
    }
  }

  void requireMembers(const std::string& element, std::initializer_list<const char*> members,
                      bool list) const {
    const auto found = std::find_if(elements_.begin(), elements_.end(),
                                    [&](const Element& e) { return e.name == element; });
    if (found == elements_.end()) throw damaged("it has no element \"" + element + "\"");
    for (const std::string member : members) {
      const bool there = std::any_of(found->properties.begin(), found->properties.end(),
                                     [&](const Property& property) {
                                       return property.name == member && property.isList() == list;
                                     });
      if (!there) throw damaged("its element \"" + element + "\" has no \"" + member + "\"");
    }
  }

  /// Takes a number in binary form off the rest.
  double takeNumber(Type type) {
    if (rest_.size() < type.bytes) throw damaged("it ends too early");
    std::array<char, 8> bytes{};
    std::copy_n(rest_.begin(), type.bytes, bytes.begin());
    if (format_ == "binary_big_endian")
      std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(type.bytes));
    rest_.remove_prefix(type.bytes);
    if (type.kind == Kind::Real) {
      if (type.bytes == 8) return std::bit_cast<double>(bytes);
      float number = 0.0F;
      std::memcpy(&number, bytes.data(), sizeof(number));
      return number;
    }
    std::uint64_t value = std::bit_cast<std::uint64_t>(bytes);
    const std::size_t unusedBits = 64 - 8 * type.bytes;
    if (type.kind == Kind::Unsigned) return static_cast<double>(value);
    return static_cast<double>(static_cast<std::int64_t>(value << unusedBits) >> unusedBits);
  }

  void checkBytes(const Element& element) {
    for (const Property& property : element.properties) {
      if (!property.isList()) {
        checkScalar(element, takeNumber(property.type));
        continue;
      }
      const double count = takeNumber(property.countType);
      checkCount(element, count);
      for (double i = 0; i < count; ++i) checkIndex(element, property, takeNumber(property.type));
    }
  }

  void checkLine(const Element& element) {
    const std::vector<std::string_view> fields = words(takeLine());
    std::size_t next = 0;
    const auto take = [&] {
      const std::optional<double> number =
          next < fields.size() ? parseDouble(fields[next]) : std::nullopt;
      if (!number) throw damaged("a line of element \"" + element.name + "\" is incomplete");
      ++next;
      return *number;
    };
    for (const Property& property : element.properties) {
      if (!property.isList()) {
        checkScalar(element, take());
        continue;
      }
      const double count = take();
      checkCount(element, count);
      for (double i = 0; i < count; ++i) checkIndex(element, property, take());
    }
  }

  void checkScalar(const Element& element, double value) const {
    if (element.name == "vertex" && !std::isfinite(value)) {
      throw damaged("a vertex has a coordinate that is not a number");
    }
  }

  void checkCount(const Element& element, double count) const {
    if (!(count >= 0.0) || (element.name == "face" && count > CornerLimit)) {
      throw damaged("a face has " + numberText(count) + " corners (3 to 255 are possible)");
    }
  }

  void checkIndex(const Element& element, const Property& property, double value) const {
    if (element.name != "face" || property.name != "vertex_indices") return;
    if (!(value >= 0.0) || value >= static_cast<double>(points_)) {
      throw damaged("a face names point " + numberText(value) + " of " + std::to_string(points_));
    }
  }

  std::string_view rest_;
  const std::string& name_;
  std::string_view format_;
  std::vector<Element> elements_;
  std::int64_t points_ = 0;
  SurfaceHead head_;
};

}  // namespace

SurfaceHead checkPly(const std::string& content, const std::string& name) {
  return PlyCheck(content, name).run();
}

}  // namespace pneuma
