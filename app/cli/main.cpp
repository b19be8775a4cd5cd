#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "cli/command_line.h"
#include "cli/interrupt.h"
#include "cli/last_resort.h"
#include "cli/limits.h"
#include "core/error.h"
#include "core/memory_watch.h"
#include "io/unfinished_files.h"

namespace {

constexpr std::size_t LongestMessage = 1500;
constexpr int SignalBase = 128;  // shells' convention: 128 + number of the signal

/// One line, however the message was made: scripts read standard error line by line. What a file
/// says of itself, which messages repeat, may have any length.
void complain(std::string message) {
  if (message.size() > LongestMessage) {
    const std::size_t half = LongestMessage / 2;
    message.replace(half, message.size() - 2 * half, " ... ");
  }
  while (!message.empty() && message.back() == '\n') message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::cerr << "pneuma: " << message << std::endl;
}

/// Of what no command has put in a sentence: an input cannot be read, unless only writing fails so.
pneuma::ExitCode codeOf(const std::filesystem::filesystem_error& error) {
  const std::error_code code = error.code();
  const bool writing = code == std::errc::no_space_on_device ||
                       code == std::errc::read_only_file_system || code == std::errc::file_exists;
  return writing ? pneuma::ExitCode::OutputFailed : pneuma::ExitCode::InputMissing;
}

/// "'FILE': " of the one file or folder that a command is given, for a message that does not say
/// where it is wrong; else nothing.
std::string placeOf(const std::vector<std::string>& arguments, const std::string& message) {
  std::filesystem::path only;
  for (std::size_t i = 1; i < arguments.size(); ++i) {  // behind the command
    const std::string& argument = arguments[i];
    std::error_code error;
    if (argument.starts_with('-') || !std::filesystem::exists(argument, error)) continue;
    if (!only.empty()) return {};
    only = argument;
  }
  if (!only.has_filename()) only = only.parent_path();
  const std::string name = only.filename().string();
  if (name.empty() || message.find(name) != std::string::npos) return {};
  return "'" + only.string() + "': ";
}

pneuma::ExitCode ended(const std::vector<std::string>& arguments) {
  try {
    return pneuma::cli::runCommandLine(arguments);
  } catch (const pneuma::InvalidInput& error) {
    throw pneuma::InvalidInput(placeOf(arguments, error.what()) + error.what());
  } catch (const pneuma::Unsupported& error) {
    throw pneuma::Unsupported(placeOf(arguments, error.what()) + error.what());
  }
}

pneuma::ExitCode run(int argc, char** argv) {
  const pneuma::ExitCode code = ended({argv + 1, argv + argc});
  if (pneuma::memoryRanOut()) throw std::bad_alloc();
  if (!std::cout.flush() && !pneuma::cli::nobodyReads()) {
    throw pneuma::OutputFailed(
        "standard output cannot be written; is the disk full, or does nobody read it?");
  }
  return code;
}

pneuma::ExitCode outOfMemory() {
  complain("there is not enough memory; use a smaller input or a machine with more");
  return pneuma::ExitCode::OutOfMemory;
}

/// Says what was thrown. @returns what to end with
pneuma::ExitCode told(const std::exception& thrown) {
  // A library may have made something else of it.
  if (pneuma::memoryRanOut() || dynamic_cast<const std::bad_alloc*>(&thrown) != nullptr) {
    return outOfMemory();
  }
  if (const auto* error = dynamic_cast<const pneuma::Error*>(&thrown)) {
    complain(error->what());
    return error->code();
  }
  if (const auto* error = dynamic_cast<const std::filesystem::filesystem_error*>(&thrown)) {
    const pneuma::ExitCode code = codeOf(*error);
    complain((code == pneuma::ExitCode::OutputFailed ? "cannot write '" : "cannot read '") +
             error->path1().string() + "': " + error->code().message() +
             "; check its name and folder");
    return code;
  }
  const auto* error = dynamic_cast<const std::system_error*>(&thrown);
  if (error != nullptr && error->code() == std::errc::resource_unavailable_try_again) {
    complain("the system starts no further thread; end other programs or add --threads 1");
    return pneuma::ExitCode::OutOfMemory;
  }
  complain(std::string("internal error: ") + thrown.what() +
           "; this is a bug, please report it with the command you used");
  return pneuma::ExitCode::Internal;
}

}  // namespace

/// The one place where the command line catches anything.
int main(int argc, char** argv) {
  pneuma::leaveNoCoreDumps();
  pneuma::cli::openStandardFiles();
  pneuma::cli::handleLastResort();
  pneuma::cli::rememberSignals();
  try {
    pneuma::cli::requireStack();
    const auto code = static_cast<int>(run(argc, argv));
    return pneuma::cli::nobodyReads() ? SignalBase + SIGPIPE : code;
  } catch (const pneuma::Cancelled&) {
    if (pneuma::cli::timeIsOver()) {
      complain("the time of --timeout is over; nothing was written");
      return static_cast<int>(pneuma::ExitCode::TimeOver);
    }
    const int signal = pneuma::cli::receivedSignal();
    complain("stopped on request; nothing was written");
    return SignalBase + signal;
  } catch (const std::exception& thrown) {
    return static_cast<int>(told(thrown));
  }
}
