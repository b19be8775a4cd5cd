#include "io/detail/voxel_data.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/memory.h"
#include "io/detail/text_fields.h"
#include "io/detail/unpacked_data.h"

namespace pneuma {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Bytes of voxels that are read, converted and reported at a time.
constexpr std::size_t Piece = std::size_t{1} << 20;

/// deflate packs at most 1032 bytes into one.
constexpr std::uint64_t BestPacking = 1032;

/// Adding and taking away this rounds a double of less than 2^51 to the nearest whole number, and
/// unlike std::nearbyint it does so for several at a time.
constexpr double Rounder = 6755399441055744.0;

/// Bytes of the data as they stand in the file, from `offset` on.
struct StoredBytes {
  std::uint64_t offset = 0;
  std::uint64_t count = 0;
};

StoredBytes storedBytes(const VolumeLayout& layout, const ReadableFile& file) {
  const std::uint64_t size = file.size();
  if (!layout.offset.has_value()) {
    const std::uint64_t count = std::min(size, layout.voxelBytes());
    return {size - count, count};
  }
  return {*layout.offset, size - std::min(size, *layout.offset)};
}

std::string needed(const VolumeLayout& layout) {
  const auto& size = layout.header.geometry.size;
  return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
         std::to_string(size[2]) + " voxels of " + layout.header.scalarType + " take " +
         std::to_string(layout.voxelBytes()) + " bytes";
}

InvalidInput cutOff(const VolumeLayout& layout, std::uint64_t there) {
  return InvalidInput(quoted(layout.dataFile) + " is cut off: " + needed(layout) + ", but only " +
                      std::to_string(there) + " are there; get it anew");
}

InvalidInput tooLong(const VolumeLayout& layout) {
  return InvalidInput(quoted(layout.dataFile) + " holds more than its header says: " +
                      needed(layout) + ", and others follow; is the header that of another file?");
}

void requireRoomIn(const VolumeLayout& layout, const ReadableFile& file) {
  const StoredBytes stored = storedBytes(layout, file);
  const std::uint64_t bytes = layout.voxelBytes();
  if (!layout.compressed) {
    if (stored.count < bytes) throw cutOff(layout, stored.count);
    if (stored.count > bytes) throw tooLong(layout);
    return;
  }
  if (layout.packedBytes.has_value() && stored.count < *layout.packedBytes) {
    throw InvalidInput(quoted(layout.dataFile) + " is cut off: its header says " +
                       std::to_string(*layout.packedBytes) + " compressed bytes, but only " +
                       std::to_string(stored.count) + " are there; get it anew");
  }
  if (stored.count < bytes / BestPacking) {
    throw InvalidInput(quoted(layout.dataFile) +
                       " is cut off or its header is damaged: " + needed(layout) + ", which its " +
                       std::to_string(stored.count) + " compressed bytes cannot hold; get it anew");
  }
}

void requireMemory(const VolumeLayout& layout, std::uint64_t bytes) {
  const std::uint64_t available = availableMemoryBytes();
  if (available == 0 || bytes + 4 * Piece <= available) return;
  throw Error(ExitCode::OutOfMemory, quoted(layout.dataFile) + " takes " +
                                         std::to_string(bytes >> 20) + " MB of memory, but only " +
                                         std::to_string(available >> 20) + " MB are free; " +
                                         adviceForMemory() + ", or crop the volume");
}

/// What may become of a value.
template <class T>
struct Meaning;

template <>
struct Meaning<std::int16_t> {
  static constexpr bool Rounds = true;
  static constexpr const char* Values = "a CT in HU has numbers from -32768 to 32767";
};

template <>
struct Meaning<std::uint8_t> {
  static constexpr bool Rounds = false;
  static constexpr const char* Values = "labels are whole numbers from 0 to 255";
};

/// A piece of stored values on their way into voxels of type T.
template <class T>
struct Conversion {
  const VolumeLayout& layout;
  std::span<const char> stored;
  T* voxels;           ///< where the piece goes
  std::size_t before;  ///< voxels before the piece
};

template <class Value>
Value loaded(const char* bytes, bool swap) {
  std::array<char, sizeof(Value)> own;
  std::memcpy(own.data(), bytes, sizeof(Value));
  if (swap) std::reverse(own.begin(), own.end());
  return std::bit_cast<Value>(own);
}

template <class T>
[[noreturn]] void throwBadValue(const Conversion<T>& piece, std::size_t index, double value) {
  const auto& size = piece.layout.header.geometry.size;
  const std::size_t voxel = piece.before + index;
  const auto [ni, nj] =
      std::pair(static_cast<std::size_t>(size[0]), static_cast<std::size_t>(size[1]));
  throw InvalidInput(quoted(piece.layout.dataFile) + " has the value " + numberText(value) +
                     " at voxel (" + std::to_string(voxel % ni) + ", " +
                     std::to_string(voxel / ni % nj) + ", " + std::to_string(voxel / ni / nj) +
                     "); " + Meaning<T>::Values + ": is it the right file?");
}

template <class Value, class T, bool Swap>
void convertAs(const Conversion<T>& piece) {
  constexpr double Low = std::numeric_limits<T>::min();
  constexpr double High = std::numeric_limits<T>::max();
  const double slope = piece.layout.header.slope;
  const double intercept = piece.layout.header.intercept;
  const std::size_t count = piece.stored.size() / sizeof(Value);
  const auto valueAt = [&](std::size_t i) {
    const auto stored = loaded<Value>(piece.stored.data() + i * sizeof(Value), Swap);
    return slope * static_cast<double>(stored) + intercept;
  };
  const auto isGood = [](double value, double rounded) {
    return rounded >= Low && rounded <= High && (Meaning<T>::Rounds || rounded == value);
  };
  bool good = true;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = valueAt(i);
    const double rounded = (value + Rounder) - Rounder;
    const bool fits = isGood(value, rounded);
    good &= fits;
    piece.voxels[i] = static_cast<T>(static_cast<int>(fits ? rounded : 0.0));
  }
  if (good) return;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = valueAt(i);
    if (!isGood(value, (value + Rounder) - Rounder)) throwBadValue(piece, i, value);
  }
}

