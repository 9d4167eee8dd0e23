#pragma once

#include <functional>
#include <string>

#include "adapt/loop/flow_solver.hpp"
#include "adapt/loop/record.hpp"
#include "adapt/remesh/remesh.hpp"

namespace quadloop {

/// A case that is meshed, solved and adapted in turn.
struct AdaptiveCase {
  MeshInput mesh;
  AdaptOptions adapt;
  FlowSolver solver;
  std::vector<std::string>
      formats;            ///< suffixes of mesh files that each cycle is to have too, beside .mesh and .cgns
  CaseSettings settings;  ///< all that the run's files depend on, beside the outline
};

/// What a run tells its caller, on every rank.
struct RunReport {
  std::function<void(const CycleRecord&, const std::vector<std::string>& warnings)>
      cycle;                                        ///< after each: what was dropped or not reached
  std::function<void(const std::string&)> warning;  ///< before the first
};

/// Which cycles a run made, and whether it came to its end before adapt.cycles because the last one marks no
/// leaf.
struct RunEnd {
  int first = 0, last = 0;  ///< first > last: all were there already
  bool nothing_to_change = false;
};

/// Runs the cycles 0 to adapt.cycles in `folder`: mesh, transfer of the last solution, solve, marks. It ends
/// before with a cycle that marks no leaf: the next one would solve on the same mesh again. Each cycle begins
/// with what the last one left in its files, so that a run which was broken off and resumed ends with the
/// same files as one that was not. Throws InputError, SolverError, OutputError; whole cycles then stay as
/// they are. *Collective.*
RunEnd run_adaptation(const Communicator& comm, const AdaptiveCase& adaptive, const std::string& folder,
                      bool resume, const RunReport& report);

}  // namespace quadloop
