#pragma once

#include <string>
#include <vector>

#include "app/report/figures.hpp"
#include "generate/generate.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/mesh/check/shape_figures.hpp"

namespace quadloop {

/// Seconds of one stage over all ranks.
struct StageRow {
  std::string stage;
  double slowest = 0, mean = 0;
};

/// Seconds of each stage, on every rank; a stage that ran twice stands once, with its sum. *Collective*;
/// every rank names the same stages.
std::vector<StageRow> stage_rows(const Communicator& comm, const StageSeconds& seconds);

/// Two columns: the slowest rank and the mean.
std::string stage_table(const std::vector<StageRow>& stages);

/// What `mesh` and `remesh` say at their end.
struct MeshSummary {
  Figures figures;  ///< counts, quality, memory, imbalance; a further figure of the mesh is one more `add`
  ShapeFigures shape;
  std::vector<StageRow> stages;
  std::vector<std::string> files;
  std::vector<std::string> boundaries_vanished;
};

/// The same on every rank but for the figures, which the root rank alone has. *Collective*; every rank names
/// the same stages.
MeshSummary summarise(const Communicator& comm, const GeneratedMesh& generated, const StageSeconds& seconds,
                      const std::vector<std::string>& files);

/// The summary as the short table for people.
std::string table_of(const MeshSummary& summary);

/// The summary as members of a record, the files not: those stand in every command's record.
JsonObject record_of(const MeshSummary& summary);

/// {stage: {"slowest": s, "mean": s}}
JsonObject record_of(const std::vector<StageRow>& stages);

}  // namespace quadloop