template <class Value, class T>
void convertFrom(const Conversion<T>& piece) {
  if (piece.layout.bigEndian) {
    convertAs<Value, T, true>(piece);
  } else {
    convertAs<Value, T, false>(piece);
  }
}

template <class T>
void convert(const Conversion<T>& piece) {
  switch (piece.layout.scalar) {
    case Scalar::Int8:
      return convertFrom<std::int8_t>(piece);
    case Scalar::Uint8:
      return convertFrom<std::uint8_t>(piece);
    case Scalar::Int16:
      return convertFrom<std::int16_t>(piece);
    case Scalar::Uint16:
      return convertFrom<std::uint16_t>(piece);
    case Scalar::Int32:
      return convertFrom<std::int32_t>(piece);
    case Scalar::Uint32:
      return convertFrom<std::uint32_t>(piece);
    case Scalar::Int64:
      return convertFrom<std::int64_t>(piece);
    case Scalar::Uint64:
      return convertFrom<std::uint64_t>(piece);
    case Scalar::Float32:
      return convertFrom<float>(piece);
    case Scalar::Float64:
      return convertFrom<double>(piece);
  }
}

/// True if the bytes of the file are those of the result.
template <class T>
bool isStoredAsItIs(const VolumeLayout& layout) {
  constexpr Scalar Own = sizeof(T) == 1 ? Scalar::Uint8 : Scalar::Int16;
  return layout.scalar == Own && (sizeof(T) == 1 || !layout.bigEndian) &&
         layout.header.slope == 1.0 && layout.header.intercept == 0.0;
}

void skipBytes(UnpackedData& data, const VolumeLayout& layout, std::vector<char>& buffer,
               const Progress& progress) {
  for (std::uint64_t left = layout.skip; left > 0;) {
    progress.throwIfStopped();
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(left, Piece));
    buffer.resize(count);
    if (data.read(buffer) < count) throw cutOff(layout, 0);
    left -= count;
  }
}

/// Whatever follows the voxels. Reading on also makes zlib compare the check sum.
void requireEnd(UnpackedData& data, const VolumeLayout& layout, const ReadableFile& file) {
  char one = 0;
  if (data.read({&one, 1}) > 0) throw tooLong(layout);
  if (layout.compressed && data.position() < file.size()) throw tooLong(layout);
}

template <class T>
std::vector<T> voxelsOf(const VolumeLayout& layout, const Progress& progress) {
  progress.report(0.0);
  const ReadableFile file(layout.dataFile);
  requireRoomIn(layout, file);
  const std::size_t count = layout.header.geometry.voxelCount();
  requireMemory(layout, count * sizeof(T));
  UnpackedData data(file, storedBytes(layout, file).offset, layout.compressed);
  std::vector<char> buffer;
  skipBytes(data, layout, buffer, progress);
  std::vector<T> voxels(count);
  const bool direct = isStoredAsItIs<T>(layout);
  const std::size_t valueBytes = bytesOf(layout.scalar);
  const std::size_t pieceVoxels = Piece / valueBytes;
  for (std::size_t done = 0; done < count;) {
    const std::size_t now = std::min(pieceVoxels, count - done);
    std::span<char> bytes;
    if (direct) {
      bytes = {reinterpret_cast<char*>(voxels.data() + done), now * sizeof(T)};
    } else {
      buffer.resize(now * valueBytes);
      bytes = buffer;
    }
    const std::size_t there = data.read(bytes);
    if (there < bytes.size()) throw cutOff(layout, done * valueBytes + there);
    if (!direct) convert(Conversion<T>{layout, bytes, voxels.data() + done, done});
    done += now;
    progress.report(static_cast<double>(done) / static_cast<double>(count));
  }
  requireEnd(data, layout, file);
  return voxels;
}

}  // namespace

void requireRoomForVoxels(const VolumeLayout& layout) {
  requireRoomIn(layout, ReadableFile(layout.dataFile));
}

std::vector<std::int16_t> huVoxels(const VolumeLayout& layout, const Progress& progress) {
  return voxelsOf<std::int16_t>(layout, progress);
}

std::vector<std::uint8_t> labelVoxels(const VolumeLayout& layout, const Progress& progress) {
  return voxelsOf<std::uint8_t>(layout, progress);
}

}  // namespace pneuma
