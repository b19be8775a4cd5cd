#include "io/detail/unpacked_data.h"

#include <algorithm>
#include <limits>
#include <new>

#include <zlib.h>

#include "core/error.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

constexpr std::size_t PackedPiece = std::size_t{1} << 18;

/// Window bits of inflateInit2 for either of zlib and gzip, whichever comes.
constexpr int EitherWrapper = 47;

}  // namespace

UnpackedData::UnpackedData(const ReadableFile& file, std::uint64_t offset, bool compressed)
    : file_(file), offset_(offset) {
  if (!compressed) return;
  stream_ = std::make_unique<z_stream_s>();
  packed_.resize(PackedPiece);
  if (inflateInit2(stream_.get(), EitherWrapper) != Z_OK) throw std::bad_alloc();
}

UnpackedData::~UnpackedData() {
  if (stream_ != nullptr) inflateEnd(stream_.get());
}

std::size_t UnpackedData::read(std::span<char> bytes) {
  if (stream_ != nullptr) return inflated(bytes);
  const std::size_t count = file_.read(bytes, offset_);
  offset_ += count;
  return count;
}

std::uint64_t UnpackedData::position() const {
  return stream_ == nullptr ? offset_ : offset_ - stream_->avail_in;
}

bool UnpackedData::refill() {
  if (stream_->avail_in > 0) return true;
  const std::size_t count = file_.read(packed_, offset_);
  offset_ += count;
  stream_->next_in = reinterpret_cast<Bytef*>(packed_.data());
  stream_->avail_in = static_cast<uInt>(count);
  return count > 0;
}

/// gzip files may be glued together: their contents follow one another. Whatever else follows is
/// left alone.
bool UnpackedData::beginsAnotherMember() {
  return refill() && *stream_->next_in == 0x1f && inflateReset(stream_.get()) == Z_OK;
}

std::size_t UnpackedData::inflated(std::span<char> bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size() && !ended_) {
    if (!refill()) {
      throw InvalidInput(quoted(file_.path()) +
                         " is cut off: its compressed data break off after " +
                         std::to_string(unpacked_ + filled) + " unpacked bytes; get it anew");
    }
    const std::size_t room =
        std::min<std::size_t>(bytes.size() - filled, std::numeric_limits<uInt>::max());
    stream_->next_out = reinterpret_cast<Bytef*>(bytes.data() + filled);
    stream_->avail_out = static_cast<uInt>(room);
    const int code = inflate(stream_.get(), Z_NO_FLUSH);
    filled += room - stream_->avail_out;
    if (code == Z_STREAM_END) {
      ended_ = !beginsAnotherMember();
    } else if (code == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (code != Z_OK && code != Z_BUF_ERROR) {
      throw InvalidInput(quoted(file_.path()) +
                         " is damaged: its compressed data cannot be "
                         "unpacked after " +
                         std::to_string(unpacked_ + filled) + " bytes (" +
                         (stream_->msg != nullptr ? stream_->msg : "no compressed data") +
                         "); get it anew");
    }
  }
  unpacked_ += filled;
  return filled;
}

}  // namespace pneuma
