#pragma once

#include "damaged.h"
#include "run_program.h"

namespace pneuma::damaged {

/// What is given to every run.
struct Bench {
  std::string program;
  std::filesystem::path seeds;
  std::filesystem::path work;  ///< a folder that is left empty
  Limits limits;
  bool keep = false;  ///< the folders of runs that failed
};

struct Verdict {
  Ending ending;
  std::string fault;  ///< empty: all is well
  std::string line;   ///< the command as it was
};

/// Runs a command upon a file in a folder of its own and tells what is wrong with how it ended.
/// @param number tells its folder from those of other runs
Verdict judge(const Bench& bench, const DamagedFile& file, const Command& command,
              std::size_t number);

}  // namespace pneuma::damaged
