#include <algorithm>
#include <filesystem>
#include <iostream>
#include <new>

#include "cli/command_line.h"
#include "cli/interrupt.h"
#include "cli/limits.h"

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

pneuma::ExitCode run(int argc, char** argv) {
  const pneuma::ExitCode code = pneuma::cli::runCommandLine({argv + 1, argv + argc});
  if (!std::cout.flush()) {
    throw pneuma::OutputFailed("standard output cannot be written; is the disk full?");
  }
  return code;
}

}  // namespace

/// The one place where the command line catches anything.
int main(int argc, char** argv) {
  pneuma::cli::rememberSignals();
  try {
    return static_cast<int>(run(argc, argv));
  } catch (const pneuma::Cancelled&) {
    if (pneuma::cli::timeIsOver()) {
      complain("the time of --timeout is over; nothing was written");
      return static_cast<int>(pneuma::ExitCode::TimeOver);
    }
    complain("stopped on request; nothing was written");
    return SignalBase + pneuma::cli::receivedSignal();
  } catch (const pneuma::Error& error) {
    complain(error.what());
    return static_cast<int>(error.code());
  } catch (const std::filesystem::filesystem_error& error) {
    const pneuma::ExitCode code = codeOf(error);
    complain((code == pneuma::ExitCode::OutputFailed ? "cannot write '" : "cannot read '") +
             error.path1().string() + "': " + error.code().message() +
             "; check its name and folder");
    return static_cast<int>(code);
  } catch (const std::bad_alloc&) {
    complain("there is not enough memory; use a smaller input or a machine with more");
    return static_cast<int>(pneuma::ExitCode::OutOfMemory);
  } catch (const std::exception& error) {
    complain(std::string("internal error: ") + error.what() +
             "; this is a bug, please report it with the command you used");
    return static_cast<int>(pneuma::ExitCode::Internal);
  }
}
