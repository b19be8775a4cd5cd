#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "io/detail/tree_formats.h"

namespace pneuma {

/// The comments at the head of an SWC or CSV file: "# key: value" lines.
struct TreeComments {
  bool ownFile = false;  ///< Pneuma wrote the file
  bool ras = false;
  std::map<std::string, std::string, std::less<>> reserved;  ///< keys with blanks
  Metadata metadata;

  /// Takes in a line that begins with '#'.
  void add(std::string_view line);

  /// @throws InvalidInput if the file says under `key` how many items it has and they are not
  /// `count`, or if it does and its last line has no end: it was cut off
  void requireCount(std::string_view key, std::size_t count, std::string_view content,
                    const std::string& name) const;
};

/// The comments' lines. @throws InvalidInput for a key with other than letters, digits, '_', '.',
/// '-'
std::string treeCommentsText(const Metadata& metadata, std::string_view countKey,
                             std::size_t count);

}  // namespace pneuma
