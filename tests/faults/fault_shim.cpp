// Preloaded into the program under test: the n-th call of one kind fails. See docs/testing.md.
//
//   FAULT_CALL    write, sync, rename, open, close, seek, allocation, own-allocation, thread
//   FAULT_AT      which call fails, from 1; 0: none, calls are only counted
//   FAULT_ONWARD  1: all calls from that one on fail, as on a disk that stays full
//   FAULT_ERROR   number of the error; 0 for write: half of the bytes are written, and no error
//   FAULT_SIGNAL  is sent to the program before that call instead, and nothing fails
//   FAULT_UNDER   folders, parted by colons: calls for files elsewhere neither count nor fail
//   FAULT_BYTES   smaller allocations neither count nor fail
//   FAULT_REPORT  a file of 16 bytes: calls counted and calls failed, 64 bits each
//
// Nothing is counted before main(): what libraries do at their start is not ours to test.

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string_view>

#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

struct Report {
  std::atomic<std::uint64_t> counted{0};
  std::atomic<std::uint64_t> failed{0};
};

enum class Call { None, Write, Sync, Rename, Open, Close, Seek, Allocation, OwnAllocation, Thread };

constexpr std::array<std::string_view, 10> Names = {
    "",      "write", "sync",       "rename",         "open",
    "close", "seek",  "allocation", "own-allocation", "thread"};

Report unreported;
Report* report = &unreported;
Call call = Call::None;
std::uint64_t at = 0;
bool onward = false;
int error = EIO;
int signalNumber = 0;
std::size_t leastBytes = 0;
const char* under = nullptr;
std::atomic<bool> armed{false};
std::uintptr_t programBegin = 0;
std::uintptr_t programEnd = 0;

template <class F>
F* real(F* /*own*/, const char* name) {
  return reinterpret_cast<F*>(::dlsym(RTLD_NEXT, name));
}

// The next function of that name, looked up once. Not for malloc: dlsym() may allocate.
#define REAL(name) static auto* const next = real(&::name, #name)

std::uint64_t number(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

int findProgram(dl_phdr_info* info, std::size_t /*size*/, void* /*data*/) {
  for (int i = 0; i < info->dlpi_phnum; ++i) {  // the first one is the program itself
    const auto& part = info->dlpi_phdr[i];
    if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
    programBegin = info->dlpi_addr + part.p_vaddr;
    programEnd = programBegin + part.p_memsz;
  }
  return 1;
}

bool isOwn(const void* caller) {
  const auto address = reinterpret_cast<std::uintptr_t>(caller);
  return address >= programBegin && address < programEnd;
}

thread_local bool looking = false;  ///< at the stack, which may allocate

/// True if it is a library that allocates, by the copies of the standard library's functions that
/// are compiled into the program and that the linker lets libraries share. The call is made by
/// them.
bool isOfLibrary() {
  looking = true;
  std::array<void*, 64> frames{};
  const int count = ::backtrace(frames.data(), static_cast<int>(frames.size()));
  bool shared = false;
  bool result = false;
  for (int i = 0; i < count; ++i) {
    Dl_info place{};
    const bool known = ::dladdr(frames[i], &place) != 0;
    if (isOwn(frames[i])) {
      const std::string_view name = known && place.dli_sname != nullptr ? place.dli_sname : "";
      shared = name.starts_with("_ZNSt") || name.starts_with("_ZNKSt") || name.starts_with("_ZSt");
      if (!shared) break;
    } else if (shared && std::strstr(known ? place.dli_fname : "", "libstdc++") == nullptr) {
      result = true;
      break;
    }
  }
  looking = false;
  return result;
}

/// Counts a call. True if this one fails.
bool counts() {
  const std::uint64_t n = report->counted.fetch_add(1) + 1;
  const bool fails = at > 0 && (n == at || (onward && n > at));
  if (fails) report->failed.fetch_add(1);
  if (!fails || signalNumber == 0) return fails;
  ::kill(::getpid(), signalNumber);
  return false;
}

bool isUnder(std::string_view path) {
  if (under == nullptr) return true;
  std::string_view folders(under);
  while (!folders.empty()) {
    const std::string_view folder = folders.substr(0, folders.find(':'));
    if (path.starts_with(folder) && (path.size() == folder.size() || path[folder.size()] == '/')) {
      return true;
    }
    folders.remove_prefix(std::min(folders.size(), folder.size() + 1));
  }
  return false;
}

bool failsAtPath(Call kind, const char* path) {
  if (kind != call || !armed) return false;
  if (path[0] == '/') return isUnder(path) && counts();
  std::array<char, 2 * PATH_MAX> whole{};
  if (::getcwd(whole.data(), PATH_MAX) == nullptr) return false;
  std::strcat(whole.data(), "/");
  std::strncat(whole.data(), std::strncmp(path, "./", 2) == 0 ? path + 2 : path, PATH_MAX - 1);
  return isUnder(whole.data()) && counts();
}

bool failsAtFile(Call kind, int file) {
  if (kind != call || !armed) return false;
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "/proc/self/fd/%d", file);
  std::array<char, PATH_MAX> path{};
  if (::readlink(name.data(), path.data(), path.size() - 1) <= 0) return false;
  return isUnder(path.data()) && counts();
}

