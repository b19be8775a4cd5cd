#include "render/movie.h"

#include <array>
#include <cstdint>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkOggTheoraWriter.h>

#include "core/error.h"
#include "render/picture_data.h"
#include "render/vtk_messages.h"

namespace pneuma {
namespace {

constexpr int BestQuality = 2;

// Of a page of Ogg (RFC 3533), in bytes.
constexpr std::size_t PageHead = 27;
constexpr std::size_t SerialAt = 14;
constexpr std::size_t ChecksumAt = 22;
constexpr std::size_t SegmentsAt = 26;

std::uint32_t numberAt(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t n = 4; n > 0; --n) {
    number = number << 8 | static_cast<unsigned char>(bytes[at + n - 1]);
  }
  return number;
}

void putNumber(std::string& bytes, std::size_t at, std::uint32_t number) {
  for (std::size_t n = 0; n < 4; ++n) bytes[at + n] = static_cast<char>(number >> (8 * n) & 0xFFU);
}

/// CRC of a page whose own field is 0.
std::uint32_t checksum(std::string_view page) {
  std::uint32_t sum = 0;
  for (const char byte : page) {
    sum ^= static_cast<std::uint32_t>(static_cast<unsigned char>(byte)) << 24;
    for (int bit = 0; bit < 8; ++bit) sum = sum << 1 ^ ((sum >> 31) * 0x04C11DB7U);
  }
  return sum;
}

/// VTK numbers its streams otherwise in every run; the same film shall be the same file.
/// @throws OutputFailed if these are no pages
void setSerial(std::string& ogg, std::uint32_t serial) {
  for (std::size_t at = 0; at < ogg.size();) {
    std::size_t size = PageHead;
    const bool page = ogg.compare(at, 4, "OggS") == 0 && at + PageHead <= ogg.size();
    if (page) {
      const auto segments = static_cast<unsigned char>(ogg[at + SegmentsAt]);
      size += segments;
      for (std::size_t n = 0; n < segments && at + PageHead + n < ogg.size(); ++n) {
        size += static_cast<unsigned char>(ogg[at + PageHead + n]);
      }
    }
    const bool whole = page && at + size <= ogg.size();
    const std::uint32_t told = whole ? numberAt(ogg, at + ChecksumAt) : 0;
    if (whole) putNumber(ogg, at + ChecksumAt, 0);
    if (!whole || checksum(std::string_view(ogg).substr(at, size)) != told) {
      throw OutputFailed("the film cannot be made; what VTK wrote is damaged");
    }
    putNumber(ogg, at + SerialAt, serial);
    putNumber(ogg, at + ChecksumAt, checksum(std::string_view(ogg).substr(at, size)));
    at += size;
  }
}

}  // namespace

/// VTK's writer wants a file's name: it gets that of a file in memory.
struct Movie::State {
  int file = ::memfd_create("movie", MFD_CLOEXEC);
  int width = 0;
  int height = 0;
  vtkNew<vtkOggTheoraWriter> writer;
  bool started = false;

  ~State() {
    if (started) writer->End();
    if (file >= 0) ::close(file);
  }
};

Movie::Movie(int framesPerSecond) : state_(std::make_unique<State>()) {
  if (framesPerSecond < 1 || framesPerSecond > 120) {
    throw InvalidOption("a film has 1 to 120 pictures a second, not " +
                        std::to_string(framesPerSecond));
  }
  state_->writer->SetRate(framesPerSecond);
  state_->writer->SetQuality(BestQuality);
  state_->writer->SubsamplingOff();
}

Movie::~Movie() = default;

void Movie::add(const Picture& picture) {
  VtkMessages messages;
  State& state = *state_;
  if (!state.started) {
    if (state.file < 0) throw OutputFailed("there is no memory for a film");
    state.width = picture.width;
    state.height = picture.height;
    state.writer->SetInputData(imageDataOf(picture));
    state.writer->SetFileName(("/proc/self/fd/" + std::to_string(state.file)).c_str());
    state.writer->Start();
    state.started = true;
  }
  if (picture.width != state.width || picture.height != state.height) {
    throw InvalidInput("the pictures of a film have one size, that of the first");
  }
  state.writer->SetInputData(imageDataOf(picture));
  state.writer->Write();
  if (state.writer->GetError() != 0 || !messages.firstError().empty()) {
    throw OutputFailed("the film cannot be made; VTK says: " + messages.firstError());
  }
}

std::string Movie::finish() {
  State& state = *state_;
  if (!state.started) throw InvalidInput("a film needs a picture");
  state.writer->End();
  state.started = false;
  std::string content;
  std::array<char, 1 << 16> part{};
  for (;;) {
    const ssize_t got =
        ::pread(state.file, part.data(), part.size(), static_cast<off_t>(content.size()));
    if (got < 0) throw OutputFailed("the film cannot be made; it cannot be read back");
    if (got == 0) break;
    content.append(part.data(), static_cast<std::size_t>(got));
  }
  if (content.empty()) throw OutputFailed("the film cannot be made; there is no memory for it");
  setSerial(content, 1);
  return content;
}

}  // namespace pneuma
