#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "adapt/loop/convergence.hpp"
#include "adapt/loop/record.hpp"
#include "adapt/remesh/remesh.hpp"
#include "flow/flow_solver.hpp"
#include "mesher/base/timer.hpp"

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
  bool stopped = false;            ///< on request (stop_when()), with cycles left to run
  std::shared_ptr<CycleEnd> left;  ///< result of the last cycle, if one was run
};

/// The start of a loop that does not begin with the case's own initial mesh.
struct LoopStart {
  int first = 0;                          ///< the first cycle
  std::shared_ptr<CycleEnd> before = {};  ///< result of the cycle before it; null in cycle 0
  FirstMesh mesh = {};                    ///< of cycle 0, with the initial state; empty: the case's own
};

/// Meshes and adapts in memory, cycle by cycle: cycles `first` to adapt.cycles, each on the mesh that the
/// previous one planned, starting from its transferred solution. The caller solves between begin_cycle() and
/// finish_cycle(). The loop ends early if no cell is flagged, as the next cycle would solve on the same mesh,
/// if forces and error estimate have settled, or on request between two cycles. Meshes and solutions are
/// bitwise independent of the number of ranks, and of whether the cycle before comes from memory or from
/// native files.
class AdaptiveLoop {
 public:
  /// All arguments but the last must outlive the object.
  AdaptiveLoop(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
               CycleObserver& observer, LoopStart start = {});

  /// From now on a function transfers the solutions, instead of the transfer of the options; none: the
  /// latter.
  void transfer_by(TransferFunction function) { transfer_by_ = std::move(function); }

  /// From now on the loop ends before the next cycle if the function returns true on any rank.
  void stop_when(std::function<bool()> is_requested) { stop_requested_ = std::move(is_requested); }

  /// Generates the mesh and the initial state of the next cycle; returns false if the loop has ended. Throws
  /// what meshing and observer throw. *Collective.*
  bool begin_cycle();

  int cycle() const { return cycle_; }  ///< the cycle under way, or the last one
  /// The mesh of this cycle. Its solution is set by finish_cycle(). The object lives as long as a caller
  /// holds it; the mesh does not change any more.
  std::shared_ptr<const CycleEnd> under_way() const { return under_way_; }
  const Field& initial_state() const { return remeshed_.start; }  ///< no variables in cycle 0
  const RemeshedSolution& remeshed() const { return remeshed_; }  ///< without mesh and tree

  /// Takes the solution on this mesh and plans the next one. Throws what planning and observer throw.
  /// *Collective.*
  void finish_cycle(flow::SolvedFlow flow);

  const LoopEnd& end() const { return end_; }

 private:
  RemeshedSolution next_mesh() const;
  void settle(CycleRecord& record, CycleEnd& end) const;
  CycleRecord record_of(const flow::SolvedFlow& flow, const CycleEnd& end) const;

  const Communicator& comm_;
  const MeshInput& mesh_;
  const AdaptOptions& adapt_;
  CycleObserver& observer_;
  FirstMesh first_mesh_;
  TransferFunction transfer_by_;
  std::function<bool()> stop_requested_;
  LoopEnd end_;
  int cycle_;
  StageTimes times_;
  RemeshedSolution remeshed_;
  std::shared_ptr<CycleEnd> under_way_;
};

/// Runs the rest of a loop with a solver. Throws what meshing, solver and observer throw. *Collective.*
LoopEnd run_to_end(const Communicator& comm, AdaptiveLoop& loop, const flow::FlowSolver& solver);

/// Runs a whole loop with a solver. Throws what meshing, solver and observer throw. *Collective.*
LoopEnd run_loop(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
                 const flow::FlowSolver& solver, CycleObserver& observer, LoopStart start = {});

}  // namespace quadloop::adapt
