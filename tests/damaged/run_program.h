#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pneuma::damaged {

struct Limits {
  double seconds = 5.0;
  long megabytes = 1024;
};

/// How a program ended.
struct Ending {
  int code = -1;
  int signal = 0;     ///< that ended it; 0: none
  bool late = false;  ///< it was stopped when its time was over
  double seconds = 0.0;
  long megabytes = 0;  ///< resident, at most
  std::string out;
  std::string err;
};

/// Runs a program in a folder, without input, its temporary files in `temporary`; it is stopped
/// with all that it started when its time is over.
Ending runProgram(const std::vector<std::string>& words, const std::filesystem::path& folder,
                  const std::filesystem::path& temporary, double seconds);

}  // namespace pneuma::damaged
