#include "bytes.h"

#include <cctype>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <stdexcept>
#include <tuple>

#include <zlib.h>

namespace pneuma::damaged {
namespace {

/// zlib's stream with a header of its own kind: 31 gzip, -15 none.
Bytes deflated(const Bytes& bytes, int window) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY);
  Bytes packed(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// Piece by piece: a program that is started counts the memory of who started it as its own.
std::pair<Bytes, std::uint32_t> deflatedZeros(std::size_t size) {
  Bytes piece(std::size_t{1} << 20, '\0');
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY);
  Bytes packed(size / 500 + 1000, '\0');
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  uLong crc = 0;
  for (std::size_t done = 0; done < size; done += piece.size()) {
    stream.next_in = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_in = static_cast<uInt>(piece.size());
    crc = crc32(crc, stream.next_in, stream.avail_in);
    deflate(&stream, done + piece.size() < size ? Z_NO_FLUSH : Z_FINISH);
  }
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return {packed, static_cast<std::uint32_t>(crc)};
}

Bytes inflated(const Bytes& bytes, int window) {
  z_stream stream{};
  inflateInit2(&stream, window);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  Bytes result;
  Bytes piece(1 << 16, '\0');
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    state = inflate(&stream, Z_NO_FLUSH);
    result.append(piece, 0, piece.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END) throw std::runtime_error("a seed is not packed as it should be");
  return result;
}

}  // namespace

