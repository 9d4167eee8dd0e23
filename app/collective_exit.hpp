#pragma once

#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

#include "mesher/base/error.hpp"

namespace quadloop::app {

/// Result of one rank's work.
struct Outcome {
  Outcome() = default;
  Outcome(ExitStatus how, std::string why) : status{how}, message{std::move(why)} {}

  ExitStatus status = ExitStatus::done;
  std::string message;                ///< one line, if the status is not `done`
  std::vector<std::string> warnings;  ///< one line each, printed before that message
  /// For stdout: with `done` that of the root rank is printed, else that of the rank that prints the error.
  std::string record;
};

/// Ends the run on all ranks. An error that occurred on every rank is printed once, by the lowest rank, and
/// all return its status. An error of some ranks only, while others wait for them, is also printed once and
/// ends the whole run by MPI_Abort. The record is printed once too; if that fails, the status is
/// `output_failed`. *Collective* as far as the ranks still can; `comm` must not be used for anything else.
ExitStatus close_together(MPI_Comm comm, const Outcome& outcome);

}  // namespace quadloop::app
