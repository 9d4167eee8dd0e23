#pragma once

#include <functional>
#include <string>

#include "adapt/flow_solver.hpp"
#include "adapt/record.hpp"
#include "adapt/remesh.hpp"

namespace quadloop {

/// A case that is meshed, solved and adapted in turn.
struct AdaptiveCase {
  MeshInput mesh;
  AdaptOptions adapt;
  FlowSolver solver;
  std::uint64_t digest = 0;  ///< of all that the run depends on but the number of cycles
};

/// What a run tells its caller after each cycle: its record, and what was dropped or not reached.
using CycleReport = std::function<void(const CycleRecord&, const std::vector<std::string>& warnings)>;

/// Runs the cycles 0 to adapt.cycles in `folder`: mesh, transfer of the last solution, solve, marks. Each cycle begins with what the last one left in
/// its files, so that a run which was broken off and resumed ends with the same files as one that was not. `report` is called on every rank. Throws
/// InputError, SolverError, OutputError; whole cycles then stay as they are. *Collective.*
void run_adaptation(const Communicator& comm, const AdaptiveCase& adaptive, const std::string& folder, bool resume, const CycleReport& report);

}  // namespace quadloop
