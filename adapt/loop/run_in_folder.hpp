#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapt/loop/case_settings.hpp"
#include "adapt/loop/loop.hpp"
#include "adapt/remesh/morphed_mesh.hpp"
#include "adapt/solvers/chosen_solver.hpp"

namespace quadloop {

/// A case that is meshed, solved and adapted in turn.
struct AdaptiveCase {
  MeshInput mesh;
  AdaptOptions adapt;
  ChosenSolver solver;
  std::vector<std::string> formats;  ///< of each cycle's mesh, beside those written by default
  CaseSettings settings;             ///< all that the run's files depend on, beside the outline
  /// Of quantity_names(): stand in the files of the cycles' meshes, but not in the one that is gone on from.
  std::vector<std::string> fields = {};
  /// Of a solver that is not the built-in one: what its forces are relative to; none: they are not known.
  std::optional<FreeStream> stream = {};
  std::int32_t partitions = 0;  ///< parts of each cycle's mesh for a solver's ranks; 0: none
  std::string outline = {};     ///< text of the file with it that each cycle keeps; empty: none does
};

/// A run that goes on from what another one left, perhaps on a changed outline: its mesh, tree and flow.
struct DesignStart {
  SolvedMesh solved;
  std::optional<MorphWish> wish;  ///< to keep its cells
};

/// What a run tells its caller, on every rank.
struct RunReport {
  /// After each cycle: what it came to, and what was dropped or not reached.
  std::function<void(const CycleRecord&, const std::vector<std::string>& warnings)> cycle;
  std::function<void(const std::string&)> warning;  ///< before the first
};

/// Runs the cycles 0 to adapt.cycles in `folder`, with the files that CycleFiles writes. With `resume` it
/// goes on after the last whole cycle there and ends with the same files as a run that was not broken off.
/// Cycle 0 begins with the mesh of `start`, if that is given, on the case's outline (continued_mesh). Throws
/// InputError, SolverError, OutputError; whole cycles then stay as they are. *Collective.*
LoopEnd run_in_folder(const Communicator& comm, const AdaptiveCase& adaptive, const std::string& folder,
                      bool resume, const RunReport& report, const std::optional<DesignStart>& start = {});

}  // namespace quadloop
