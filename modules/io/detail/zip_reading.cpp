#include "io/detail/zip_reading.h"

#include <algorithm>
#include <cerrno>
#include <new>

#include "core/error.h"
#include "io/detail/input_file.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

constexpr std::size_t ArchiveBlock = std::size_t{1} << 18;

bool leadsOut(const std::string& name) {
  if (name.starts_with('/') || name.starts_with('\\') || (name.size() > 1 && name[1] == ':')) {
    return true;
  }
  std::string forward = name;
  std::ranges::replace(forward, '\\', '/');
  return std::ranges::any_of(std::filesystem::path(forward),
                             [](const std::filesystem::path& part) { return part == ".."; });
}

}  // namespace

void throwDamagedArchive(const std::filesystem::path& path, archive* handle,
                         const std::string& name) {
  if (archive_errno(handle) == ENOMEM) throw std::bad_alloc();
  const char* reason = archive_error_string(handle);
  const std::string text = reason == nullptr ? "" : reason;
  const std::string where = "the archive " + quoted(path);
  if (lowerCase(text).find("encrypt") != std::string::npos ||
      lowerCase(text).find("passphrase") != std::string::npos) {
    throw Unsupported(where + " is protected by a password; unpack it first");
  }
  throw InvalidInput(where + " is damaged" + (name.empty() ? "" : " at " + quotedName(name)) +
                     (text.empty() ? "" : " (" + text + ")") + "; copy it again from its source");
}

Archive openedArchive(const std::filesystem::path& path) {
  const ReadableFile readable(path);  // or says what is wrong with it; a pipe is not waited for
  Archive handle(archive_read_new());
  if (!handle) throw std::bad_alloc();
  archive_read_support_format_zip_seekable(handle.get());
  if (archive_read_open_filename(handle.get(), path.c_str(), ArchiveBlock) != ARCHIVE_OK) {
    throwDamagedArchive(path, handle.get(), "");
  }
  return handle;
}

archive_entry* nextEntry(const std::filesystem::path& path, archive* handle) {
  archive_entry* entry = nullptr;
  const int result = archive_read_next_header(handle, &entry);
  if (result == ARCHIVE_EOF) return nullptr;
  if (result != ARCHIVE_OK && result != ARCHIVE_WARN) throwDamagedArchive(path, handle, "");
  return entry;
}

std::string entryName(archive_entry* entry, std::size_t number) {
  const char* name = archive_entry_pathname_utf8(entry);
  if (name == nullptr) name = archive_entry_pathname(entry);
  return name == nullptr ? "entry " + std::to_string(number) : name;
}

bool isFileEntry(archive_entry* entry) {
  return archive_entry_filetype(entry) == AE_IFREG && archive_entry_hardlink(entry) == nullptr;
}

std::uint64_t statedSize(archive_entry* entry) {
  return static_cast<std::uint64_t>(std::max<la_int64_t>(0, archive_entry_size(entry)));
}

void requireHarmlessEntry(const std::filesystem::path& path, archive_entry* entry,
                          const std::string& name) {
  if (leadsOut(name)) {
    throw InvalidInput("the archive " + quoted(path) + " names " + quotedName(name) +
                       ", a place outside of it; it was not unpacked");
  }
  if (archive_entry_is_encrypted(entry) != 0) {
    throw Unsupported("the archive " + quoted(path) +
                      " is protected by a password; unpack it first");
  }
}

}  // namespace pneuma
