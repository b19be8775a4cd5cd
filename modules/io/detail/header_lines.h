#pragma once

#include <map>
#include <string>
#include <string_view>

#include "io/detail/input_file.h"

namespace pneuma {

/// Fields of a text header by their names in lower case; those that come twice count once, the
/// last.
class HeaderFields {
 public:
  void set(std::string_view key, std::string_view value);

  bool has(const std::string& key) const { return values_.contains(key); }

  /// The value, blanks around it aside; "" if there is none.
  std::string_view operator[](const std::string& key) const;

  /// The first of several names that is there, "" if none is.
  std::string_view firstOf(std::initializer_list<const char*> keys) const;

 private:
  std::map<std::string, std::string, std::less<>> values_;
};

/// The beginning of a file in which a text header must end.
std::string headerText(const ReadableFile& file);

}  // namespace pneuma
