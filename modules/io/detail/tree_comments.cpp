#include "io/detail/tree_comments.h"

#include <algorithm>

#include "core/error.h"
#include "io/detail/text_fields.h"

namespace pneuma {

void TreeComments::add(std::string_view line) {
  if (trimmed(line) == TreeTextTitle) {
    ownFile = true;
    return;
  }
  if (line.find("SPACE=RAS") != std::string_view::npos) ras = true;
  line.remove_prefix(std::min(line.find_first_not_of("# \t"), line.size()));
  const std::size_t colon = line.find(": ");
  if (colon == std::string_view::npos) return;
  const std::string key(line.substr(0, colon));
  const std::string value = unescaped(line.substr(colon + 2));
  if (key == SpaceKey) {
    ras = value == "RAS";
  } else if (key.find(' ') != std::string::npos) {
    reserved[key] = value;
  } else if (ownFile && key != UnitsKey) {
    metadata[key] = value;
  }
}

void TreeComments::requireCount(std::string_view key, std::size_t count, std::string_view content,
                                const std::string& name) const {
  const auto entry = reserved.find(key);
  if (!ownFile || entry == reserved.end()) return;
  if (entry->second != std::to_string(count) || !content.ends_with('\n')) {
    throw InvalidInput(name + " was cut off or edited: its " + std::string(key) + " should be " +
                       entry->second + ", found " + std::to_string(count) +
                       (content.ends_with('\n') ? "" : " and an unfinished last line") +
                       "; use the original, or correct its comment \"# " + std::string(key) + "\"");
  }
}

std::string treeCommentsText(const Metadata& metadata, std::string_view countKey,
                             std::size_t count) {
  std::string text(TreeTextTitle);
  const auto addLine = [&](std::string_view key, std::string_view value) {
    text += "\n# ";
    text += key;
    text += ": ";
    text += value;
  };
  addLine(SpaceKey, "LPS");
  addLine(UnitsKey, Units);
  addLine(countKey, std::to_string(count));
  for (const auto& [key, value] : metadata) {
    if (key != SpaceKey && key != UnitsKey) addLine(key, escaped(value));
  }
  return text + "\n";
}

}  // namespace pneuma
