#include "io/detail/header_lines.h"

#include <algorithm>

#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

/// Far more than any header; keeps a damaged one from being searched for its end for long.
constexpr std::uint64_t LongestHeader = std::uint64_t{1} << 20;

}  // namespace

void HeaderFields::set(std::string_view key, std::string_view value) {
  values_.insert_or_assign(lowerCase(trimmed(key)), std::string(trimmed(value)));
}

std::string_view HeaderFields::operator[](const std::string& key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? std::string_view() : std::string_view(found->second);
}

std::string_view HeaderFields::firstOf(std::initializer_list<const char*> keys) const {
  for (const char* key : keys) {
    if (has(key)) return (*this)[key];
  }
  return {};
}

std::string headerText(const ReadableFile& file) {
  std::string text(std::min(file.size(), LongestHeader), '\0');
  text.resize(file.read(text, 0));
  return text;
}

}  // namespace pneuma
