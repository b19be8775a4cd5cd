#include "io/member_archive.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <new>
#include <set>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.h"
#include "core/memory.h"
#include "io/archive_lookup.h"
#include "io/atomic_file.h"
#include "io/detail/input_file.h"
#include "io/detail/text_fields.h"
#include "io/detail/zip_reading.h"
#include "io/unfinished_files.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t MostMembers = 10000;
constexpr std::size_t PieceBytes = std::size_t{1} << 20;
// Deflate makes 1032 of one byte at most.
constexpr std::uint64_t MostDeflated = 1032;
// The same members give the same bytes: no clock. 1 January 1980 is where those of zip begin.
constexpr std::time_t MemberTime = 315619200;

struct CloseWriter {
  void operator()(archive* handle) const { archive_write_free(handle); }
};

/// Bytes that an archive of `packed` bytes may unpack to.
std::uint64_t mostUnpacked(std::uint64_t packed, const ArchiveLimits& limits) {
  return std::min(limits.bytes, limits.freeSwelling + limits.swelling * packed);
}

/// The fewest bytes of an archive that unpacks to `unpacked`, as mostUnpacked() has it.
std::uint64_t leastPacked(std::uint64_t unpacked, const ArchiveLimits& limits) {
  if (unpacked <= limits.freeSwelling) return 0;
  return (unpacked - limits.freeSwelling + limits.swelling - 1) / limits.swelling;
}

/// Where libarchive's bytes go. Its code is C: what is thrown waits until it has returned.
struct Sink {
  AtomicFile& file;
  std::uint64_t bytes = 0;
  std::exception_ptr thrown = nullptr;
};

la_ssize_t writeTo(archive* /*handle*/, void* data, const void* bytes, std::size_t size) {
  Sink& sink = *static_cast<Sink*>(data);
  try {
    sink.file.write({static_cast<const char*>(bytes), size});
    sink.bytes += size;
    return static_cast<la_ssize_t>(size);
  } catch (...) {
    sink.thrown = std::current_exception();
    return -1;
  }
}

class ZipWriter {
 public:
  explicit ZipWriter(AtomicFile& file) : sink_{file}, handle_(archive_write_new()) {
    if (!handle_) throw std::bad_alloc();
    require(archive_write_set_format_zip(handle_.get()));
    // Twice as quick as the usual level, and a tenth larger.
    require(archive_write_set_options(handle_.get(), "zip:compression-level=3"));
    require(archive_write_set_bytes_in_last_block(handle_.get(), 1));
    require(archive_write_open(handle_.get(), &sink_, nullptr, writeTo, nullptr));
  }

  void add(const ArchiveMember& member, bool pack, const Progress& progress) {
    require(pack ? archive_write_zip_set_compression_deflate(handle_.get())
                 : archive_write_zip_set_compression_store(handle_.get()));
    const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(),
                                                                         archive_entry_free);
    if (!entry) throw std::bad_alloc();
    archive_entry_set_pathname_utf8(entry.get(), member.name.c_str());
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    archive_entry_set_mtime(entry.get(), MemberTime, 0);
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(member.content.size()));
    require(archive_write_header(handle_.get(), entry.get()));
    for (std::size_t done = 0; done < member.content.size(); done += PieceBytes) {
      progress.report(static_cast<double>(done) / static_cast<double>(member.content.size()));
      const std::size_t size = std::min(PieceBytes, member.content.size() - done);
      const la_ssize_t written =
          archive_write_data(handle_.get(), member.content.data() + done, size);
      require(written == static_cast<la_ssize_t>(size) ? ARCHIVE_OK : ARCHIVE_FATAL);
    }
    require(archive_write_finish_entry(handle_.get()));
  }

  void close() { require(archive_write_close(handle_.get())); }

  std::uint64_t bytes() const { return sink_.bytes; }

 private:
  void require(int result) const {
    if (sink_.thrown) std::rethrow_exception(sink_.thrown);
    if (result == ARCHIVE_OK || result == ARCHIVE_WARN) return;
    if (archive_errno(handle_.get()) == ENOMEM) throw std::bad_alloc();
    const char* reason = archive_error_string(handle_.get());
    throw Error(ExitCode::Internal,
                std::string("the archive cannot be made: ") + (reason == nullptr ? "" : reason));
  }

  Sink sink_;
  std::unique_ptr<archive, CloseWriter> handle_;
};

