#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/detail/branch_rows.h"
#include "io/detail/text_fields.h"
#include "io/detail/tree_formats.h"
#include "io/tree_file.h"

namespace pneuma {
namespace {

/// Keys are names in every format: of an array, of a comment, of a member.
void requireWritableMetadata(const Metadata& metadata) {
  constexpr std::string_view KeyCharacters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-";
  for (const auto& [key, value] : metadata) {
    if (key.empty() || key.find_first_not_of(KeyCharacters) != std::string::npos) {
      throw InvalidInput("the tree cannot be written: \"" + key +
                         "\" is no name for field data; use letters, digits, '_', '.' and '-'");
    }
    if (value.find('\0') != std::string::npos) {
      throw InvalidInput("the tree cannot be written: the field data \"" + key +
                         "\" hold a zero byte");
    }
  }
}

}  // namespace

void requireWritable(const AirwayTree& tree, const Metadata& metadata) {
  requireWritableTree(tree);
  requireWritableMetadata(metadata);
}

std::string treeText(const AirwayTree& tree, const std::string& format, const Metadata& metadata) {
  using Writer = std::string (*)(const AirwayTree&, const Metadata&);
  const Writer writer = format == "vtp"    ? static_cast<Writer>(vtpText)
                        : format == "swc"  ? swcText
                        : format == "csv"  ? treeCsvText
                        : format == "json" ? treeJsonText
                                           : nullptr;
  if (writer == nullptr) {
    throw Unsupported("an airway tree cannot be written as \"" + format +
                      "\"; use vtp, swc, csv or json");
  }
  requireWritable(tree, metadata);
  return writer(tree, metadata);
}

void writeTree(const std::filesystem::path& path, const AirwayTree& tree,
               const Metadata& metadata) {
  const std::string extension = lowerCase(path.extension().string());
  if (extension.empty()) {
    throw Unsupported("cannot write " + quoted(path) +
                      ": it has no extension; end it in .vtp, .swc, .csv or .json");
  }
  writeFile(path, treeText(tree, extension.substr(1), metadata));
}

AirwayTree turnedFromRas(const AirwayTree& tree) {
  const auto turned = [](const Vec3& p) { return Vec3(-p.x(), -p.y(), p.z()); };
  AirwayTree result;
  result.reserve(tree.size());
  for (Branch branch : tree) {
    branch.proximal = turned(branch.proximal);
    branch.distal = turned(branch.distal);
    for (CentrelinePoint& point : branch.via) point.position = turned(point.position);
    result.add(std::move(branch));
  }
  return result;
}

std::string turnedFromRasNote(const std::string& name) {
  return name + " is in RAS coordinates; they were turned to LPS.";
}

}  // namespace pneuma
