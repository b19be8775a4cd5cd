#include "io/detail/packed_writer.h"

#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include <zlib.h>

namespace pneuma {
namespace {

constexpr std::size_t PackedAtOnce = std::size_t{1} << 20;

/// Voxels of a CT pack hardly better at zlib's usual level, but take several times as long.
constexpr int Level = 2;

constexpr int LargestWindow = 15;

struct DeflateEnd {
  void operator()(z_stream* stream) const {
    deflateEnd(stream);
    delete stream;  // NOLINT(cppcoreguidelines-owning-memory): this is its owner
  }
};

using Deflater = std::unique_ptr<z_stream, DeflateEnd>;

Deflater deflater(Wrapper wrapper, gz_header& header) {
  Deflater stream(new z_stream{});
  constexpr int UsualMemory = 8;
  const int bits = wrapper == Wrapper::Gzip ? LargestWindow + 16 : LargestWindow;
  if (deflateInit2(stream.get(), Level, Z_DEFLATED, bits, UsualMemory, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::bad_alloc();
  }
  if (wrapper == Wrapper::Gzip) deflateSetHeader(stream.get(), &header);
  return stream;
}

}  // namespace

std::uint64_t writePacked(AtomicFile& file, Wrapper wrapper, std::span<const char> head,
                          std::span<const char> bytes, const Progress& progress) {
  constexpr int UnknownSystem = 255;
  gz_header header{};  // no time and no name, so that the bytes depend on the content alone
  header.os = UnknownSystem;
  const Deflater stream = deflater(wrapper, header);
  std::vector<char> packed(PackedAtOnce);
  std::uint64_t written = 0;
  const auto put = [&](std::span<const char> piece, int flush) {
    // zlib does not write to its input, it only lacks a const.
    stream->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
    stream->avail_in = static_cast<uInt>(piece.size());
    do {
      stream->next_out = reinterpret_cast<Bytef*>(packed.data());
      stream->avail_out = static_cast<uInt>(packed.size());
      deflate(stream.get(), flush);
      const std::size_t count = packed.size() - stream->avail_out;
      file.write({packed.data(), count});
      written += count;
    } while (stream->avail_out == 0);
  };
  put(head, Z_NO_FLUSH);
  for (std::size_t done = 0; done < bytes.size(); done += PackedAtOnce) {
    progress.report(static_cast<double>(done) / static_cast<double>(bytes.size()));
    put(bytes.subspan(done, std::min(PackedAtOnce, bytes.size() - done)), Z_NO_FLUSH);
  }
  put({}, Z_FINISH);
  progress.report(1.0);
  return written;
}

}  // namespace pneuma
