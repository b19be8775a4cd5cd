// damaged PROGRAM SEEDS [--sample N] [--commands N] [--only TEXT] [--keep FOLDER] [--seconds S]
// [--megabytes MB]
//                       [--list] [--write FOLDER]
// Runs every command upon every damaged file that it reads, two at a time; prints a table of each
// format and a line for each fault. Ends with 1 if there is one.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "bytes.h"
#include "judge.h"

namespace fs = std::filesystem;
using namespace pneuma::damaged;

namespace {

struct Options {
  Bench bench;
  std::size_t sample = 0;       ///< files; 0: all
  std::size_t commands = 1000;  ///< of each file, the first ones
  std::string only;
  bool list = false;
  fs::path write;
};

Options optionsOf(int argc, char** argv) {
  if (argc < 3) throw std::runtime_error("usage: damaged PROGRAM SEEDS [OPTIONS]");
  Options options;
  options.bench.program = fs::absolute(argv[1]).string();
  options.bench.seeds = fs::absolute(argv[2]);
  for (int i = 3; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--list") {
      options.list = true;
      continue;
    }
    if (++i >= argc) throw std::runtime_error(option + " needs a value");
    const std::string value = argv[i];
    if (option == "--sample") {
      options.sample = std::stoul(value);
    } else if (option == "--commands") {
      options.commands = std::stoul(value);
    } else if (option == "--only") {
      options.only = value;
    } else if (option == "--keep") {
      options.bench.keep = true;
      options.bench.work = value;
    } else if (option == "--seconds") {
      options.bench.limits.seconds = std::stod(value);
    } else if (option == "--megabytes") {
      options.bench.limits.megabytes = std::stol(value);
    } else if (option == "--write") {
      options.write = value;
    } else {
      throw std::runtime_error("there is no option " + option);
    }
  }
  return options;
}

/// The n files that are spread most evenly over formats and, within each, over kinds of damage.
std::vector<DamagedFile> spread(const std::vector<DamagedFile>& files, std::size_t n) {
  std::vector<std::string> formats;
  std::map<std::string, std::vector<const DamagedFile*>> byFormat;
  for (const DamagedFile& file : files) {
    if (file.wanted == Wanted::Read) continue;
    if (byFormat[file.format].empty()) formats.push_back(file.format);
    byFormat[file.format].push_back(&file);
  }
  std::vector<DamagedFile> chosen;
  std::set<std::string> kinds;
  for (std::size_t turn = 0; chosen.size() < n; ++turn) {
    bool any = false;
    for (std::size_t f = 0; f < formats.size() && chosen.size() < n; ++f) {
      auto& rest = byFormat[formats[f]];
      if (rest.empty()) continue;
      any = true;
      // A place that differs from format to format and from turn to turn; there, a new kind.
      std::size_t at = (f * 37 + turn * 101) % rest.size();
      for (std::size_t k = 0; k < rest.size(); ++k) {
        const std::size_t other = (at + k) % rest.size();
        if (kinds.count(rest[other]->kind) == 0) {
          at = other;
          break;
        }
      }
      kinds.insert(rest[at]->kind);
      chosen.push_back(*rest[at]);
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
      if (kinds.size() >= 12) kinds.clear();
    }
    if (!any) break;
  }
  return chosen;
}

struct Job {
  const DamagedFile* file;
  const Command* command;
  Verdict verdict;
};

std::string shown(std::string text) {
  for (char& c : text) c = c == '\n' ? '~' : c;
  return text.substr(0, 300);
}

/// At once, so that long runs may be watched.
void tellFault(const Job& job) {
  if (job.verdict.fault.empty()) return;
  std::printf("FAULT %s/%s: %s\n  pneuma %s\n  exit code %d: %s\n", job.file->format.c_str(),
              shown(job.file->name).c_str(), job.verdict.fault.c_str(),
              shown(job.verdict.line).c_str(), job.verdict.ending.code,
              shown(job.verdict.ending.err).c_str());
  std::fflush(stdout);
}

