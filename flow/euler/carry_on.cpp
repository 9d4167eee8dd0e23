#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

#include "flow/euler/flow_run.hpp"
#include "mesher/base/log.hpp"

namespace quadloop::euler {

namespace {

/// Mean in time by trapezia, and half the range.
struct Course {
  double mean = 0, swing = 0;
};

Course course(std::span<const HistoryRow> rows, double HistoryRow::*value) {
  if (rows.size() < 2) return {rows.empty() ? 0 : rows[0].*value, 0};
  double sum = 0, low = rows[0].*value, high = low;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    sum += 0.5 * (rows[k].*value + rows[k - 1].*value) * (rows[k].time - rows[k - 1].time);
    low = std::min(low, rows[k].*value);
    high = std::max(high, rows[k].*value);
  }
  return {sum / (rows.back().time - rows.front().time), 0.5 * (high - low)};
}

}  // namespace

EulerResult carry_on(const FlowRun& run, const EulerResult& steady) {
  if (run.comm.is_root())
    log::detail(
        fmt::format("no steady state was found: carried on in time by {}", run.options.unsteady_time));
  EulerOptions options = run.options;
  options.time = EulerOptions::Time::accurate;
  options.end_time = options.unsteady_time;
  options.iterations = std::numeric_limits<int>::max();
  run.residual.release_limiter();
  EulerResult result = march_in_time({run.comm, options, run.mesh, run.model, run.residual, run.states});
  const auto half = std::ranges::find_if(
      result.history, [&](const HistoryRow& row) { return row.time >= 0.5 * options.end_time; });
  const std::span<const HistoryRow> second(half, result.history.end());
  const Course lift = course(second, &HistoryRow::cl), drag = course(second, &HistoryRow::cd);
  for (HistoryRow& row : result.history) row.step += steady.iterations;
  result.history.insert(result.history.begin(), steady.history.begin(), steady.history.end());
  result.iterations += steady.iterations;
  result.kept_iteration = result.iterations;
  result.residual = result.last_residual = steady.residual;
  result.converged = false;
  result.cl = lift.mean;
  result.cd = drag.mean;
  result.cl_swing = lift.swing;
  result.cd_swing = drag.swing;
  return result;
}

}  // namespace quadloop::euler
