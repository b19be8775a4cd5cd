// replay FOLDER: reads every file of FOLDER/<target>/ as the fuzzer would. What it once found
// stands in findings/.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>

#include <unistd.h>

#include "targets.h"

namespace fs = std::filesystem;
using namespace pneuma::fuzz;

namespace {

std::vector<fs::path> filesOf(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: replay FOLDER\n");
    return 2;
  }
  const fs::path folder = fs::temp_directory_path() / ("replay-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  int read = 0;
  int faults = 0;
  for (const Target& target : targets()) {
    for (const fs::path& path : filesOf(fs::path(argv[1]) / target.name)) {
      std::ifstream file(path, std::ios::binary);
      const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
      std::printf("%s %s\n", target.name.c_str(), path.filename().c_str());
      std::fflush(stdout);
      ++read;
      try {
        tryBytes(target, folder,
                 {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
      } catch (const std::exception& error) {
        std::printf("  fault: %s\n", error.what());
        ++faults;
      }
    }
  }
  fs::remove_all(folder);
  std::printf("%d files, %d faults\n", read, faults);
  return read == 0 || faults > 0 ? 1 : 0;
}
