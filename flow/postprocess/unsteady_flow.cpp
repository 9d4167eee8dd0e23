#include "flow/postprocess/unsteady_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/base/counted.hpp"

namespace quadloop::flow {

namespace {

using Coefficient = double HistoryRow::*;

constexpr double noise = 1e-8;  ///< amplitude of a coefficient that counts as no oscillation
/// Relative to half the oscillation range: distance from the mean that counts as being on one side.
constexpr double beside_mean = 0.3;
constexpr double irregular = 0.3;  ///< relative to the mean interval: a larger variation is not periodic

/// Trapezoidal rule over the rows.
Swing swing_of(const std::vector<HistoryRow>& rows, Coefficient value) {
  Swing swing{0, rows.front().*value, rows.front().*value};
  double sum = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    swing.smallest = std::min(swing.smallest, rows[k].*value);
    swing.largest = std::max(swing.largest, rows[k].*value);
    if (k > 0) sum += 0.5 * (rows[k].time - rows[k - 1].time) * (rows[k].*value + rows[k - 1].*value);
  }
  const double duration = rows.back().time - rows.front().time;
  swing.mean = duration > 0 ? sum / duration : rows.back().*value;
  return swing;
}

/// Returns the times at which the coefficient rises through its mean, from well below it to well above it.
std::vector<double> rises(const std::vector<HistoryRow>& rows, Coefficient value, const Swing& swing) {
  const double beside = beside_mean * 0.5 * (swing.largest - swing.smallest);
  std::vector<double> times;
  bool was_below = false;
  double crossed = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double now = rows[k].*value - swing.mean, before = k > 0 ? rows[k - 1].*value - swing.mean : now;
    if (before < 0 && now >= 0)
      crossed = rows[k - 1].time + (rows[k].time - rows[k - 1].time) * before / (before - now);
    if (now < -beside) was_below = true;
    if (now > beside && was_below) {
      times.push_back(crossed);
      was_below = false;
    }
  }
  return times;
}

std::optional<double> period_of(const std::vector<HistoryRow>& rows, Coefficient value, const Swing& swing) {
  if (swing.largest - swing.smallest < noise) return {};
  const std::vector<double> times = rises(rows, value, swing);
  if (times.size() < 3) return {};
  const double mean = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  double shortest = mean, longest = mean;
  for (std::size_t k = 1; k < times.size(); ++k) {
    shortest = std::min(shortest, times[k] - times[k - 1]);
    longest = std::max(longest, times[k] - times[k - 1]);
  }
  if (longest - shortest > irregular * mean) return {};
  return mean;
}

std::string fall_of(double residual) {
  const double orders = -std::log10(residual);
  if (std::abs(orders) < 0.05) return "the residual did not fall";
  return fmt::format("the residual {} by {:.1f} orders", orders > 0 ? "fell" : "rose", std::abs(orders));
}

std::string line_of(const char* name, const Swing& swing) {
  return fmt::format("{} {:.6f} ({:.6f} to {:.6f})", name, swing.mean, swing.smallest, swing.largest);
}

}  // namespace

UnsteadyFlow unsteady_flow(const std::vector<HistoryRow>& history, double from) {
  std::vector<HistoryRow> rows;
  for (std::size_t k = 0; k < history.size(); ++k) {
    const bool moves_on = k + 1 == history.size() || history[k + 1].time > history[k].time;
    if (history[k].time >= from && moves_on) rows.push_back(history[k]);  // steady steps take no time
  }
  UnsteadyFlow flow;
  if (rows.empty()) return flow;
  flow.from = rows.front().time;
  flow.to = rows.back().time;
  flow.cl = swing_of(rows, &HistoryRow::cl);
  flow.cd = swing_of(rows, &HistoryRow::cd);
  const bool lift_swings = flow.cl.largest - flow.cl.smallest > 0.1 * (flow.cd.largest - flow.cd.smallest);
  flow.period =
      lift_swings ? period_of(rows, &HistoryRow::cl, flow.cl) : period_of(rows, &HistoryRow::cd, flow.cd);
  return flow;
}

std::string line_of(const UnsteadyFlow& flow) {
  std::string line;
  if (flow.steady_steps > 0)
    line = fmt::format("{} in {}: the flow is classified as unsteady; ", fall_of(flow.steady_residual),
                       counted(flow.steady_steps, "step"));
  line += fmt::format("{} {} to time {:.6g}; means from time {:.6g} on: {}, {}",
                      flow.continued ? "continued in" : "solved in",
                      counted(flow.steps, flow.implicit ? "implicit step" : "explicit step"), flow.to,
                      flow.from, line_of("cl", flow.cl), line_of("cd", flow.cd));
  line += flow.period ? fmt::format(", period {:.6g}", *flow.period) : ", no period seen";
  if (flow.strouhal) line += fmt::format(", Strouhal number {:.4f}", *flow.strouhal);
  if (flow.unsolved > 0)
    line += fmt::format("; {} of them did not converge to the tolerance: try a smaller solver.time_step",
                        flow.unsolved);
  return line;
}

}  // namespace quadloop::flow