int report(const std::vector<Job>& jobs) {
  struct Row {
    std::set<std::string> files;
    int runs = 0;
    std::map<std::string, int> endings;
    double slowest = 0.0;
    long largest = 0;
    int faults = 0;
  };

  std::vector<std::string> order;
  std::map<std::string, Row> rows;
  Row total;
  for (const Job& job : jobs) {
    const Ending& ending = job.verdict.ending;
    if (rows[job.file->format].runs == 0) order.push_back(job.file->format);
    const std::string how = ending.late          ? "late"
                            : ending.signal != 0 ? "signal"
                                                 : std::to_string(ending.code);
    for (Row* row : {&rows[job.file->format], &total}) {
      row->files.insert(job.file->format + "/" + job.file->name);
      ++row->runs;
      ++row->endings[how];
      row->slowest = std::max(row->slowest, ending.seconds);
      row->largest = std::max(row->largest, ending.megabytes);
      row->faults += job.verdict.fault.empty() ? 0 : 1;
    }
  }
  std::printf("%-14s %6s %6s %8s %6s %6s  %s\n", "format", "files", "runs", "slowest", "MB",
              "faults", "endings: how often");
  order.emplace_back("all");
  rows["all"] = total;
  for (const std::string& name : order) {
    const Row& row = rows[name];
    std::string endings;
    for (const auto& [how, times] : row.endings)
      endings += how + ": " + std::to_string(times) + "  ";
    std::printf("%-14s %6zu %6d %6.2f s %6ld %6d  %s\n", name.c_str(), row.files.size(), row.runs,
                row.slowest, row.largest, row.faults, endings.c_str());
  }
  return total.faults == 0 && total.runs > 0 ? 0 : 1;
}

void runAll(std::vector<Job>& jobs, const Bench& bench) {
  std::atomic<std::size_t> next{0};
  std::mutex telling;
  const auto work = [&] {
    for (std::size_t i = next++; i < jobs.size(); i = next++) {
      try {
        jobs[i].verdict = judge(bench, *jobs[i].file, *jobs[i].command, i);
      } catch (const std::exception& error) {
        jobs[i].verdict.fault = std::string("could not be run: ") + error.what();
      }
      const std::lock_guard lock(telling);
      if (!jobs[i].verdict.ending.late) tellFault(jobs[i]);
    }
  };
  std::thread other(work);
  work();
  other.join();
  // What took too long is run once more with nothing of ours beside it.
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!jobs[i].verdict.ending.late) continue;
    jobs[i].verdict = judge(bench, *jobs[i].file, *jobs[i].command, jobs.size() + i);
    tellFault(jobs[i]);
  }
}

int run(Options options) {
  const Corpus corpus = corpusOf(options.bench.seeds);
  std::vector<DamagedFile> files;
  for (const DamagedFile& file : corpus.files()) {
    const std::string name = file.format + "/" + file.name;
    if (name.find(options.only) != std::string::npos) files.push_back(file);
  }
  if (options.sample > 0) files = spread(files, options.sample);
  if (options.list || !options.write.empty()) {
    for (const DamagedFile& file : files) {
      std::printf("%s/%s\n", file.format.c_str(), shown(file.name).c_str());
      if (options.write.empty()) continue;
      fs::create_directories(options.write / file.format);
      file.write(options.write / file.format / file.name);
    }
    std::printf("%zu files\n", files.size());
    return 0;
  }
  const bool display = std::getenv("DISPLAY") != nullptr;
  std::vector<Job> jobs;
  for (const DamagedFile& file : files) {
    std::size_t count = 0;
    for (const Command& command : commands()) {
      const bool reads =
          (" " + file.role + " ").find(" " + command.role + " ") != std::string::npos;
      if (!reads || (command.draws && !display) || count++ >= options.commands) continue;
      jobs.push_back({&file, &command, {}});
    }
  }
  if (options.bench.work.empty()) {
    std::string pattern = (fs::temp_directory_path() / "damaged-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a folder");
    options.bench.work = pattern;
  }
  options.bench.work = fs::absolute(options.bench.work);
  runAll(jobs, options.bench);
  if (!options.bench.keep) fs::remove_all(options.bench.work);
  return report(jobs);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(optionsOf(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "damaged: %s\n", error.what());
    return 2;
  }
}
