#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkZLibDataCompressor.h>

#include "core/error.h"
#include "io/detail/text_fields.h"
#include "io/detail/vtk_blocks.h"
#include "io/detail/vtk_errors.h"
#include "io/detail/vtk_xml.h"

namespace pneuma {
namespace {

/// No array of a file in memory has more values.
constexpr std::int64_t CountLimit = std::int64_t{1} << 31;

/// A number of tuples that only the array itself tells.
constexpr std::int64_t Unknown = -1;

/// VTK's parser recurses into elements; its own files are six deep.
constexpr int DepthLimit = 32;

constexpr std::size_t ChunkBytes = std::size_t{1} << 20;

std::string_view attribute(vtkXMLDataElement* element, const char* key) {
  const char* value = element->GetAttribute(key);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

/// One file at hand: its text, its encoding and the arrays' places in it.
class Check {
 public:
  Check(const std::string& content, const std::string& name) : content_(content), name_(name) {}

  std::string run() {
    constexpr std::string_view End = "</VTKFile>";
    const std::size_t end = content_.rfind(End);
    // Comments may follow (Chaste writes some).
    const std::string_view rest =
        end == std::string::npos ? End
                                 : trimmed(std::string_view(content_).substr(end + End.size()));
    if (!rest.empty() && !rest.starts_with("<!--")) {
      throw InvalidInput(name_ + " is cut off: its closing tag </VTKFile> is missing; get it anew");
    }
    const std::size_t appended = content_.find("<AppendedData");
    requireFlatXml(std::string_view(content_).substr(0, appended), name_);
    std::istringstream stream(content_);
    parser_->SetStream(&stream);
    if (parser_->Parse() == 0 || !parserErrors_.first().empty() ||
        parser_->GetRootElement() == nullptr) {
      throw InvalidInput(name_ + " is damaged XML; VTK says: " + parserErrors_.first());
    }
    vtkXMLDataElement* root = parser_->GetRootElement();
    takeEncoding(root);
    if (appended != std::string::npos) {
      findAppended(root, static_cast<std::size_t>(parser_->GetAppendedDataPosition()));
    }
    const std::string type(attribute(root, "type"));
    if (type != "PolyData" && type != "UnstructuredGrid") {
      throw Unsupported(name_ + " is a VTK file of type \"" + type +
                        "\"; convert it to VTP (PolyData) or VTU (UnstructuredGrid)");
    }
    vtkXMLDataElement* dataSet = root->FindNestedElementWithName(type.c_str());
    if (dataSet == nullptr) throw damaged("it has no <" + type + ">");
    forEachNested(dataSet, [&](vtkXMLDataElement* element) {
      if (std::strcmp(element->GetName(), "Piece") == 0) {
        checkPiece(element);
      } else if (std::strcmp(element->GetName(), "FieldData") == 0) {
        checkArrays(element, Unknown);
      }
    });
    return type;
  }

 private:
  InvalidInput damaged(const std::string& what) const {
    return InvalidInput(name_ + " is damaged or cut off: " + what + "; get it anew");
  }

  template <class F>
  static void forEachNested(vtkXMLDataElement* element, F&& f) {
    for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) f(element->GetNestedElement(i));
  }

  void takeEncoding(vtkXMLDataElement* root) {
    encoding_.bigEndian = attribute(root, "byte_order") == "BigEndian";
    const std::string_view compressor = attribute(root, "compressor");
    encoding_.compressed = !compressor.empty();
    if (!encoding_.compressed) return;
    if (compressor == "vtkZLibDataCompressor") {
      compressor_ = vtkSmartPointer<vtkZLibDataCompressor>::New();
    } else if (compressor == "vtkLZ4DataCompressor") {
      compressor_ = vtkSmartPointer<vtkLZ4DataCompressor>::New();
    } else if (compressor == "vtkLZMADataCompressor") {
      compressor_ = vtkSmartPointer<vtkLZMADataCompressor>::New();
    } else {
      throw damaged("it is compressed in an unknown way, \"" + std::string(compressor) + "\"");
    }
    compressorErrors_.emplace(*compressor_);
    parser_->SetCompressor(compressor_);
  }

  void findAppended(vtkXMLDataElement* root, std::size_t begin) {
    const std::size_t end = content_.rfind("</AppendedData>");
    if (end == std::string::npos || begin > end) throw damaged("its appended data have no end");
    appended_ = std::string_view(content_).substr(begin, end - begin);
    vtkXMLDataElement* element = root->FindNestedElementWithName("AppendedData");
    appendedBase64_ = element == nullptr || attribute(element, "encoding") != "raw";
  }

  std::int64_t count(vtkXMLDataElement* element, const char* key) const {
    const std::string_view text = attribute(element, key);
    if (text.empty()) return 0;
    const std::optional<std::int64_t> value = parseInteger(text);
    if (!value || *value < 0 || *value > CountLimit) {
      throw damaged(std::string(key) + " is \"" + std::string(text) + "\"");
    }
    return *value;
  }

  void checkPiece(vtkXMLDataElement* piece) {
    const std::int64_t points = count(piece, "NumberOfPoints");
    std::int64_t cells = count(piece, "NumberOfCells");
    for (const char* kind : {"Verts", "Lines", "Strips", "Polys"}) {
      cells += count(piece, (std::string("NumberOf") + kind).c_str());
    }
    forEachNested(piece, [&](vtkXMLDataElement* element) {
      const std::string group = element->GetName();
      if (group == "Points") {
        checkPoints(element, points);
      } else if (group == "PointData") {
        checkArrays(element, points);
      } else if (group == "CellData") {
        checkArrays(element, cells);
      } else {
        checkCells(element, count(piece, ("NumberOf" + group).c_str()));
      }
    });
  }

  void checkPoints(vtkXMLDataElement* group, std::int64_t points) {
    forEachNested(group, [&](vtkXMLDataElement* array) {
      if (attribute(array, "NumberOfComponents") != "3") {
        throw damaged("its points have other than three coordinates");
      }
      checkArray(array, points);
    });
  }

  void checkCells(vtkXMLDataElement* group, std::int64_t cells) {
    vtkXMLDataElement* connectivity = nullptr;
    vtkXMLDataElement* offsets = nullptr;
    forEachNested(group, [&](vtkXMLDataElement* array) {
      const std::string_view which = attribute(array, "Name");
      if (which == "connectivity") connectivity = array;
      if (which == "offsets") offsets = array;
      checkArray(array, which == "offsets" || which == "types" ? cells : Unknown);
    });
    if (cells == 0) return;
    if (connectivity == nullptr || offsets == nullptr) {
      throw damaged("its cells have no connectivity or no offsets");
    }
    checkArray(connectivity, integerOf(offsets, cells - 1));
  }

  void checkArrays(vtkXMLDataElement* group, std::int64_t tuples) {
    // VTK's reader has one array for each name, and looks for as many as there are elements.
    std::set<std::string_view> names;
    forEachNested(group, [&](vtkXMLDataElement* array) {
      const std::string_view which = attribute(array, "Name");
      if (!names.insert(which).second) {
        throw damaged("it has two arrays \"" + std::string(which) + "\"");
      }
      checkArray(array, tuples);
    });
  }

  /// @param tuples how many there must be, or Unknown
  void checkArray(vtkXMLDataElement* array, std::int64_t tuples) {
    const std::string label = "its array \"" + std::string(attribute(array, "Name")) + "\"";
    const std::int64_t components =
        attribute(array, "NumberOfComponents").empty() ? 1 : count(array, "NumberOfComponents");
    if (components < 1 || components > 1024)
      throw damaged(label + " has no or too many components");
    if (tuples == Unknown && !attribute(array, "NumberOfTuples").empty()) {
      tuples = count(array, "NumberOfTuples");
    }
    const std::int64_t values = std::max<std::int64_t>(tuples, 0) * components;
    const std::string_view type = attribute(array, "type");
    const std::int64_t valueBytes = bytesOf(type);
    if (valueBytes == 0) throw damaged(label + " is of type \"" + std::string(type) + "\"");
    forEachNested(array, [&](vtkXMLDataElement* key) {
      // Ranges of values, which VTK keeps beside an array, come as two numbers.
      if (attribute(key, "name").ends_with("RANGE") && attribute(key, "length") != "2") {
        throw damaged(label + " has a range of other than two numbers");
      }
    });
    if (!hasSoundData(array, values, valueBytes, label)) return;
    if (attribute(array, "format") == "ascii" && type != "String" && values > 0) {
      requireLastNumber(array, values, label);
    }
    const std::optional<std::int64_t> zeros = zerosIn(array, type == "String", label);
    // VTK's reader stores every string that it meets, whether there is room for it or not.
    if (type == "String" && zeros != values) {
      throw damaged(label + " holds other than the " + std::to_string(values) + " strings it says");
    }
  }

  /// VTK's reader leaves what it cannot read as text without a value.
  void requireLastNumber(vtkXMLDataElement* array, std::int64_t values, const std::string& label) {
    int wordType = 0;
    std::array<char, 8> bytes{};
    if (array->GetWordTypeAttribute("type", wordType) == 0 ||
        readValues(array, bytes.data(), static_cast<std::size_t>(values - 1), 1, wordType) != 1) {
      throw damaged(label + " has fewer than " + std::to_string(values) + " numbers");
    }
  }

  /// The value of an array of numbers at `place`, which lies in [0, CountLimit].
  std::int64_t integerOf(vtkXMLDataElement* array, std::int64_t place) {
    int wordType = 0;
    if (array->GetWordTypeAttribute("type", wordType) == 0) throw damaged("an array has no type");
    std::array<char, 8> bytes{};
    if (readValues(array, bytes.data(), static_cast<std::size_t>(place), 1, wordType) != 1) {
      throw damaged("an array is too short");
    }
    const std::optional<std::int64_t> value = integerIn(bytes, attribute(array, "type"));
    if (!value || *value < 0 || *value > CountLimit)
      throw damaged("its cells have no sound offsets");
    return *value;
  }

  /// The number that the bytes hold; nothing if the type is none of whole numbers.
  static std::optional<std::int64_t> integerIn(const std::array<char, 8>& bytes,
                                               std::string_view type) {
    if (type == "Int64" || type == "UInt64") return std::bit_cast<std::int64_t>(bytes);
    if (type == "Int32" || type == "UInt32") {
      std::int32_t value = 0;
      std::memcpy(&value, bytes.data(), sizeof(value));
      return value;
    }
    return std::nullopt;
  }

  /// Number of values read.
  std::size_t readValues(vtkXMLDataElement* array, char* values, std::size_t first,
                         std::size_t count, int wordType) {
    const std::string_view format = attribute(array, "format");
    if (format == "appended") {
      return parser_->ReadAppendedData(this->count(array, "offset"), values, first, count,
                                       wordType);
    }
    return parser_->ReadInlineData(array, format == "binary" ? 0 : 1, values, first, count,
                                   wordType);
  }

  /// Reads the whole array, to see whether it can be uncompressed, and counts the bytes that are 0:
  /// in an array of strings, their ends. Nothing if there is no need to read it.
  std::optional<std::int64_t> zerosIn(vtkXMLDataElement* array, bool strings,
                                      const std::string& label) {
    const bool text = attribute(array, "format") == "ascii";
    if (!strings && (text || !encoding_.compressed)) return std::nullopt;
    std::int64_t zeros = 0;
    std::vector<char> bytes(ChunkBytes);
    for (std::size_t begin = 0;; begin += ChunkBytes) {
      const std::size_t size = readValues(array, bytes.data(), begin, ChunkBytes, VTK_CHAR);
      const std::size_t used = std::min(size, ChunkBytes);
      zeros += std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(used), '\0');
      if (compressorErrors_.has_value() && !compressorErrors_->first().empty()) {
        throw damaged(label + " cannot be uncompressed");
      }
      if (used < ChunkBytes) return zeros;
    }
  }

