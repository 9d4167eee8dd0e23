#pragma once

#include <string>
#include <vector>

#include "app/report/statistics.hpp"
#include "generate/generate.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/mesh/check/solver_statistics.hpp"

namespace quadloop::app {

/// Seconds of one stage over all ranks.
struct StageRow {
  std::string stage;
  double slowest = 0, mean = 0;
};

/// Returns the seconds of each stage, on every rank; a stage that ran twice is listed once, with its sum.
/// Every rank must have the same stages. *Collective.*
std::vector<StageRow> stage_rows(const Communicator& comm, const StageSeconds& seconds);

/// Two columns: the slowest rank and the mean.
std::string stage_table(const std::vector<StageRow>& stages);

/// Final report of `mesh` and `remesh`.
struct MeshSummary {
  Statistics statistics;  ///< counts, quality, memory, imbalance; add further results of the mesh here
  SolverStatistics shape;
  std::vector<StageRow> stages;
  std::vector<std::string> files;
  std::vector<std::string> boundaries_vanished;
};

/// Returns the summary, the same on every rank except for the figures, which only the root rank has. Every
/// rank must have the same stages. *Collective.*
MeshSummary summarise(const Communicator& comm, const GeneratedMesh& generated, const StageSeconds& seconds,
                      const std::vector<std::string>& files);

/// Adds the estimated number of cells, and the memory of one of `ranks` ranks.
void add_estimate(Statistics& statistics, const MeshEstimate& estimate, int ranks);

/// Returns the summary as a short table.
std::string table_of(const MeshSummary& summary);

/// Returns the summary as members of a record, without the files, which are in every command's record.
JsonObject record_of(const MeshSummary& summary);

/// {stage: {"slowest": s, "mean": s}}
JsonObject record_of(const std::vector<StageRow>& stages);

}  // namespace quadloop::app
