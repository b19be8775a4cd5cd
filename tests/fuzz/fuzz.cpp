// What libFuzzer calls. PNEUMA_FUZZ names the target (targets.cpp), TMPDIR a folder in memory.
#include <cstdio>
#include <cstdlib>

#include <unistd.h>

#include "targets.h"

namespace {

namespace fs = std::filesystem;
using namespace pneuma::fuzz;

const Target& chosen() {
  const char* name = std::getenv("PNEUMA_FUZZ");
  for (const Target& target : targets()) {
    if (name != nullptr && target.name == name) return target;
  }
  std::fprintf(stderr, "PNEUMA_FUZZ has to be one of:");
  for (const Target& target : targets()) std::fprintf(stderr, " %s", target.name.c_str());
  std::fprintf(stderr, "\n");
  std::exit(2);
}

/// A folder of this process, which goes away with it unless it crashes.
struct Folder {
  const fs::path path = fs::temp_directory_path() / ("fuzz-" + std::to_string(::getpid()));

  Folder() { fs::create_directories(path); }

  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const Target& target = chosen();
  static const Folder folder;
  tryBytes(target, folder.path, {bytes, size});
  return 0;
}
