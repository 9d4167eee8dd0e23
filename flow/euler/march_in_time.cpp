#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flow/euler/in_time/time_scheme.hpp"
#include "flow/euler/march.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::flow::euler {

namespace {

constexpr int explicit_history = 10;  ///< explicit steps are many and small

class TimeMarch {
 public:
  TimeMarch(FlowRun& run, const TimePlan& plan, EulerResult& result, TimeAverage& average)
      : run_{run},
        plan_{plan},
        result_{result},
        average_{average},
        first_step_{result.iterations},
        reference_{plan.reference},
        far_field_(run.comm, run.mesh, run.model),
        scheme_{time_scheme(run, plan.step, run.options.cfl)} {}

  void march() {
    double before = 0;  // length of the previous step, as far as it counts for the averages
    while (true) {
      surround(run_, far_field_);
      const IdVector<NodeId, Flux>& fluxes = run_.residual.evaluate(run_.states);
      measure(fluxes);
      const bool ends = result_.converged || steps() >= plan_.most_steps;
      report(run_, result_, run_.options.cfl, ends, {true, keeps_every_step() ? 1 : explicit_history});
      if (ends) return finish(before);
      const double left = plan_.end - result_.time, full = scheme_->longest_step();
      const bool last = full >= left * (1 - 1e-9);
      const double step = last ? left : full;
      require_progress(step);
      before = count(before, step);
      if (!scheme_->advance(step, fluxes)) fail(run_.residual.evaluate(run_.states));
      longest_ = std::max(longest_, step);
      result_.time = last ? plan_.end : result_.time + step;
      ++result_.iterations;
    }
  }

 private:
  int steps() const { return result_.iterations - first_step_; }

  bool counts_for_means() const { return plan_.average_from && result_.time >= *plan_.average_from; }

  /// Also the step at which averaging starts.
  bool keeps_every_step() const { return scheme_->is_implicit() || (counts_for_means() && average_.empty()); }

  void measure(const IdVector<NodeId, Flux>& fluxes) {
    const double norm = mass_residual(run_, fluxes);
    if (!std::isfinite(norm)) fail(fluxes);
    if (reference_ == 0) reference_ = norm;
    result_.residual = reference_ > 0 ? norm / reference_ : 0;
    is_steady_ = plan_.tolerance > 0 && result_.residual <= plan_.tolerance;
    result_.converged = result_.time >= plan_.end || is_steady_;
  }

  /// Reports failure at the present states.
  [[noreturn]] void fail(const IdVector<NodeId, Flux>& fluxes) const {
    throw SolverError(
        fmt::format("the flow solver failed at time {:.6g} {}; check the boundary conditions and the cells "
                    "there, or try a smaller {}",
                    result_.time, worst_place(run_, fluxes),
                    scheme_->is_implicit() ? "time_step" : "cfl, or implicit steps by a time_step"));
  }

  void require_progress(double step) const {
    if (result_.time + step > result_.time) return;
    throw SolverError(fmt::format("steps of {:.3g} do not move the time {:.6g} on; try a larger {}", step,
                                  result_.time, scheme_->is_implicit() ? "time_step" : "cfl"));
  }

  /// Trapezoidal rule: the flow counts for half the step before and half the step after. Returns the latter.
  double count(double before, double step) {
    if (!counts_for_means()) return 0;
    average_.add(run_.states, run_.residual.friction(), run_.mesh.owned_nodes(), 0.5 * (before + step));
    return step;
  }

  void finish(double before) {
    result_.kept_iteration = result_.iterations;
    result_.last_residual = result_.residual;
    if (is_steady_) average_ = {};
    result_.unsolved = is_steady_ ? 0 : scheme_->unsolved();
    if (is_steady_ || !plan_.average_from) return;
    if (before > 0)
      average_.add(run_.states, run_.residual.friction(), run_.mesh.owned_nodes(), 0.5 * before);
    else if (average_.empty())  // the last step was longer than the averaging period
      average_.add(run_.states, run_.residual.friction(), run_.mesh.owned_nodes(), 1);
    UnsteadyFlow flow = unsteady_flow(result_.history, *plan_.average_from);
    flow.steps = steps();
    flow.longest_step = longest_;
    flow.implicit = scheme_->is_implicit();
    flow.unsolved = result_.unsolved;
    const double speed = std::hypot(run_.model.free_stream[1], run_.model.free_stream[2]);
    if (flow.period && speed > 0) flow.strouhal = run_.options.reference_length / (*flow.period * speed);
    result_.unsteady = flow;
  }

  FlowRun& run_;
  TimePlan plan_;
  EulerResult& result_;
  TimeAverage& average_;
  int first_step_;
  double reference_, longest_ = 0;
  FarField far_field_;
  std::unique_ptr<TimeScheme> scheme_;
  bool is_steady_ = false;
};

}  // namespace

void march_in_time(FlowRun& run, const TimePlan& plan, EulerResult& result, TimeAverage& average) {
  TimeMarch(run, plan, result, average).march();
}

}  // namespace quadloop::flow::euler
