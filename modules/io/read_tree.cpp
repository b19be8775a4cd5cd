#include <algorithm>
#include <array>
#include <optional>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/text_fields.h"
#include "io/detail/tree_formats.h"
#include "io/detail/vtk_xml.h"
#include "io/surface_file.h"
#include "io/tree_file.h"

namespace pneuma {
namespace {

using Reader = TreeFile (*)(const std::string& content, const std::string& name);

constexpr std::string_view TreeFormats = "VTP, VTU, SWC, CSV or JSON";

/// The first line that is neither empty nor a comment.
std::string_view firstDataLine(std::string_view content) {
  Lines lines(content);
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::string_view text = trimmed(*line);
    if (!text.empty() && text.front() != '#') return text;
  }
  return {};
}

/// True if the text holds bytes that no text has.
bool isBinary(std::string_view content) {
  return content.substr(0, 4096).find('\0') != std::string_view::npos;
}

bool looksLikeCsv(std::string_view content) {
  const std::string head = lowerCase(firstDataLine(content));
  return head.find("parent") != std::string::npos && head.find("id") != std::string::npos;
}

bool looksLikeSwc(std::string_view content) {
  std::string_view line = firstDataLine(content);
  int numbers = 0;
  for (auto word = takeWord(line); !word.empty(); word = takeWord(line)) {
    if (!parseDouble(word).has_value()) return false;
    ++numbers;
  }
  return numbers == 7;
}

/// Some editors put a mark of the byte order before it.
bool looksLikeJson(std::string_view content) {
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
  return trimmed(content).starts_with('{');
}

Reader readerOfContent(const std::string& content) {
  if (looksLikeVtkXml(content)) return readVtkTree;
  if (isBinary(content)) return nullptr;
  if (looksLikeJson(content)) return readTreeJson;
  if (looksLikeCsv(content)) return readTreeCsv;
  return looksLikeSwc(content) ? readSwc : nullptr;
}

Reader readerOfExtension(const std::string& extension) {
  if (extension == ".swc") return readSwc;
  if (extension == ".csv") return readTreeCsv;
  if (extension == ".json") return readTreeJson;
  return extension == ".vtp" || extension == ".vtu" ? readVtkTree : nullptr;
}

/// The number in `key="123"` of an XML tag, 0 if it has none.
std::int64_t numberIn(std::string_view tag, std::string_view key) {
  const std::size_t begin = tag.find(std::string(key) + "=\"");
  if (begin == std::string_view::npos) return 0;
  tag.remove_prefix(begin + key.size() + 2);
  return parseInteger(tag.substr(0, tag.find('"'))).value_or(0);
}

/// True for lines without polygons, and for unstructured grids, which hold nothing else here.
bool vtkHoldsLines(std::string_view content) {
  const std::size_t piece = content.find("<Piece");
  if (piece == std::string_view::npos) return false;
  if (content.substr(0, piece).find("<UnstructuredGrid") != std::string_view::npos) return true;
  const std::string_view tag = content.substr(piece, content.find('>', piece) - piece);
  return numberIn(tag, "NumberOfLines") > 0 && numberIn(tag, "NumberOfPolys") == 0 &&
         numberIn(tag, "NumberOfStrips") == 0;
}

double farthestOf(const Vec3& point) { return point.cwiseAbs().maxCoeff(); }

/// @throws InvalidInput for a branch that is nowhere near a person, or wider than anything in one
void requireNearby(const AirwayTree& tree, const std::string& name) {
  constexpr double FarthestOfTreeMm = 1e6;
  constexpr double WidestMm = 1e4;
  for (const Branch& branch : tree) {
    double far = std::max(farthestOf(branch.proximal), farthestOf(branch.distal));
    double widest = branch.radiusMm;
    for (const auto& [point, radiusMm] : branch.via) {
      far = std::max(far, farthestOf(point));
      widest = std::max(widest, radiusMm);
    }
    if (far > FarthestOfTreeMm) {
      throw InvalidInput(name + " has an airway that ends more than 1 km away; lengths are in mm");
    }
    if (widest > WidestMm) {
      throw InvalidInput(name +
                         " has an airway with a radius of more than 10 m; lengths are in mm");
    }
  }
}

}  // namespace

TreeFile readTree(const std::filesystem::path& path) {
  const std::string content = readFile(path);
  const std::string name = quoted(path);
  const std::string extension = lowerCase(path.extension().string());
  if (trimmed(content).empty()) {
    throw InvalidInput(name + " is empty; give an airway tree as " + std::string(TreeFormats));
  }
  const Reader ofExtension = readerOfExtension(extension);
  const Reader ofContent = readerOfContent(content);
  if (ofContent == nullptr && isSurfaceFileName(path)) {
    throw InvalidInput(name + " is no airway tree but a surface, or damaged; give a tree as " +
                       std::string(TreeFormats));
  }
  if (ofContent == nullptr && ofExtension == nullptr) {
    throw Unsupported(name + " is not an airway tree that can be read; give " +
                      std::string(TreeFormats));
  }
  if (ofContent == nullptr && (isBinary(content) || ofExtension == readVtkTree)) {
    throw InvalidInput(name + " does not hold what its extension \"" + extension +
                       "\" says; give an airway tree as " + std::string(TreeFormats));
  }
  TreeFile file = (ofContent != nullptr ? ofContent : ofExtension)(content, name);
  requireNearby(file.tree, name);
  if (ofContent != nullptr && ofContent != ofExtension) {
    file.notes.push_back(name + " was read as " + file.format +
                         ", which it holds whatever its name.");
  }
  return file;
}

bool isTreeFile(const std::filesystem::path& path) {
  const std::string content = readFile(path);
  if (looksLikeVtkXml(content)) return vtkHoldsLines(content);
  if (isBinary(content)) return false;
  if (looksLikeJson(content)) return content.find("pneuma/tree/") != std::string::npos;
  return looksLikeCsv(content) || looksLikeSwc(content);
}

}  // namespace pneuma
