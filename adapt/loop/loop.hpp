#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapt/loop/record.hpp"
#include "adapt/loop/settling.hpp"
#include "adapt/remesh/remesh.hpp"
#include "flow/flow_solver.hpp"

namespace quadloop {

/// What a cycle comes to: a mesh with the flow on it, and what the next mesh is to be split at.
struct CycleEnd {
  SolvedMesh solved;
  AdaptationPlan plan;
  CycleValues values = {};
  bool settled = false;  ///< by adapt.until, against the cycle before
};

/// Looks on while the loop runs, and may write files. Every call is entered by all ranks; what it throws ends
/// the loop.
class CycleObserver {
 public:
  CycleObserver() = default;
  CycleObserver(const CycleObserver&) = delete;
  CycleObserver& operator=(const CycleObserver&) = delete;
  virtual ~CycleObserver() = default;

  /// Before a cycle's mesh is made.
  virtual void begin(int /*cycle*/) {}
  /// The mesh is made, and the state that the solver starts from, without variables in the first cycle.
  virtual void meshed(const MeshResult& /*mesh*/, const Field& /*start*/) {}
  /// The solver is done. What is returned joins the cycle's warnings.
  virtual std::vector<std::string> solved(const Mesh& /*mesh*/, const SolvedFlow& /*flow*/) { return {}; }
  /// What the next mesh is to be, beside `end.values` and `end.settled`, is known.
  virtual void planned(const CycleEnd& /*end*/) {}
  /// The cycle is done: its figures, what the solver noted, and what the user is to be told.
  virtual void finished(CycleRecord /*record*/, const std::vector<std::string>& /*notes*/,
                        const std::vector<std::string>& /*warnings*/) {}
  /// The place of a cycle's solution, for messages; empty: none is named.
  virtual std::string place_of_solution(int /*cycle*/) const { return {}; }
};

/// Makes the mesh of cycle 0 and the state to start from. *Collective.*
using FirstMesh = std::function<CarriedMesh()>;

/// Which cycles were made, and what the last one came to.
struct LoopEnd {
  int first = 0, last = 0;         ///< first > last: none
  bool nothing_to_change = false;  ///< the last one marks no leaf, and so came before adapt.cycles
  bool settled = false;            ///< it has settled by adapt.until, before adapt.cycles
  std::optional<CycleEnd> left;    ///< always after a cycle was made
};

/// Meshes, solves and adapts in turn, in memory: the cycles from `first` to adapt.cycles, each on the mesh
/// that the one before asks for and with its flow carried over. `before` is what the cycle first - 1 came to;
/// without it the first mesh is that of the case alone. The loop ends with a cycle that marks no leaf: the
/// next one would solve on the same mesh again, or one whose forces and estimate have settled. Meshes and
/// flows have the same bits on any number of ranks, and whether `before` comes from memory or from files of
/// ours. `start` takes the place of the case's own first mesh: one that another run left, with its flow.
/// Throws what meshing, solver and observer throw. *Collective.*
LoopEnd run_loop(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
                 const FlowSolver& solver, CycleObserver& observer, int first = 0,
                 std::optional<CycleEnd> before = {}, const FirstMesh& start = {});

}  // namespace quadloop
