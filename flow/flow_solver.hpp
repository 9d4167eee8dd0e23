#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flow/quantities/flow_figures.hpp"
#include "flow/quantities/free_stream.hpp"
#include "flow/quantities/history.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A flow on a mesh, and what the solver says of it.
struct SolvedFlow : FlowFigures {
  Field solution;                            ///< a row for each owned node, or for each cell, or both
  std::vector<std::string> notes, warnings;  ///< for the cycle's log; for the user too
  std::optional<FreeStream> stream;          ///< where the solver knows it
  Field at_walls = {};                       ///< rows of nodes, as wall_flow(); empty: those of the solution
  std::vector<HistoryRow> history;
};

/// Any flow solver: `start` is the state to begin with, a row for each of the mesh's owned nodes, or cells,
/// or without variables where there is none yet; `cycle` counts the solver's meshes from 0. Throws
/// InputError, SolverError, the same on all ranks: what may fail on one of them alone runs inside
/// comm.together(), which throws the error of the lowest such rank on all; else the others wait for ever.
/// *Collective.*
using FlowSolver =
    std::function<SolvedFlow(const Communicator& comm, const Mesh& mesh, const Field& start, int cycle)>;

}  // namespace quadloop
