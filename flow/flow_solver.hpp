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
  std::vector<std::string> notes, warnings;  ///< notes go to the log only, warnings also to the user
  std::optional<FreeStream> stream;          ///< if the solver provides it
  Field at_walls = {};  ///< values at the boundary nodes, as of wall_flow(); empty: taken from `solution`
  std::vector<HistoryRow> history;
  std::optional<int> steps;  ///< number of steps, if the solver provides it
};

/// A flow solver. `start` is the initial state: values at the owned nodes or in the cells, or no variables if
/// there is no initial state. `cycle` is the number of the adaptation cycle, from 0; below 0 outside a loop.
/// The solver throws InputError or SolverError on all ranks: code that may fail on a single rank must run
/// inside comm.together(), which throws the error of the lowest failed rank on all ranks; otherwise the other
/// ranks would wait forever. *Collective.*
using FlowSolver =
    std::function<SolvedFlow(const Communicator& comm, const Mesh& mesh, const Field& start, int cycle)>;

}  // namespace quadloop::flow
