#pragma once

#include <functional>
#include <string>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/progress.hpp"

/// Stages in which all ranks work: shown like any other on a terminal, and reported to an observer of the
/// caller, who may cancel the work. No influence on results.
namespace quadloop::progress {

/// The work was cancelled by an observer; the same on all ranks.
class Cancelled : public Error {
 public:
  explicit Cancelled(const std::string& message) : Error(ExitStatus::bad_input, message) {}
};

/// Called on all ranks as a stage begins, with share 0, and as it advances, with the share done. To cancel,
/// it throws on at least one rank.
using Observer = std::function<void(const std::string& stage, double share)>;

/// While it exists, the calling thread reports the stages of a communicator to an observer. Objects may be
/// nested: the inner one counts.
class Observed {
 public:
  /// All ranks observe if one of them has an observer. `comm` must outlive the object. *Collective.*
  Observed(const Communicator& comm, Observer observer);
  ~Observed();
  Observed(const Observed&) = delete;
  Observed& operator=(const Observed&) = delete;

  /// Calls the observer if it observes `comm`. Throws Cancelled on all ranks if it throws on one.
  /// *Collective.*
  void report(const Communicator& comm, const char* stage, double share) const;

 private:
  const Communicator& comm_;
  Observer observer_;
  bool active_;
  const Observed* outer_;
};

/// A running stage of all ranks, until it goes out of scope.
class SharedStage {
 public:
  /// `total` as for Stage. Throws Cancelled. *Collective.*
  SharedStage(const Communicator& comm, const char* name, double total = 0, const char* unit = "");
  ~SharedStage();
  SharedStage(const SharedStage&) = delete;
  SharedStage& operator=(const SharedStage&) = delete;

  /// On this rank alone: for the terminal.
  void advance(double done) { stage_.advance(done); }
  /// On all ranks, which have done as much: for the observer too. Throws Cancelled. *Collective.*
  void advance_together(double done);
  void say(const std::string& text) { stage_.say(text); }
  void say_then(const std::string& text) { stage_.say_then(text); }

  /// The innermost stage of the calling thread, or null: for functions called within a stage.
  static SharedStage* current();

 private:
  void report(double share) const;

  const Communicator& comm_;
  const char* name_;
  double total_;
  Stage stage_;
  SharedStage* outer_;
};

}  // namespace quadloop::progress
