#pragma once

#include "damaged.h"

/// Reading and changing bytes.
namespace pneuma::damaged {

Bytes contentOf(const std::filesystem::path& file);
void writeContent(const std::filesystem::path& file, const Bytes& content);

/// The lowest `width` bytes of a number, little endian.
Bytes little(std::uint64_t value, std::size_t width);
std::uint64_t littleAt(const Bytes& bytes, std::size_t at, std::size_t width);
Bytes floatBytes(float value);

/// `part` in place of what stands at `at`; nothing changes behind the end.
Bytes overwritten(Bytes bytes, std::size_t at, const Bytes& part);
/// The first `old` replaced; the same bytes if there is none.
Bytes replaced(Bytes bytes, const std::string& old, const std::string& by, std::size_t from = 0);
/// The first line that begins with `prefix` replaced; "" takes it away.
Bytes withLine(Bytes text, const std::string& prefix, const std::string& line);
Bytes repeated(const std::string& part, std::size_t times);

/// Where a number stands in a text.
struct Span {
  std::size_t at = 0;
  std::size_t size = 0;
};

std::vector<Span> numbersIn(const Bytes& text, std::size_t from = 0);

/// Values that no reader expects, as text.
const std::vector<std::pair<std::string, std::string>>& nastyNumbers();

Bytes gzipped(const Bytes& bytes);
Bytes gunzipped(const Bytes& bytes);

/// A member of a zip archive, and what its headers say of it.
struct Member {
  std::string name;
  Bytes content;
  bool packed = true;
  int method = -1;         ///< said; -1: what it is
  std::int64_t size = -1;  ///< said; -1: what it is
  int flags = 0;
  bool crcLies = false;
  std::uint32_t attributes = 0;  ///< external
  Bytes deflated = {};           ///< in place of the content, which is not there
  std::uint32_t crc = 0;         ///< of what `deflated` becomes
};

/// A member of whole megabytes of zeros, which deflate makes a thousandth of; made once and kept.
Member zeros(const std::string& name, std::size_t size);
/// The members of a sound archive.
std::vector<Member> unzip(const Bytes& archive);
Bytes zip(const std::vector<Member>& members);

/// Numbers by chance that are the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}

  std::uint64_t below(std::uint64_t limit);

 private:
  std::uint64_t state_;
};

}  // namespace pneuma::damaged
