#include "io/detail/text_fields.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace pneuma {
namespace {

template <class Value>
void appendAny(std::string& text, Value value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

template <class Value>
std::optional<Value> parseAny(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  Value value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

}  // namespace

std::string quoted(const std::filesystem::path& path) {
  std::string text = "\"";
  text += path.string();
  return text += '"';
}

std::string quotedName(std::string_view name) { return quoted(std::filesystem::path(name)); }

void appendNumber(std::string& text, double value) { appendAny(text, value); }

void appendNumber(std::string& text, std::int64_t value) { appendAny(text, value); }

std::string numberText(double value) {
  std::string text;
  appendNumber(text, value);
  return text;
}

std::string pointText(const Vec3& p) {
  std::string text = "(";
  appendNumber(text, p.x());
  text += ", ";
  appendNumber(text, p.y());
  text += ", ";
  appendNumber(text, p.z());
  return text += ") mm";
}

std::optional<double> parseDouble(std::string_view text) { return parseAny<double>(text); }

std::optional<std::int64_t> parseInteger(std::string_view text) {
  return parseAny<std::int64_t>(text);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view Blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(Blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(Blanks) - begin + 1);
}

std::string_view takeWord(std::string_view& line) {
  line = trimmed(line);
  const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

std::string lowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '\\':
        result += "\\\\";
        break;
      case '\n':
        result += "\\n";
        break;
      case '\r':
        result += "\\r";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string unescaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      result += text[i];
      continue;
    }
    const char code = text[++i];
    result += code == 'n' ? '\n' : code == 'r' ? '\r' : code;
  }
  return result;
}

std::optional<std::string_view> Lines::next() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t end = rest_.find('\n');
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++number_;
  return line;
}

}  // namespace pneuma
