#include "run_program.h"

#include <chrono>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bytes.h"

extern char** environ;

namespace pneuma::damaged {
namespace {

using Clock = std::chrono::steady_clock;

/// The part of a child after fork(): nothing but system calls.
[[noreturn]] void become(char* const* words, char* const* surroundings, const char* folder,
                         const char* out, const char* err) {
  setpgid(0, 0);
  const rlimit noCore{0, 0};
  setrlimit(RLIMIT_CORE, &noCore);
  const rlimit oneGigabyte{1 << 30, 1 << 30};
  setrlimit(RLIMIT_FSIZE, &oneGigabyte);
  const int input = open("/dev/null", O_RDONLY);
  const int output = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int error = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (input < 0 || output < 0 || error < 0 || chdir(folder) != 0) _exit(125);
  dup2(input, 0);
  dup2(output, 1);
  dup2(error, 2);
  execve(words[0], words, surroundings);
  _exit(126);
}

}  // namespace

Ending runProgram(const std::vector<std::string>& words, const std::filesystem::path& folder,
                  const std::filesystem::path& temporary, double seconds) {
  const std::string out = temporary.string() + ".out";
  const std::string err = temporary.string() + ".err";
  std::vector<std::string> settings = {"TMPDIR=" + temporary.string(), "LC_ALL=C"};
  for (char** one = environ; *one != nullptr; ++one) {
    const std::string text = *one;
    if (text.rfind("TMPDIR=", 0) != 0 && text.rfind("LC_ALL=", 0) != 0) settings.push_back(text);
  }
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::vector<char*> surroundings;
  for (const std::string& one : settings) surroundings.push_back(const_cast<char*>(one.c_str()));
  surroundings.push_back(nullptr);

  Ending ending;
  const auto begin = Clock::now();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0)
    become(arguments.data(), surroundings.data(), folder.c_str(), out.c_str(), err.c_str());
  int state = 0;
  rusage usage{};
  while (wait4(child, &state, WNOHANG, &usage) == 0) {
    ending.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (ending.seconds > seconds) {
      ending.late = true;
      kill(-child, SIGKILL);
      wait4(child, &state, 0, &usage);
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  kill(-child, SIGKILL);  // what it left running
  ending.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  ending.megabytes = usage.ru_maxrss / 1024;
  if (WIFSIGNALED(state) && !ending.late) ending.signal = WTERMSIG(state);
  if (WIFEXITED(state)) ending.code = WEXITSTATUS(state);
  ending.out = contentOf(out);
  ending.err = contentOf(err);
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return ending;
}

}  // namespace pneuma::damaged
