#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/math.h"

namespace pneuma {

/// The path in quotation marks, as messages name it.
std::string quoted(const std::filesystem::path& path);

/// A name in the same quotation marks.
std::string quotedName(std::string_view name);

/// The shortest text that reads back as the same number.
void appendNumber(std::string& text, double value);
void appendNumber(std::string& text, std::int64_t value);

std::string numberText(double value);

/// The point as messages name it: "(1, 2.5, -3) mm".
std::string pointText(const Vec3& p);

/// The number that is the whole of `text`, blanks around it aside; "nan" and "inf" are numbers.
std::optional<double> parseDouble(std::string_view text);
std::optional<std::int64_t> parseInteger(std::string_view text);

std::string_view trimmed(std::string_view text);

/// Takes the next word off the line; "" at its end.
std::string_view takeWord(std::string_view& line);

std::string lowerCase(std::string_view text);

/// Text on one line: backslash and line breaks as \\, \n, \r. unescaped() takes it back.
std::string escaped(std::string_view text);
std::string unescaped(std::string_view text);

/// The lines of a text one after the other, without their ends ("\n" or "\r\n").
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  /// The next line; nothing at the end of the text.
  std::optional<std::string_view> next();

  /// Number of the line that next() returned last, from 1.
  std::size_t number() const { return number_; }

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

}  // namespace pneuma
