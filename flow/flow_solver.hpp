#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flow/postprocess/flow_statistics.hpp"
#include "flow/postprocess/free_stream.hpp"
#include "flow/postprocess/history.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::flow {

/// The solution of a flow solver, with its report.
struct SolvedFlow : FlowStatistics {
  Field solution;                            ///< nodal values at owned nodes, or cell values, or both
  std::vector<std::string> notes, warnings;  ///< for the cycle's log; for the user too
  std::optional<FreeStream> stream;          ///< if the solver provides it
  Field at_walls = {};                       ///< nodal rows as of wall_flow(); empty: those of the solution
  std::vector<HistoryRow> history;
};

/// Any flow solver: `start` is the initial state, with values at the owned nodes or in the cells, or without
/// variables if there is none; `cycle` counts the solver's meshes from 0. Throws InputError, SolverError, the
/// same on all ranks: code that may fail on a single rank must run inside comm.together(), which throws the
/// error of the lowest such rank on all; otherwise the other ranks would wait forever. *Collective.*
using FlowSolver =
    std::function<SolvedFlow(const Communicator& comm, const Mesh& mesh, const Field& start, int cycle)>;

}  // namespace quadloop::flow
