#pragma once

#include <stdexcept>
#include <string>

namespace pneuma {

/// What a process of Pneuma ends with (README, "Exit codes").
enum class ExitCode {
  Done = 0,
  Internal = 1,
  Usage = 2,
  InputMissing = 3,
  InputInvalid = 4,
  Unsupported = 5,
  OutputFailed = 6,
  CheckFailed = 7,
  ComparisonOverLimit = 8,
  OutOfMemory = 9,
  NoRendering = 10,
  TimeOver = 11,
  Interrupted = 130,
};

/// Something a person can act on. The message says what is wrong, where, and what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// A command or an option that cannot be: unknown, out of range, missing.
class InvalidOption : public Error {
 public:
  explicit InvalidOption(const std::string& message) : Error(ExitCode::Usage, message) {}
};

/// A file or folder that is missing or cannot be read.
class InputMissing : public Error {
 public:
  explicit InputMissing(const std::string& message) : Error(ExitCode::InputMissing, message) {}
};

/// Input that is damaged, or breaks a documented precondition.
class InvalidInput : public Error {
 public:
  explicit InvalidInput(const std::string& message) : Error(ExitCode::InputInvalid, message) {}
};

/// Valid input of a kind that is not supported, or for which a method has no acceptable result.
class Unsupported : public Error {
 public:
  explicit Unsupported(const std::string& message) : Error(ExitCode::Unsupported, message) {}
};

/// An output that cannot be written: exists already, no permission, no space, no such folder.
class OutputFailed : public Error {
 public:
  explicit OutputFailed(const std::string& message) : Error(ExitCode::OutputFailed, message) {}
};

/// No picture can be made: there is no display, or it has no OpenGL.
class NoRendering : public Error {
 public:
  explicit NoRendering(const std::string& message) : Error(ExitCode::NoRendering, message) {}
};

/// The user asked to stop. Not an Error, so that nothing that handles errors swallows it.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "stopped on request"; }
};

}  // namespace pneuma