/// A name that goes away again, whatever happens.
struct Aside {
  explicit Aside(fs::path name) : path(std::move(name)) { noteUnfinished(path); }

  ~Aside() {
    std::error_code ignored;
    fs::remove(path, ignored);
    forgetUnfinished(path);
  }

  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;

  const fs::path path;
};

/// The file that is there gets a second name, so that its first one is never without a file.
void keepPrevious(const fs::path& path) {
  std::error_code error;
  const fs::path file = fs::weakly_canonical(path, error);
  if (error || !fs::is_regular_file(file, error)) return;
  const fs::path kept = file.string() + "~";
  // Has the lock of the file, whatever its name: nobody takes it for abandoned meanwhile.
  const Descriptor lock(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (lock.isOpen()) lockAside(lock.number());
  const Aside aside(file.parent_path() / nameAside(PartEnding));
  fs::create_hard_link(file, aside.path, error);
  // Disks without hard links (FAT, some network disks).
  if (error) fs::copy_file(file, aside.path, error);
  if (!error) fs::rename(aside.path, kept, error);
  if (!error) return;
  throw OutputFailed("cannot keep what was saved before as " + quoted(kept) + ": " +
                     error.message() + "; save under another name");
}

/// A member that is being written.
struct Packing {
  bool pack = false;
  std::uint64_t bytes = 0;  ///< that it took in the archive
};

/// Packs so many members no more, the smallest first, that the archive becomes `missing` bytes
/// longer; or all.
void packFewer(const std::vector<ArchiveMember>& members, std::uint64_t missing,
               std::vector<Packing>& packings) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (packings[i].pack) order.push_back(i);
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return members[i].content.size(); });
  std::uint64_t longer = 0;
  for (const std::size_t i : order) {
    if (longer >= missing) return;
    packings[i].pack = false;
    longer += members[i].content.size() - std::min(members[i].content.size(), packings[i].bytes);
  }
}

/// @param packed bytes of the archive
void requirePossibleSize(const fs::path& path, std::uint64_t packed, std::uint64_t stated,
                         const std::string& name) {
  if (stated <= MostDeflated * packed) return;
  throw InvalidInput("the archive " + quoted(path) + " states " + std::to_string(stated) +
                     " bytes for " + quotedName(name) + ", which it cannot hold; it is damaged");
}

/// Refuses what is no archive of ours before a byte is unpacked.
void requireSound(const fs::path& path, const Progress& progress, const ArchiveLimits& limits) {
  const Archive handle = openedArchive(path);
  std::error_code error;
  const std::uint64_t packed = fs::file_size(path, error);
  std::uint64_t total = 0;
  std::set<std::string> names;
  std::size_t count = 0;
  while (archive_entry* entry = nextEntry(path, handle.get())) {
    progress.throwIfStopped();
    const std::string name = entryName(entry, ++count);
    requireHarmlessEntry(path, entry, name);
    if (!names.insert(name).second) {
      throw InvalidInput("the archive " + quoted(path) + " holds " + quotedName(name) +
                         " twice; it is damaged");
    }
    const std::uint64_t stated = statedSize(entry);
    if (!error) requirePossibleSize(path, packed, stated, name);
    total += stated;
    if (count > MostMembers || total > mostUnpacked(error ? total : packed, limits)) {
      throw InvalidInput("the archive " + quoted(path) + " would swell to " +
                         std::to_string(total >> 20) + " MB or more in " + std::to_string(count) +
                         " files, which no project does; it was not unpacked");
    }
  }
  const std::uint64_t available = availableMemoryBytes();
  if (available > 0 && total > available) {
    throw Error(ExitCode::OutOfMemory,
                "opening " + quoted(path) + " takes " + std::to_string(total >> 20) +
                    " MB of memory, of which " + std::to_string(available >> 20) +
                    " MB are free; " + adviceForMemory());
  }
}

