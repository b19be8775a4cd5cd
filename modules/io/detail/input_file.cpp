#include "io/detail/input_file.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

/// Opened without waiting: a pipe that nobody writes to must not hang the program.
int openedForReading(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    throw InputMissing("there is no file " + quoted(path) + "; check its name and folder");
  }
  if (status.type() == fs::file_type::directory) {
    throw InputMissing(quoted(path) + " is a folder; name a file in it");
  }
  return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
}

}  // namespace

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

ReadableFile::ReadableFile(const fs::path& path) : path_(path), file_(openedForReading(path)) {
  struct stat information {};

  if (!file_.isOpen() || ::fstat(file_.number(), &information) != 0) {
    const int reason = errno;
    throw InputMissing("cannot read " + quoted(path) + ": " +
                       std::generic_category().message(reason) +
                       (reason == EACCES || reason == EPERM ? "; check its permissions"
                                                            : "; check its name and folder"));
  }
  if (!S_ISREG(information.st_mode)) {
    throw InputMissing(quoted(path) + " is a device or a pipe; name a file");
  }
  size_ = static_cast<std::uint64_t>(information.st_size);
}

std::size_t ReadableFile::read(std::span<char> bytes, std::uint64_t offset) const {
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t count = ::pread(file_.number(), bytes.data() + filled, bytes.size() - filled,
                                  static_cast<off_t>(offset + filled));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      throw InputMissing("cannot read " + quoted(path_) + ": " +
                         std::generic_category().message(errno));
    }
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  return filled;
}

}  // namespace pneuma
