#include "io/detail/vtk_blocks.h"

#include <algorithm>

namespace pneuma {
namespace {

/// No compressor of VTK gains more.
constexpr std::uint64_t CompressionLimit = 8192;

int valueOfBase64(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// The first `count` bytes of what `text` stands for; fewer if it ends before.
std::string decodedStart(std::string_view text, std::size_t count) {
  std::string bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (std::size_t i = 0; i < text.size() && bytes.size() < count; ++i) {
    const int value = valueOfBase64(text[i]);
    if (value < 0) break;
    buffer = (buffer << 6) | static_cast<unsigned>(value);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes += static_cast<char>((buffer >> bits) & 0xFF);
    }
  }
  return bytes;
}

std::uint64_t base64Length(std::uint64_t bytes) { return (bytes + 2) / 3 * 4; }

/// True if the text's first characters can be decoded to `bytes` bytes: VTK stops at any other.
bool decodes(std::string_view text, std::uint64_t bytes) {
  if (base64Length(bytes) > text.size()) return false;
  text = text.substr(0, static_cast<std::size_t>((bytes * 8 + 5) / 6));
  return std::all_of(text.begin(), text.end(), [](char c) { return valueOfBase64(c) >= 0; });
}

/// The bytes at the beginning of an array, decoded if need be.
std::string start(std::string_view data, bool base64, std::size_t count) {
  return base64 ? decodedStart(data, count) : std::string(data.substr(0, count));
}

std::uint64_t word(const std::string& bytes, std::size_t index, const VtkBlockEncoding& encoding) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < encoding.wordSize; ++i) {
    const std::size_t place = encoding.bigEndian ? i : encoding.wordSize - 1 - i;
    value = value << 8 | static_cast<unsigned char>(bytes[index * encoding.wordSize + place]);
  }
  return value;
}

std::string problemOfPlainBlock(std::string_view data, bool base64,
                                const VtkBlockEncoding& encoding, std::uint64_t bytes) {
  const std::string header = start(data, base64, encoding.wordSize);
  if (header.size() < encoding.wordSize) return NoBlock;
  const std::uint64_t stored = word(header, 0, encoding);
  if (stored > data.size() - encoding.wordSize) return "is longer than the file";
  // The header and the data are encoded as one.
  if (base64 && !decodes(data, encoding.wordSize + stored)) return "is no sound base64";
  return stored < bytes ? "is too short" : "";
}

std::string problemOfCompressedBlock(std::string_view data, bool base64,
                                     const VtkBlockEncoding& encoding, std::uint64_t bytes) {
  const std::size_t fixed = 3 * encoding.wordSize;
  const std::string head = start(data, base64, fixed);
  if (head.size() < fixed) return NoBlock;
  const std::uint64_t blocks = word(head, 0, encoding);
  const std::uint64_t blockBytes = word(head, 1, encoding);
  const std::uint64_t lastBytes = word(head, 2, encoding);
  if (blocks == 0) return NoBlock;
  if (blocks > data.size() / encoding.wordSize) return "is longer than the file";
  const std::size_t headerBytes = fixed + static_cast<std::size_t>(blocks) * encoding.wordSize;
  const std::string header = start(data, base64, headerBytes);
  if (header.size() < headerBytes) return "has an incomplete header";

  std::uint64_t room = data.size();
  const std::uint64_t headerLength = base64 ? base64Length(headerBytes) : headerBytes;
  if (headerLength > room) return "has an incomplete header";
  room -= headerLength;
  if (base64) room = room / 4 * 3;
  std::uint64_t packed = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::uint64_t size = word(header, 3 + i, encoding);
    if (size > room - packed) return "is longer than the file";
    packed += size;
  }
  if (base64 && (!decodes(data, headerBytes) ||
                 !decodes(data.substr(static_cast<std::size_t>(headerLength)), packed))) {
    return "is no sound base64";
  }
  const std::uint64_t limit = CompressionLimit * (packed + 1);
  const std::uint64_t full = lastBytes > 0 ? blocks - 1 : blocks;
  if (blockBytes == 0 || lastBytes > blockBytes ||
      blockBytes > limit / std::max<std::uint64_t>(full, 1)) {
    return "has a header that cannot be";
  }
  const std::uint64_t stored = full * blockBytes + lastBytes;
  return stored < bytes ? "is too short" : "";
}

}  // namespace

std::string problemOfBlock(std::string_view data, bool base64, const VtkBlockEncoding& encoding,
                           std::uint64_t bytes) {
  return encoding.compressed ? problemOfCompressedBlock(data, base64, encoding, bytes)
                             : problemOfPlainBlock(data, base64, encoding, bytes);
}

}  // namespace pneuma
