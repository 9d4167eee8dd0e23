#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapt/loop/convergence.hpp"
#include "adapt/loop/record.hpp"
#include "adapt/remesh/remesh.hpp"
#include "flow/flow_solver.hpp"

namespace quadloop::adapt {

/// Result of a cycle: a mesh with its solution, and the splits of the next mesh.
struct CycleEnd {
  SolvedMesh solved;
  AdaptationPlan plan;
  CycleValues values = {};
  bool settled = false;  ///< by adapt.until, compared with the cycle before
};

/// Observer interface. All callbacks are collective; an exception terminates the loop.
class CycleObserver {
 public:
  CycleObserver() = default;
  CycleObserver(const CycleObserver&) = delete;
  CycleObserver& operator=(const CycleObserver&) = delete;
  virtual ~CycleObserver() = default;

  /// Called before a cycle's mesh is generated.
  virtual void begin(int /*cycle*/) {}
  /// Called with the mesh and the initial state, which has no variables in the first cycle.
  virtual void meshed(const MeshResult& /*mesh*/, const Field& /*start*/) {}
  /// Called with the solution. The result is added to the cycle's warnings.
  virtual std::vector<std::string> solved(const Mesh& /*mesh*/, const flow::SolvedFlow& /*flow*/) {
    return {};
  }
  /// Called with the plan of the next mesh, `end.values` and `end.settled`.
  virtual void planned(const CycleEnd& /*end*/) {}
  /// Called at the end of a cycle with its data, notes of the solver, and warnings.
  virtual void finished(CycleRecord /*record*/, const std::vector<std::string>& /*notes*/,
                        const std::vector<std::string>& /*warnings*/) {}
  /// Returns the path of a cycle's solution, for messages; empty: none is named.
  virtual std::string place_of_solution(int /*cycle*/) const { return {}; }
};

/// Generates the mesh and the initial state of cycle 0. *Collective.*
using FirstMesh = std::function<RemeshedSolution()>;

/// Cycles that were run, and the result of the last one.
struct LoopEnd {
  int first = 0, last = 0;         ///< first > last: none
  bool nothing_to_change = false;  ///< no cell is flagged in the last one, before adapt.cycles
  bool settled = false;            ///< converged by adapt.until, before adapt.cycles
  std::optional<CycleEnd> left;    ///< result of the last cycle, if one was run
};

/// Meshes, solves and adapts in memory: cycles `first` to adapt.cycles, each on the mesh that the previous
/// one planned, starting from its transferred solution. `before` is the result of cycle first - 1; without it
/// the initial mesh follows from the case alone. The loop ends early if no cell is flagged, as the next cycle
/// would solve on the same mesh, or if forces and error estimate have settled. Meshes and solutions are
/// bitwise independent of the number of ranks, and of whether `before` comes from memory or from native
/// files. `start` replaces the case's own initial mesh by that of another run, with its solution. Throws what
/// meshing, solver and observer throw. *Collective.*
LoopEnd run_loop(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
                 const flow::FlowSolver& solver, CycleObserver& observer, int first = 0,
                 std::optional<CycleEnd> before = {}, const FirstMesh& start = {});

}  // namespace quadloop::adapt
