#include "render/movie.h"

#include <array>

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

}  // namespace

/// VTK's writer wants a file's name: it gets that of a file in memory.
struct Movie::State {
  VtkMessages messages;
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
  if (state.writer->GetError() != 0 || !state.messages.firstError().empty()) {
    throw OutputFailed("the film cannot be made; VTK says: " + state.messages.firstError());
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
    if (got <= 0) break;
    content.append(part.data(), static_cast<std::size_t>(got));
  }
  if (content.empty()) throw OutputFailed("the film cannot be made; there is no memory for it");
  return content;
}

}  // namespace pneuma
