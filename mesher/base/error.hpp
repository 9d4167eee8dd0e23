#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace quadloop {

/// Exit statuses of the program; the numbers are part of its public interface.
enum class ExitStatus : int {
  done = 0,
  bad_input = 1,
  wrong_usage = 2,
  solver_failed = 3,
  output_failed = 4,
  fault = 70,
  stopped = 75
};

/// An error reported to the user as one line: location, what is wrong, what to do. Throw one of the derived
/// types.
class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& message) : std::runtime_error(message), status_{status} {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

/// The user's case, geometry or mesh is wrong or cannot be meshed (exit status 1).
class InputError : public Error {
 public:
  explicit InputError(const std::string& message) : Error(ExitStatus::bad_input, message) {}
};

/// The command line is wrong (exit status 2).
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& message) : Error(ExitStatus::wrong_usage, message) {}
};

/// The flow solver failed (exit status 3).
class SolverError : public Error {
 public:
  explicit SolverError(const std::string& message) : Error(ExitStatus::solver_failed, message) {}
};

/// An output could not be written (exit status 4).
class OutputError : public Error {
 public:
  explicit OutputError(const std::string& message) : Error(ExitStatus::output_failed, message) {}
};

/// The run ended early, as requested by a signal; it can be continued (exit status 75).
class Stopped : public Error {
 public:
  explicit Stopped(const std::string& message) : Error(ExitStatus::stopped, message) {}
};

/// Internal error (exit status 70).
class Fault : public Error {
 public:
  explicit Fault(const std::string& message) : Error(ExitStatus::fault, message) {}
};

/// A value in the message of a Fault.
struct FaultValue {
  template <class Number>
  requires std::is_arithmetic_v<Number> FaultValue(Number number) : text(std::to_string(number)) {}
  FaultValue(const std::string& value) : text(value) {}
  FaultValue(const char* value) : text(value) {}
  std::string text;
};

/// Throws a Fault. Its message contains the source location, the rank, and the values with their names.
/// `names` are the expressions in the source, separated by commas.
[[noreturn]] void fail(const char* file, int line, const char* message, const char* names,
                       std::initializer_list<FaultValue> values);

/// QUADLOOP_REQUIRE(condition, message, values...) throws a Fault if the condition is false, in every build.
/// For internal consistency only. The values are evaluated only on failure.
#define QUADLOOP_REQUIRE(condition, message, ...) \
  ((condition) ? void() : ::quadloop::fail(__FILE__, __LINE__, (message), #__VA_ARGS__, {__VA_ARGS__}))

}  // namespace quadloop
