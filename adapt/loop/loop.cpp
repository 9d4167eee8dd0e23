#include "adapt/loop/loop.hpp"

#include <fmt/format.h>

#include <utility>

#include "generate/digests.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/progress.hpp"
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

/// Returns the plan's warnings. The last of them refers to this cycle if the next mesh would be the same.
std::vector<std::string> warnings_after(int cycle, const AdaptationPlan& plan) {
  std::vector<std::string> warnings = plan.warnings;
  if (!plan.changes_mesh()) warnings.back() = fmt::format("after cycle {}: {}", cycle, warnings.back());
  return warnings;
}

std::optional<LayerQuality> layer_quality(const Communicator& comm, const Mesh& mesh) {
  if (!has_layers(mesh)) return {};
  const LayerPlaces places = layer_places(comm, mesh);
  const FaceStatistics faces = face_statistics(comm, mesh, places).layers;
  return LayerQuality{quality_by_layers(comm, mesh, places).others.smallest_degrees, faces.aspect_ratio,
                      faces.non_orthogonality, faces.skewness};
}

}  // namespace

AdaptiveLoop::AdaptiveLoop(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
                           CycleObserver& observer, LoopStart start)
    : comm_{comm},
      mesh_{mesh},
      adapt_{adapt},
      observer_{observer},
      first_mesh_{std::move(start.mesh)},
      end_{.first = start.first, .last = start.first - 1, .left = std::move(start.before)},
      cycle_{start.first - 1} {}

RemeshedSolution AdaptiveLoop::next_mesh() const {
  if (end_.left) return remesh_and_transfer(comm_, mesh_, end_.left->plan, end_.left->solved, transfer_by_);
  if (first_mesh_) return first_mesh_();
  RemeshedSolution first{generate_mesh(comm_, mesh_), {}, {}, {}};
  require_room_for_metric(comm_, mesh_, adapt_, first.generated.result);
  return first;
}

bool AdaptiveLoop::begin_cycle() {
  if (end_.last >= adapt_.cycles) return false;
  end_.nothing_to_change = end_.left && !end_.left->plan.changes_mesh();
  end_.settled = end_.left && end_.left->settled;
  if (end_.nothing_to_change || end_.settled) return false;
  end_.stopped = stop_requested_ && comm_.any(stop_requested_());
  if (end_.stopped) return false;
  cycle_ = end_.last + 1;
  times_ = {};
  observer_.begin(cycle_);
  progress::set_prefix(fmt::format("cycle {} of {}", cycle_, adapt_.cycles));
  times_.begin(!end_.left && adapt_.passes > 0 ? "passes" : "mesh");
  remeshed_ = next_mesh();
  MeshResult& result = remeshed_.generated.result;
  times_.begin("write");
  observer_.meshed(result, remeshed_.start);
  under_way_ = std::make_shared<CycleEnd>();
  under_way_->solved.mesh = std::move(result.mesh);
  under_way_->solved.tree = std::move(result.tree);
  times_.begin("solve");
  return true;
}

void AdaptiveLoop::finish_cycle(flow::SolvedFlow flow) {
  QUADLOOP_REQUIRE(under_way_ != nullptr, "no cycle is under way");
  CycleEnd& end = *under_way_;
  times_.begin("write");
  std::vector<std::string> warnings = remeshed_.generated.result.report.warnings;
  append(warnings, observer_.solved(end.solved.mesh, flow));
  times_.begin("adapt");
  end.solved.solution = std::move(flow.solution);
  end.solved.file = observer_.place_of_solution(cycle_);
  end.plan = plan_adaptation(comm_, mesh_, adapt_, end.solved);
  times_.begin("write");
  observer_.planned(end);
  times_.end();
  append(warnings, flow.warnings);
  if (adapt_.cycles > 0) append(warnings, warnings_after(cycle_, end.plan));
  CycleRecord record = record_of(flow, end);
  settle(record, end);
  observer_.finished(std::move(record), flow.notes, warnings);
  progress::set_prefix("");
  end_.left = std::move(under_way_);
  end_.last = cycle_;
}

/// Compares the cycle with the one before.
void AdaptiveLoop::settle(CycleRecord& record, CycleEnd& end) const {
  const AdaptOptions::Until& until = adapt_.until;
  end.values = values_of(record);
  require_reported(until, end.values);
  if (end_.left) {
    record.order = observed_order(end_.left->values, end.values);
    end.settled = have_settled(until, end_.left->values, end.values);
  }
  if (!until.empty()) record.settled = end.settled;
}

CycleRecord AdaptiveLoop::record_of(const flow::SolvedFlow& flow, const CycleEnd& end) const {
  const QualitySummary quality = summarise_quality(comm_, end.solved.mesh);
  CycleRecord record;
  record.cycle = cycle_;
  record.solution_digest = solution_digest(comm_, end.solved.mesh, end.solved.solution);
  record.nodes = quality.counts.nodes;
  record.triangles = quality.counts.triangles;
  record.quads = quality.counts.quads;
  record.leaves = remeshed_.generated.result.report.leaves;
  record.worst_angle = quality.smallest_degrees;
  record.layered = layer_quality(comm_, end.solved.mesh);
  record.mean = end.plan.mean;
  record.deviation = end.plan.deviation;
  record.refined = end.plan.refined;
  record.coarsened = end.plan.coarsened;
  record.estimate = end.plan.estimate;
  if (cycle_ == 0 && first_mesh_ && adapt_.passes == 0) record.morphed = remeshed_.morphed;
  record.passes = remeshed_.passes;
  record.outside = remeshed_.report.outside;
  record.drift = remeshed_.drifts();
  static_cast<flow::FlowStatistics&>(record) = flow;
  for (const BoundaryLayerReport& row : remeshed_.generated.layers) {
    if (row.y_plus > 0) record.first_heights.push_back({row.boundary, row.first_asked, row.first_asked_most});
    if (row.follows_flow)
      record.thickness.push_back({row.boundary, row.thickness_asked, row.thickness_asked_most});
  }
  record.metric = remeshed_.stretched;
  record.seconds = seconds_of(comm_, times_);
  return record;
}

LoopEnd run_to_end(const Communicator& comm, AdaptiveLoop& loop, const flow::FlowSolver& solver) {
  while (loop.begin_cycle())
    loop.finish_cycle(solver(comm, loop.under_way()->solved.mesh, loop.initial_state(), loop.cycle()));
  return loop.end();
}

LoopEnd run_loop(const Communicator& comm, const MeshInput& mesh, const AdaptOptions& adapt,
                 const flow::FlowSolver& solver, CycleObserver& observer, LoopStart start) {
  AdaptiveLoop loop(comm, mesh, adapt, observer, std::move(start));
  return run_to_end(comm, loop, solver);
}

}  // namespace quadloop::adapt
