#include "io/atomic_file.h"

#include <cerrno>
#include <new>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"
#include "core/memory_watch.h"
#include "io/detail/file_access.h"
#include "io/detail/hex_digits.h"
#include "io/detail/input_file.h"
#include "io/detail/text_fields.h"
#include "io/unfinished_files.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

/// A path without the folders that files are written aside into.
fs::path withoutAside(const fs::path& path) {
  fs::path shown;
  for (const fs::path& part : path) {
    if (!isNameAside(part.native())) shown /= part;
  }
  return shown;
}

[[noreturn]] void throwSystemError(const fs::path& where, int error) {
  const fs::path path = withoutAside(where);
  const std::string folder = quoted(folderOf(path));
  std::string reason;
  switch (error) {
    case ELOOP:
      reason = "its links lead in a circle; remove them or choose another name";
      break;
    case ENOSPC:
    case EDQUOT:
      reason = "the disk of " + folder + " is full; free some space or choose another folder";
      break;
    case EFBIG:
      reason = "the file would be larger than the system allows; choose another folder";
      break;
    case EROFS:
      reason = "the disk of " + folder + " is read-only; choose another folder";
      break;
    case EACCES:
    case EPERM:
      reason =
          "the folder " + folder + " is read-only; choose another one or change its permissions";
      break;
    case ENOENT:
    case ENOTDIR:
      reason = "the folder " + folder +
               " does not exist or takes no files; create it or choose another one";
      break;
    case ENAMETOOLONG:
      reason = "the name is too long; choose a shorter one";
      break;
    default:
      reason = std::generic_category().message(error) + "; choose another folder";
  }
  throw OutputFailed("cannot write " + quoted(path) + ": " + reason);
}

/// Where the bytes go: the file a symbolic link stands for, so that the link itself survives.
fs::path targetOf(const fs::path& path) {
  fs::path target = endOfLinks(path);
  std::error_code ignored;
  if (fs::is_symlink(target, ignored)) throwSystemError(path, ELOOP);
  return target;
}

/// @throws OutputFailed unless `path` is free, or a file that may be replaced, in a folder
void requireFreeName(const fs::path& path, Existing existing) {
  if (path.filename().empty() || path.filename() == "." || path.filename() == "..") {
    throw OutputFailed("cannot write " + quoted(path) + ": it names a folder; add a file name");
  }
  std::error_code error;
  const fs::path folder = folderOf(path);
  const fs::file_status folderStatus = fs::status(folder, error);
  if (folderStatus.type() == fs::file_type::not_found) {
    throw OutputFailed("cannot write " + quoted(path) + ": the folder " + quoted(folder) +
                       " does not exist; create it first");
  }
  if (folderStatus.type() != fs::file_type::directory) {
    if (error) throwSystemError(path, error.value());
    throw OutputFailed("cannot write " + quoted(path) + ": " + quoted(folder) +
                       " is not a folder; choose another one");
  }
  switch (fs::status(path, error).type()) {
    case fs::file_type::not_found:
      return;
    case fs::file_type::directory:
      throw OutputFailed("cannot write " + quoted(path) + ": it is a folder; add a file name");
    case fs::file_type::regular:
      if (existing == Existing::Replace) return;
      throw OutputFailed("cannot write " + quoted(path) +
                         ": it exists already; choose another name or allow it to be replaced");
    case fs::file_type::none:
      throwSystemError(path, error.value());
    default:
      throw OutputFailed("cannot write " + quoted(path) +
                         ": it is a device or a pipe, not a file; choose another name");
  }
}

/// link() fails if the name was taken meanwhile; rename() would replace that file.
void takeFreeName(const fs::path& from, const fs::path& target) {
  if (::link(from.c_str(), target.c_str()) == 0) {
    ::unlink(from.c_str());
    return;
  }
  const int error = errno;
  requireFreeName(target, Existing::Refuse);
  // Disks without hard links (FAT, some network disks).
  const bool noLinks = error == EPERM || error == EOPNOTSUPP || error == ENOSYS;
  if (!noLinks || ::rename(from.c_str(), target.c_str()) != 0) {
    throwSystemError(target, noLinks ? errno : error);
  }
}

}  // namespace

void takeAccess(int file, const struct stat& of) noexcept {
  mode_t mode = of.st_mode & 07777U;

  struct stat own {};

  const bool sameGroup = ::fstat(file, &own) == 0 && own.st_gid == of.st_gid;
  if (!sameGroup && ::fchown(file, static_cast<uid_t>(-1), of.st_gid) != 0) {
    mode = (mode & ~070U) | ((mode & 07U) << 3U);
  }
  ::fchmod(file, mode);
}

