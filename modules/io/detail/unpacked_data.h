#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/detail/volume_formats.h"

struct z_stream_s;

namespace pneuma {

/// Bytes of a file one after the other, unpacked if they are zlib or gzip (several members too).
class UnpackedData {
 public:
  /// From `offset` on. @throws InputMissing
  UnpackedData(const ReadableFile& file, std::uint64_t offset, bool compressed);
  ~UnpackedData();
  UnpackedData(const UnpackedData&) = delete;
  UnpackedData& operator=(const UnpackedData&) = delete;

  /// Fills `bytes`; returns how many there were, fewer only at the end, where check sums have been
  /// compared. @throws InvalidInput for damaged compressed data
  std::size_t read(std::span<char> bytes);

  /// Where the next compressed byte stands in the file.
  std::uint64_t position() const;

 private:
  std::size_t inflated(std::span<char> bytes);
  bool refill();
  bool beginsAnotherMember();

  const ReadableFile& file_;
  std::uint64_t offset_;  ///< of the next byte to be read from the file
  std::uint64_t unpacked_ = 0;
  bool ended_ = false;
  std::vector<char> packed_;
  std::unique_ptr<z_stream_s> stream_;  ///< none if the bytes are not compressed
};

}  // namespace pneuma
