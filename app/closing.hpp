#pragma once

#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

#include "mesher/base/error.hpp"

namespace quadloop {

/// How one rank's work ended.
struct Outcome {
  Outcome() = default;
  Outcome(ExitStatus how, std::string why) : status{how}, message{std::move(why)} {}

  ExitStatus status = ExitStatus::done;
  std::string message;                ///< one line, where the status is not `done`
  std::vector<std::string> warnings;  ///< one line each, printed before that message
  /// For stdout: with `done` the root rank's is printed, else that of the rank that speaks.
  std::string record;
};

/// Ends the run on all ranks together. An error that every rank met is said once, by the lowest rank, and all
/// return its status. An error of some ranks alone, while others wait for them in vain, is said once too and
/// ends the whole run by MPI_Abort. Records are printed once too; where the last one cannot be, that is an
/// `output_failed`. *Collective* as far as ranks still can; `comm` is used for nothing else.
ExitStatus close_together(MPI_Comm comm, const Outcome& outcome);

}  // namespace quadloop