  /// False for an array without values that is not in the file at all.
  bool hasSoundData(vtkXMLDataElement* array, std::int64_t values, std::int64_t valueBytes,
                    const std::string& label) const {
    const std::string_view format = attribute(array, "format");
    std::string problem;
    if (format == "appended") {
      const std::int64_t offset = count(array, "offset");
      if (offset > static_cast<std::int64_t>(appended_.size())) {
        throw damaged(label + " lies behind the end of the file");
      }
      problem = problemOfBlock(appended_.substr(static_cast<std::size_t>(offset)), appendedBase64_,
                               encoding_, static_cast<std::uint64_t>(values * valueBytes));
    } else if (format == "binary") {
      problem = problemOfBlock(inlineText(array), true, encoding_,
                               static_cast<std::uint64_t>(values * valueBytes));
    } else if (static_cast<std::int64_t>(inlineText(array).size()) + 1 < 2 * values) {
      problem = "is too short";
    }
    if (problem == NoBlock && values == 0) return false;
    if (!problem.empty()) throw damaged(label + " " + problem);
    return true;
  }

  std::string_view inlineText(vtkXMLDataElement* array) const {
    const auto begin = static_cast<std::size_t>(array->GetXMLByteIndex());
    const std::size_t open = content_.find('>', begin);
    if (open == std::string::npos || content_[open - 1] == '/') return {};
    const std::size_t close = std::min(content_.find('<', open), content_.size());
    return trimmed(std::string_view(content_).substr(open + 1, close - open - 1));
  }

