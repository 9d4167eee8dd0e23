#include "adapt/loop/loop.hpp"

#include <fmt/format.h>

#include <utility>

#include "generate/digests.hpp"
#include "mesher/base/progress.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/mesh/check/face_statistics.hpp"
#include "mesher/mesh/check/layer_statistics.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop::adapt {

namespace {

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

/// Returns the seconds of each stage on the slowest rank. *Collective.*
StageSeconds seconds_of(const Communicator& comm, const StageTimes& times) {
  StageSeconds seconds = added_up(times.stages());
  for (auto& [stage, own] : seconds) own = comm.maximum(own);
  return seconds;
}

class Loop {
 public:
  Loop(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
       const flow::FlowSolver& solver, CycleObserver& observer, const FirstMesh& start)
      : comm_{comm}, mesh_{mesh}, adapt_{adapt}, solver_{solver}, observer_{observer}, start_{start} {}

  CycleEnd run_cycle(int cycle, const CycleEnd* before) const {
    StageTimes times;
    observer_.begin(cycle);
    progress::set_prefix(fmt::format("cycle {} of {}", cycle, adapt_.cycles));
    times.begin(before == nullptr && adapt_.passes > 0 ? "passes" : "mesh");
    RemeshedSolution remeshed = next_mesh(before);
    MeshResult& result = remeshed.generated.result;
    times.begin("write");
    observer_.meshed(result, remeshed.start);
    times.begin("solve");
    flow::SolvedFlow flow = solver_(comm_, result.mesh, remeshed.start, cycle);
    times.begin("write");
    std::vector<std::string> warnings = result.report.warnings;
    append(warnings, observer_.solved(result.mesh, flow));
    times.begin("adapt");
    CycleEnd end{{std::move(result.mesh), std::move(result.tree), std::move(flow.solution),
                  observer_.place_of_solution(cycle)},
                 {}};
    end.plan = plan_adaptation(comm_, mesh_, adapt_, end.solved);
    times.begin("write");
    observer_.planned(end);
    times.end();
    append(warnings, flow.warnings);
    if (adapt_.cycles > 0) append(warnings, warnings_after(cycle, end.plan));
    CycleRecord record = record_of(cycle, remeshed, flow, end, times);
    settle(before, record, end);
    observer_.finished(std::move(record), flow.notes, warnings);
    progress::set_prefix("");
    return end;
  }

 private:
  /// Returns the plan's warnings. The last of them refers to this cycle if the next mesh would be the same.
  static std::vector<std::string> warnings_after(int cycle, const AdaptationPlan& plan) {
    std::vector<std::string> warnings = plan.warnings;
    if (!plan.changes_mesh()) warnings.back() = fmt::format("after cycle {}: {}", cycle, warnings.back());
    return warnings;
  }

  RemeshedSolution next_mesh(const CycleEnd* before) const {
    if (before != nullptr) return remesh_and_transfer(comm_, mesh_, before->plan, before->solved);
    if (start_) return start_();
    RemeshedSolution first{generate_mesh(comm_, mesh_), {}, {}, {}};
    require_room_for_metric(comm_, mesh_, adapt_, first.generated.result);
    return first;
  }

  /// Compares the cycle with the one before.
  void settle(const CycleEnd* before, CycleRecord& record, CycleEnd& end) const {
    const AdaptOptions::Until& until = adapt_.until;
    end.values = values_of(record);
    require_reported(until, end.values);
    if (before != nullptr) {
      record.order = observed_order(before->values, end.values);
      end.settled = have_settled(until, before->values, end.values);
    }
    if (!until.empty()) record.settled = end.settled;
  }

  static std::optional<LayerQuality> layer_quality(const Communicator& comm, const Mesh& mesh) {
    if (!has_layers(mesh)) return {};
    const LayerPlaces places = layer_places(comm, mesh);
    const FaceStatistics faces = face_statistics(comm, mesh, places).layers;
    return LayerQuality{quality_by_layers(comm, mesh, places).others.smallest_degrees, faces.aspect_ratio,
                        faces.non_orthogonality, faces.skewness};
  }

  CycleRecord record_of(int cycle, const RemeshedSolution& remeshed, const flow::SolvedFlow& flow,
                        const CycleEnd& end, const StageTimes& times) const {
    const QualitySummary quality = summarise_quality(comm_, end.solved.mesh);
    CycleRecord record;
    record.cycle = cycle;
    record.solution_digest = solution_digest(comm_, end.solved.mesh, end.solved.solution);
    record.nodes = quality.counts.nodes;
    record.triangles = quality.counts.triangles;
    record.quads = quality.counts.quads;
    record.leaves = remeshed.generated.result.report.leaves;
    record.worst_angle = quality.smallest_degrees;
    record.layered = layer_quality(comm_, end.solved.mesh);
    record.mean = end.plan.mean;
    record.deviation = end.plan.deviation;
    record.refined = end.plan.refined;
    record.coarsened = end.plan.coarsened;
    record.estimate = end.plan.estimate;
    if (cycle == 0 && start_ && adapt_.passes == 0) record.morphed = remeshed.morphed;
    record.passes = remeshed.passes;
    record.outside = remeshed.report.outside;
    record.drift = remeshed.drifts();
    static_cast<flow::FlowStatistics&>(record) = flow;
    for (const BoundaryLayerReport& row : remeshed.generated.layers) {
      if (row.y_plus > 0)
        record.first_heights.push_back({row.boundary, row.first_asked, row.first_asked_most});
      if (row.follows_flow)
        record.thickness.push_back({row.boundary, row.thickness_asked, row.thickness_asked_most});
    }
    record.metric = remeshed.stretched;
    record.seconds = seconds_of(comm_, times);
    return record;
  }

  const Communicator& comm_;
  const MeshInput& mesh_;
  const AdaptOptions& adapt_;
  const flow::FlowSolver& solver_;
  CycleObserver& observer_;
  const FirstMesh& start_;
};

}  // namespace

LoopEnd run_loop(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
                 const flow::FlowSolver& solver, CycleObserver& observer, int first,
                 std::optional<CycleEnd> before, const FirstMesh& start) {
  const Loop loop(comm, mesh, adapt, solver, observer, start);
  LoopEnd end{first, first - 1, false, false, std::move(before)};
  for (int cycle = first; cycle <= adapt.cycles; ++cycle) {
    end.nothing_to_change = end.left && !end.left->plan.changes_mesh();
    end.settled = end.left && end.left->settled;
    if (end.nothing_to_change || end.settled) return end;
    end.left = loop.run_cycle(cycle, end.left ? &*end.left : nullptr);
    end.last = cycle;
  }
  return end;
}

}  // namespace quadloop::adapt
