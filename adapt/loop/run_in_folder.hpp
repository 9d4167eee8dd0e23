#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapt/loop/case_settings.hpp"
#include "adapt/loop/loop.hpp"
#include "adapt/remesh/morphed_mesh.hpp"
#include "adapt/solvers/chosen_solver.hpp"

namespace quadloop::adapt {

/// A case for the adaptive loop.
struct AdaptiveCase {
  MeshInput mesh;
  AdaptOptions adapt;
  ChosenSolver solver;
  std::vector<std::string> formats;  ///< of each cycle's mesh, in addition to the default ones
  CaseSettings settings;             ///< all that the run's files depend on, except the geometry
  /// Names of quantity_names() written to the mesh files of the cycles, but not to the restart file.
  std::vector<std::string> fields = {};
  /// Reference state for the forces of an external solver; empty: forces are not computed.
  std::optional<flow::FreeStream> stream = {};
  std::int32_t partitions = 0;  ///< partitions of each cycle's mesh for a solver's ranks; 0: none
  std::string outline = {};     ///< text of the geometry file that each cycle stores; empty: none
};

/// Start from the mesh, tree and solution of another run, possibly on a changed geometry.
struct DesignStart {
  SolvedMesh solved;
  std::optional<MorphWish> wish;  ///< if set, the cells are to be kept
};

/// Callbacks that report the progress of a run, on every rank.
struct RunReport {
  /// After each cycle: its results, with warnings of what was dropped or not reached.
  std::function<void(const CycleRecord&, const std::vector<std::string>& warnings)> cycle;
  std::function<void(const std::string&)> warning;  ///< before the first cycle
};

/// Runs cycles 0 to adapt.cycles in `folder`, writing the files of CycleFiles. With `resume` it continues
/// after the last complete cycle and ends with the same files as an uninterrupted run. If `start` is given,
/// cycle 0 uses its mesh on the case's geometry (continued_mesh). Throws InputError, SolverError,
/// OutputError; complete cycles are kept. *Collective.*
LoopEnd run_in_folder(const Communicator& comm, const AdaptiveCase& adaptive, const std::string& folder,
                      bool resume, const RunReport& report, const std::optional<DesignStart>& start = {});

}  // namespace quadloop::adapt