Bytes contentOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("there is no seed " + file.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

void writeContent(const std::filesystem::path& file, const Bytes& content) {
  std::ofstream out(file, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

Bytes little(std::uint64_t value, std::size_t width) {
  Bytes bytes;
  for (std::size_t i = 0; i < width; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
  return bytes;
}

std::uint64_t littleAt(const Bytes& bytes, std::size_t at, std::size_t width) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < width && at + i < bytes.size(); ++i) {
    value |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  }
  return value;
}

Bytes floatBytes(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return little(bits, sizeof bits);
}

Bytes overwritten(Bytes bytes, std::size_t at, const Bytes& part) {
  if (at + part.size() <= bytes.size()) bytes.replace(at, part.size(), part);
  return bytes;
}

Bytes replaced(Bytes bytes, const std::string& old, const std::string& by, std::size_t from) {
  const std::size_t at = bytes.find(old, from);
  if (at != Bytes::npos) bytes.replace(at, old.size(), by);
  return bytes;
}

Bytes withLine(Bytes text, const std::string& prefix, const std::string& line) {
  std::size_t at = 0;
  while (at < text.size() && text.compare(at, prefix.size(), prefix) != 0) {
    at = text.find('\n', at);
    if (at == Bytes::npos) return text;
    ++at;
  }
  const std::size_t end = text.find('\n', at);
  if (end == Bytes::npos) return text;
  return line.empty() ? text.erase(at, end + 1 - at) : text.replace(at, end - at, line);
}

Bytes repeated(const std::string& part, std::size_t times) {
  Bytes bytes;
  bytes.reserve(part.size() * times);
  for (std::size_t i = 0; i < times; ++i) bytes += part;
  return bytes;
}

std::vector<Span> numbersIn(const Bytes& text, std::size_t from) {
  std::vector<Span> spans;
  const auto isWord = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '-' ||
           c == '+' || c == '/';
  };
  std::size_t at = from;
  while (at < text.size()) {
    if (!isWord(text[at])) {
      ++at;
      continue;
    }
    const std::size_t begin = at;
    while (at < text.size() && isWord(text[at])) ++at;
    const Bytes word = text.substr(begin, at - begin);
    const bool isNumber = word.find_first_not_of("0123456789.+-eE") == Bytes::npos &&
                          word.find_first_of("0123456789") != Bytes::npos &&
                          std::isalpha(static_cast<unsigned char>(word[0])) == 0;
    if (isNumber) spans.push_back({begin, word.size()});
  }
  return spans;
}

const std::vector<std::pair<std::string, std::string>>& nastyNumbers() {
  static const std::vector<std::pair<std::string, std::string>> values = {
      {"zero", "0"},
      {"minus-one", "-1"},
      {"two-to-31", "2147483648"},
      {"two-to-32", "4294967295"},
      {"1e18", "1000000000000000000"},
      {"1e300", "1e300"},
      {"nan", "nan"},
      {"inf", "inf"},
      {"missing", ""},
      {"word", "word"}};
  return values;
}

Bytes gzipped(const Bytes& bytes) { return deflated(bytes, 31); }

Bytes gunzipped(const Bytes& bytes) { return inflated(bytes, 31); }

std::vector<Member> unzip(const Bytes& archive) {
  const std::size_t end = archive.rfind("PK\5\6");
  if (end == Bytes::npos) throw std::runtime_error("a seed is no zip archive");
  std::vector<Member> members;
  std::size_t at = littleAt(archive, end + 16, 4);
  for (std::uint64_t i = littleAt(archive, end + 10, 2); i > 0; --i) {
    const std::size_t nameSize = littleAt(archive, at + 28, 2);
    const std::size_t packedSize = littleAt(archive, at + 20, 4);
    const std::size_t local = littleAt(archive, at + 42, 4);
    const std::size_t data =
        local + 30 + littleAt(archive, local + 26, 2) + littleAt(archive, local + 28, 2);
    Member member;
    member.name = archive.substr(at + 46, nameSize);
    member.packed = littleAt(archive, at + 10, 2) == 8;
    member.content = archive.substr(data, packedSize);
    if (member.packed) member.content = inflated(member.content, -15);
    members.push_back(std::move(member));
    at += 46 + nameSize + littleAt(archive, at + 30, 2) + littleAt(archive, at + 32, 2);
  }
  return members;
}

Bytes zip(const std::vector<Member>& members) {
  Bytes archive;
  Bytes directory;
  for (const Member& member : members) {
    const bool ready = !member.deflated.empty();
    const Bytes data = ready           ? member.deflated
                       : member.packed ? deflated(member.content, -15)
                                       : member.content;
    const int method = member.method >= 0 ? member.method : member.packed ? 8 : 0;
    const std::uint64_t size =
        member.size >= 0 ? static_cast<std::uint64_t>(member.size) : member.content.size();
    auto crc = ready ? member.crc
                     : static_cast<std::uint32_t>(
                           crc32(0, reinterpret_cast<const Bytef*>(member.content.data()),
                                 static_cast<uInt>(member.content.size())));
    if (member.crcLies) crc ^= 0x5555;
    const Bytes common = little(20, 2) + little(static_cast<unsigned>(member.flags), 2) +
                         little(static_cast<unsigned>(method), 2) + little(0x00210000, 4) +
                         little(crc, 4) + little(data.size(), 4) + little(size, 4) +
                         little(member.name.size(), 2) + little(0, 2);
    directory += "PK\1\2" + little(0x031E, 2) + common + little(0, 2) + little(0, 2) +
                 little(0, 2) + little(member.attributes, 4) + little(archive.size(), 4) +
                 member.name;
    archive += "PK\3\4" + common + member.name + data;
  }
  const std::size_t begin = archive.size();
  archive += directory;
  return archive + Bytes("PK\5\6\0\0\0\0", 8) + little(members.size(), 2) +
         little(members.size(), 2) + little(directory.size(), 4) + little(begin, 4) + little(0, 2);
}

Member zeros(const std::string& name, std::size_t size) {
  static std::mutex making;
  static std::map<std::size_t, Member> made;
  const std::lock_guard lock(making);
  Member& member = made[size];
  if (member.deflated.empty()) {
    std::tie(member.deflated, member.crc) = deflatedZeros(size);
    member.size = static_cast<std::int64_t>(size);
  }
  Member named = member;
  named.name = name;
  return named;
}

std::uint64_t Dice::below(std::uint64_t limit) {
  state_ += 0x9E3779B97F4A7C15U;  // splitmix64
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return (z ^ (z >> 31)) % limit;
}

}  // namespace pneuma::damaged