bool failsToAllocate(std::size_t bytes, const void* caller) {
  if (!armed.load(std::memory_order_relaxed)) return false;
  if (call == Call::Allocation) return bytes >= leastBytes && counts();
  if (call != Call::OwnAllocation || bytes < leastBytes || !isOwn(caller) || looking) return false;
  if (!counts()) return false;
  if (!isOfLibrary()) return true;
  report->failed.fetch_sub(1);
  return false;
}

int (*realMain)(int, char**, char**) = nullptr;

int armedMain(int argc, char** argv, char** environment) {
  armed = true;
  const int code = realMain(argc, argv, environment);
  armed = false;
  return code;
}

__attribute__((constructor)) void prepare() {
  const char* name = std::getenv("FAULT_CALL");
  for (std::size_t i = 1; name != nullptr && i < Names.size(); ++i) {
    if (Names[i] == name) call = static_cast<Call>(i);
  }
  at = number("FAULT_AT", 0);
  onward = number("FAULT_ONWARD", 0) != 0;
  error = static_cast<int>(number("FAULT_ERROR", EIO));
  signalNumber = static_cast<int>(number("FAULT_SIGNAL", 0));
  leastBytes = number("FAULT_BYTES", 0);
  under = std::getenv("FAULT_UNDER");
  ::dl_iterate_phdr(findProgram, nullptr);
  if (const char* path = std::getenv("FAULT_REPORT")) {
    const int file = ::open(path, O_RDWR | O_CLOEXEC);
    void* shared = ::mmap(nullptr, sizeof(Report), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file < 0 || shared == MAP_FAILED) std::abort();
    report = static_cast<Report*>(shared);
    ::close(file);
  }
}

int failed() {
  errno = error;
  return -1;
}

/// What is left of a piece that is to be written by halves.
std::size_t half(std::size_t size) { return size > 1 ? size / 2 : size; }

bool writes(const char* mode) { return std::strpbrk(mode, "wa+") != nullptr; }

}  // namespace

