#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace pneuma {

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}

  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

  bool isOpen() const { return number_ >= 0; }

 private:
  int number_;
};

/// A regular file, open for reading piece by piece.
class ReadableFile {
 public:
  /// @throws InputMissing if it is missing, unreadable, a folder, a device or a pipe
  explicit ReadableFile(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }

  /// Bytes when it was opened.
  std::uint64_t size() const { return size_; }

  /// Fills `bytes` from `offset` on; returns how many there were, fewer only at the end.
  /// @throws InputMissing if the disk fails
  std::size_t read(std::span<char> bytes, std::uint64_t offset) const;

 private:
  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t size_ = 0;
};

}  // namespace pneuma
