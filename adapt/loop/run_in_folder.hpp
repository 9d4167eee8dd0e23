#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapt/loop/case_settings.hpp"
#include "adapt/loop/cycle_files.hpp"
#include "adapt/loop/cycle_folders.hpp"
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
  /// Returns the text of the geometry file that each cycle stores, on the first rank; empty: none.
  std::function<std::string()> outline = {};
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
  std::function<bool()> stop_requested = {};  ///< asked before each cycle; true on any rank ends the run
};

/// The cycles 0 to adapt.cycles of a case in a folder, with the files of CycleFiles. With `resume` they
/// continue after the last complete cycle, and the files at the end are those of an uninterrupted run. If
/// `start` is given, cycle 0 uses its mesh on the case's geometry (continued_mesh). Errors keep complete
/// cycles.
class FolderRun {
 public:
  /// `comm`, `adaptive` and `start` must outlive the object. Throws InputError, OutputError. *Collective.*
  FolderRun(const Communicator& comm, const AdaptiveCase& adaptive, const std::string& folder, bool resume,
            const RunReport& report, const std::optional<DesignStart>& start = {});
  FolderRun(const FolderRun&) = delete;
  FolderRun& operator=(const FolderRun&) = delete;

  AdaptiveLoop& loop() { return *loop_; }
  /// The solver of the case. The object must outlive it.
  flow::FlowSolver solver() const;
  /// Removes the files of a cycle under way. On the root; no error is reported. Not collective.
  void discard_unfinished();

 private:
  LoopStart start_of(bool resume, const RunReport& report, const std::optional<DesignStart>& start);

  const Communicator& comm_;
  const AdaptiveCase& adaptive_;
  AdaptOptions adapt_;
  CycleFolders folders_;
  std::optional<CycleFiles> files_;
  std::optional<AdaptiveLoop> loop_;
};

/// Returns the formats of each cycle's mesh: the default ones, then the others of the case.
std::vector<std::string> cycle_formats(const std::vector<std::string>& of_case);

/// Whether the solver is another program, which reads and writes files.
bool is_external(const ChosenSolver& solver);

/// The start and the solver of a loop without files; `adaptive` must outlive the start. The solver must not
/// be external.
LoopStart start_in_memory(const Communicator& comm, const AdaptiveCase& adaptive);
flow::FlowSolver solver_in_memory(const AdaptiveCase& adaptive);

/// Runs all cycles with the solver of the case. Throws InputError, SolverError, OutputError. *Collective.*
LoopEnd run_in_folder(const Communicator& comm, const AdaptiveCase& adaptive, const std::string& folder,
                      bool resume, const RunReport& report, const std::optional<DesignStart>& start = {});

}  // namespace quadloop::adapt