extern "C" {

int __libc_start_main(int (*theMain)(int, char**, char**), int argc, char** argv,
                      int (*init)(int, char**, char**), void (*fini)(), void (*rtldFini)(),
                      void* stackEnd) {
  REAL(__libc_start_main);
  realMain = theMain;
  return next(armedMain, argc, argv, init, fini, rtldFini, stackEnd);
}

ssize_t write(int file, const void* bytes, size_t size) {
  REAL(write);
  if (!failsAtFile(Call::Write, file)) return next(file, bytes, size);
  return error == 0 ? next(file, bytes, half(size)) : failed();
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
  REAL(pwrite);
  if (!failsAtFile(Call::Write, file)) return next(file, bytes, size, offset);
  return error == 0 ? next(file, bytes, half(size), offset) : failed();
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t offset) {
  REAL(pwrite64);
  if (!failsAtFile(Call::Write, file)) return next(file, bytes, size, offset);
  return error == 0 ? next(file, bytes, half(size), offset) : failed();
}

ssize_t writev(int file, const iovec* pieces, int count) {
  REAL(writev);
  if (!failsAtFile(Call::Write, file)) return next(file, pieces, count);
  return error == 0 ? next(file, pieces, 1) : failed();
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  REAL(fwrite);
  if (!failsAtFile(Call::Write, ::fileno(file))) return next(bytes, size, count, file);
  if (error == 0 || error == EINTR) return next(bytes, size, count, file);
  failed();
  return 0;
}

int fsync(int file) {
  REAL(fsync);
  return failsAtFile(Call::Sync, file) ? failed() : next(file);
}

int fdatasync(int file) {
  REAL(fdatasync);
  return failsAtFile(Call::Sync, file) ? failed() : next(file);
}

int rename(const char* from, const char* to) noexcept {
  REAL(rename);
  return failsAtPath(Call::Rename, to) ? failed() : next(from, to);
}

int renameat(int fromFolder, const char* from, int toFolder, const char* to) noexcept {
  REAL(renameat);
  return failsAtPath(Call::Rename, to) ? failed() : next(fromFolder, from, toFolder, to);
}

int link(const char* from, const char* to) noexcept {
  REAL(link);
  return failsAtPath(Call::Rename, to) ? failed() : next(from, to);
}

int mkdir(const char* path, mode_t mode) noexcept {
  REAL(mkdir);
  return failsAtPath(Call::Open, path) ? failed() : next(path, mode);
}

char* mkdtemp(char* path) noexcept {
  REAL(mkdtemp);
  if (!failsAtPath(Call::Open, path)) return next(path);
  failed();
  return nullptr;
}

#define OPEN(name, folderParameter, folder)                                              \
  int name(folderParameter const char* path, int flags, ...) {                           \
    REAL(name);                                                                          \
    va_list rest;                                                                        \
    va_start(rest, flags);                                                               \
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0; \
    va_end(rest);                                                                        \
    const bool fails = (flags & O_CREAT) != 0 && failsAtPath(Call::Open, path);          \
    return fails ? failed() : next(folder path, flags, mode);                            \
  }
#define WITH_FOLDER int folder,
#define FOLDER folder,
OPEN(open, , )
OPEN(open64, , )
OPEN(openat, WITH_FOLDER, FOLDER)
OPEN(openat64, WITH_FOLDER, FOLDER)

FILE* fopen(const char* path, const char* mode) {
  REAL(fopen);
  if (!writes(mode) || !failsAtPath(Call::Open, path)) return next(path, mode);
  failed();
  return nullptr;
}

FILE* fopen64(const char* path, const char* mode) {
  REAL(fopen64);
  if (!writes(mode) || !failsAtPath(Call::Open, path)) return next(path, mode);
  failed();
  return nullptr;
}

int close(int file) {
  REAL(close);
  const bool fails = (::fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY &&  // or it is not open
                     failsAtFile(Call::Close, file);
  const int result = next(file);
  return fails ? failed() : result;
}

off_t lseek(int file, off_t offset, int from) noexcept {
  REAL(lseek);
  return failsAtFile(Call::Seek, file) ? failed() : next(file, offset, from);
}

off64_t lseek64(int file, off64_t offset, int from) noexcept {
  REAL(lseek64);
  return failsAtFile(Call::Seek, file) ? failed() : next(file, offset, from);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) noexcept {
  REAL(pthread_create);
  if (call == Call::Thread && armed && counts()) return error;
  return next(thread, attributes, start, argument);
}

void* malloc(size_t bytes) noexcept {
  if (!failsToAllocate(bytes, __builtin_return_address(0))) return __libc_malloc(bytes);
  errno = ENOMEM;
  return nullptr;
}

void* calloc(size_t count, size_t bytes) noexcept {
  if (!failsToAllocate(count * bytes, __builtin_return_address(0))) {
    return __libc_calloc(count, bytes);
  }
  errno = ENOMEM;
  return nullptr;
}

void* realloc(void* old, size_t bytes) noexcept {
  if (bytes == 0 || !failsToAllocate(bytes, __builtin_return_address(0))) {
    return __libc_realloc(old, bytes);
  }
  errno = ENOMEM;
  return nullptr;
}

void* aligned_alloc(size_t alignment, size_t bytes) noexcept {
  if (!failsToAllocate(bytes, __builtin_return_address(0))) {
    return __libc_memalign(alignment, bytes);
  }
  errno = ENOMEM;
  return nullptr;
}

int posix_memalign(void** result, size_t alignment, size_t bytes) noexcept {
  if (failsToAllocate(bytes, __builtin_return_address(0))) return ENOMEM;
  *result = __libc_memalign(alignment, bytes);
  return *result == nullptr ? ENOMEM : 0;
}

}  // extern "C"

namespace {

void* tried(std::size_t bytes, std::size_t alignment, const void* caller) noexcept {
  if (failsToAllocate(bytes, caller)) return nullptr;
  const std::size_t some = bytes == 0 ? 1 : bytes;
  return alignment == 0 ? __libc_malloc(some) : __libc_memalign(alignment, some);
}

/// As the one of libstdc++.
void* allocated(std::size_t bytes, std::size_t alignment, const void* caller) {
  for (;;) {
    void* memory = tried(bytes, alignment, caller);
    if (memory != nullptr) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void* allocatedOrNull(std::size_t bytes, const void* caller) noexcept {
  try {
    return allocated(bytes, 0, caller);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

}  // namespace

// libstdc++ frees with free(), so that only these need to be here.
void* operator new(std::size_t bytes) { return allocated(bytes, 0, __builtin_return_address(0)); }

void* operator new[](std::size_t bytes) { return allocated(bytes, 0, __builtin_return_address(0)); }

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocated(bytes, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}

void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocated(bytes, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}

void* operator new(std::size_t bytes, const std::nothrow_t& /*unused*/) noexcept {
  return allocatedOrNull(bytes, __builtin_return_address(0));
}

void* operator new[](std::size_t bytes, const std::nothrow_t& /*unused*/) noexcept {
  return allocatedOrNull(bytes, __builtin_return_address(0));
}