std::string contentOf(const fs::path& path, archive* handle, archive_entry* entry,
                      const std::string& name, const Progress& progress) {
  const std::uint64_t stated = statedSize(entry);
  std::string content;
  content.reserve(stated);
  std::vector<char> piece(PieceBytes);
  while (true) {
    const la_ssize_t size = archive_read_data(handle, piece.data(), piece.size());
    if (size < 0) throwDamagedArchive(path, handle, name);
    if (size == 0) break;
    progress.throwIfStopped();
    content.append(piece.data(), static_cast<std::size_t>(size));
    if (content.size() > stated) break;
  }
  if (content.size() != stated) {
    throw InvalidInput("the archive " + quoted(path) + " states " + std::to_string(stated) +
                       " bytes for " + quotedName(name) + " but holds others; it is damaged");
  }
  return content;
}

}  // namespace

bool isProjectFileName(const fs::path& path) {
  return lowerCase(path.extension().string()) == ".pneuma";
}

void writeArchive(const fs::path& path, const std::vector<ArchiveMember>& members,
                  const Progress& progress, const ArchiveLimits& limits) {
  std::uint64_t total = 0;
  std::vector<Packing> packings;
  for (const ArchiveMember& member : members) {
    total += member.content.size();
    packings.push_back({member.packed, 0});
  }
  for (bool again = false;; again = true) {
    AtomicFile file(path);
    ZipWriter writer(file);
    for (std::size_t i = 0; i < members.size(); ++i) {
      const auto count = static_cast<double>(members.size());
      const double from = again ? 1.0 : static_cast<double>(i) / count;
      const double to = again ? 1.0 : static_cast<double>(i + 1) / count;
      const std::uint64_t before = writer.bytes();
      writer.add(members[i], packings[i].pack, progress.part(from, to, "writing"));
      packings[i].bytes = writer.bytes() - before;
    }
    writer.close();
    progress.throwIfStopped();
    const std::uint64_t least = leastPacked(total, limits);
    if (writer.bytes() < least && std::ranges::any_of(packings, &Packing::pack)) {
      packFewer(members, least - writer.bytes(), packings);
      continue;
    }
    keepPrevious(path);
    file.commit();
    break;
  }
  progress.report(1.0);
}

std::vector<ArchiveMember> readArchive(const fs::path& path, const Progress& progress,
                                       const ArchiveLimits& limits) {
  requireSound(path, progress, limits);
  const Archive handle = openedArchive(path);
  std::vector<ArchiveMember> members;
  std::size_t count = 0;
  while (archive_entry* entry = nextEntry(path, handle.get())) {
    const std::string name = entryName(entry, ++count);
    if (!isFileEntry(entry)) continue;
    members.push_back({name, contentOf(path, handle.get(), entry, name, progress), true});
  }
  progress.report(1.0);
  return members;
}

std::optional<std::string> readMember(const fs::path& path, const std::string& name,
                                      std::uint64_t most, const Progress& progress) {
  const Archive handle = openedArchive(path);
  std::error_code error;
  const std::uint64_t packed = fs::file_size(path, error);
  std::size_t count = 0;
  while (archive_entry* entry = nextEntry(path, handle.get())) {
    progress.throwIfStopped();
    const std::string is = entryName(entry, ++count);
    requireHarmlessEntry(path, entry, is);
    if (is != name || !isFileEntry(entry)) continue;
    const std::uint64_t stated = statedSize(entry);
    if (!error) requirePossibleSize(path, packed, stated, is);
    if (stated > most) {
      throw InvalidInput("the archive " + quoted(path) + " states " + std::to_string(stated) +
                         " bytes for " + quotedName(name) + ", and at most " +
                         std::to_string(most) + " are read");
    }
    return contentOf(path, handle.get(), entry, name, progress);
  }
  return std::nullopt;
}

}  // namespace pneuma
