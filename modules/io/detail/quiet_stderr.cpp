#include "io/detail/quiet_stderr.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <streambuf>

namespace pneuma {
namespace {

constexpr std::size_t MostKept = 4096;

/// What a thread has printed, while it is to be quiet.
struct Kept {
  bool quiet = false;
  std::string text;

  void add(const char* from, std::size_t size) {
    if (quiet && text.size() < MostKept) text.append(from, std::min(size, MostKept - text.size()));
  }
};

Kept& kept() {
  static thread_local Kept here;
  return here;
}

ssize_t keep(void* /*cookie*/, const char* text, std::size_t size) {
  kept().add(text, size);
  return static_cast<ssize_t>(size);
}

/// Never closed: a library may hold on to it.
std::FILE* sink() {
  static std::FILE* const stream = [] {
    std::FILE* made = ::fopencookie(nullptr, "w", {nullptr, keep, nullptr, nullptr});
    if (made != nullptr) std::setvbuf(made, nullptr, _IONBF, 0);  // written by the printing thread
    return made;
  }();
  return stream;
}

/// Keeps what quiet threads print, and passes on what others do.
class Sieve : public std::streambuf {
 public:
  std::streambuf* behind = nullptr;

 protected:
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    if (!kept().quiet) return behind->sputn(text, size);
    kept().add(text, static_cast<std::size_t>(size));
    return size;
  }

  int_type overflow(int_type c) override {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    const char letter = traits_type::to_char_type(c);
    return xsputn(&letter, 1) == 1 ? c : traits_type::eof();
  }

  int sync() override { return kept().quiet ? 0 : behind->pubsync(); }
};

/// Never destroyed: a thread may still print through it.
Sieve& sieve() {
  static Sieve* const made = new Sieve;
  return *made;
}

std::mutex mutex;
int living = 0;
std::FILE* before = nullptr;

}  // namespace

// glibc documents stderr as a variable that may be assigned; std::cerr has taken the old one.
QuietStderr::QuietStderr() {
  kept().quiet = true;
  kept().text.clear();
  const std::lock_guard lock(mutex);
  if (living++ > 0) return;
  sieve().behind = std::cerr.rdbuf();
  std::cerr.rdbuf(&sieve());
  if (sink() == nullptr) return;
  before = stderr;
  stderr = sink();
}

QuietStderr::~QuietStderr() {
  kept().quiet = false;
  const std::lock_guard lock(mutex);
  if (--living > 0) return;
  std::cerr.rdbuf(sieve().behind);
  if (before == nullptr) return;
  stderr = before;
  before = nullptr;
}

const std::string& QuietStderr::text() const { return kept().text; }

}  // namespace pneuma