fs::path endOfLinks(const fs::path& path) {
  constexpr int MostLinks = 40;  // as Linux has it
  fs::path end = path;
  std::error_code error;
  for (int n = 0; n < MostLinks && fs::is_symlink(end, error); ++n) {
    const fs::path next = fs::read_symlink(end, error);
    if (error) break;
    end = end.parent_path() / next;  // next alone if it is absolute
  }
  return end;
}

AtomicFile::AtomicFile(const fs::path& path, Existing existing)
    : target_(targetOf(path)), existing_(existing) {
  requireFreeName(target_, existing);
  removeAbandoned(folderOf(target_));

  // What replaces a file is this user's alone until it has the other's group and permissions.
  struct stat old {};

  const mode_t mode = ::stat(target_.c_str(), &old) == 0 ? 0600U : 0666U;
  for (int attempt = 0; attempt < 16; ++attempt) {
    part_ = folderOf(target_) / nameAside(PartEnding);
    noteUnfinished(part_);
    number_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    if (number_ >= 0) {
      lockAside(number_);
      return;
    }
    const int error = errno;
    forgetUnfinished(part_);
    if (error != EEXIST) throwSystemError(target_, error);
  }
  throwSystemError(target_, EEXIST);
}

AtomicFile::~AtomicFile() {
  if (number_ >= 0) ::close(number_);
  if (part_.empty()) return;
  ::unlink(part_.c_str());
  forgetUnfinished(part_);
}

void AtomicFile::write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(number_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throwSystemError(target_, written < 0 ? errno : ENOSPC);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

void AtomicFile::overwrite(std::uint64_t offset, std::string_view content) {
  const off_t end = ::lseek(number_, 0, SEEK_CUR);
  if (end < 0 || ::lseek(number_, static_cast<off_t>(offset), SEEK_SET) < 0) {
    throwSystemError(target_, errno);
  }
  write(content);
  if (::lseek(number_, end, SEEK_SET) < 0) throwSystemError(target_, errno);
}

void AtomicFile::commit() {
  if (memoryRanOut()) throw std::bad_alloc();  // what was written may be half of it

  struct stat old {};

  if (::stat(target_.c_str(), &old) == 0) takeAccess(number_, old);
  if (::fsync(number_) != 0 || ::close(std::exchange(number_, -1)) != 0) {
    throwSystemError(target_, errno);
  }
  if (existing_ == Existing::Refuse) {
    takeFreeName(part_, target_);
  } else if (::rename(part_.c_str(), target_.c_str()) != 0) {
    throwSystemError(target_, errno);
  }
  notePlaced(target_);
  forgetUnfinished(part_);
  part_.clear();
  syncFolder(folderOf(target_));
}

void requireWritable(const fs::path& path, Existing existing) {
  // Permissions, read-only disks and odd file systems: trying is the one sure test.
  const AtomicFile probe(path, existing);
}

fs::path folderOf(const fs::path& path) {
  const fs::path folder = path.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

void syncFolder(const fs::path& folder) noexcept {
  const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (opened.isOpen()) ::fsync(opened.number());
}

void makeFolder(const fs::path& folder) {
  std::error_code error;
  if (fs::create_directories(folder, error)) syncFolder(folderOf(folder));
  if (!error) return;
  throw OutputFailed("the folder " + quoted(folder) + " cannot be made: " + error.message() +
                     "; choose another");
}

void writeFile(const fs::path& path, std::string_view content, Existing existing) {
  AtomicFile file(path, existing);
  file.write(content);
  file.commit();
}

std::string readFile(const fs::path& path, std::size_t limit) {
  const ReadableFile file(path);
  if (file.size() > limit) {
    throw InvalidInput(quoted(path) + " has " + std::to_string(file.size()) +
                       " bytes, more than the limit of " + std::to_string(limit) +
                       "; is it the right file?");
  }
  std::string content(file.size(), '\0');
  content.resize(file.read(content, 0));
  return content;
}

std::string sha256(std::string_view content) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(content.data(), content.size(), digest.data(), &size, EVP_sha256(), nullptr) !=
      1) {
    throw Error(ExitCode::Internal, "OpenSSL could not compute a SHA-256");
  }
  return hexDigits({digest.data(), size});
}

}  // namespace pneuma