  /// Bytes of a value in binary form, 0 for an unknown type. A string has a byte or more.
  static std::int64_t bytesOf(std::string_view type) {
    if (type == "Int8" || type == "UInt8" || type == "String") return 1;
    if (type == "Int16" || type == "UInt16") return 2;
    if (type == "Int32" || type == "UInt32" || type == "Float32") return 4;
    if (type == "Int64" || type == "UInt64" || type == "Float64") return 8;
    return 0;
  }

  const std::string& content_;
  const std::string& name_;
  vtkNew<vtkXMLDataParser> parser_;
  VtkErrors parserErrors_{*parser_};
  vtkSmartPointer<vtkDataCompressor> compressor_;
  std::optional<VtkErrors> compressorErrors_;
  VtkBlockEncoding encoding_;
  std::string_view appended_;
  bool appendedBase64_ = false;
};

}  // namespace

void requireFlatXml(std::string_view header, const std::string& name) {
  int depth = 0;
  for (std::size_t i = header.find('<'); i != std::string_view::npos; i = header.find('<', i + 1)) {
    const char next = i + 1 < header.size() ? header[i + 1] : '\0';
    if (next == '?' || next == '!') continue;
    const std::size_t close = header.find('>', i);
    if (close == std::string_view::npos) break;
    if (next == '/') {
      --depth;
    } else if (header[close - 1] != '/') {
      ++depth;
    }
    if (depth > DepthLimit) {
      throw InvalidInput(name + " is damaged: its XML elements are nested too deeply");
    }
  }
}

std::string requireSoundVtkXml(const std::string& content, const std::string& name) {
  return Check(content, name).run();
}

}  // namespace pneuma
