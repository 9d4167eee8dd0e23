#include "flow/adjoint/goal_functional.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "flow/euler/model/dual_number.hpp"
#include "flow/euler/scheme/residual.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::flow::euler {

namespace {

/// Returns the contribution to the functional of unit pressure on a boundary segment; the length of its
/// normal is that of the segment. `scale` converts forces to coefficients.
template <class Real, class Vector>
Real share_of(const Goal& goal, Point wind, double scale, double length, const Vector& normal,
              const Vector& at) {
  using std::sqrt;
  switch (goal.quantity) {
    case Goal::Quantity::lift: return scale * (normal.y * wind.x - normal.x * wind.y);
    case Goal::Quantity::drag: return scale * (normal.x * wind.x + normal.y * wind.y);
    case Goal::Quantity::moment:
      return -scale / length * ((at.x - goal.about.x) * normal.y - (at.y - goal.about.y) * normal.x);
    case Goal::Quantity::pressure: return scale * sqrt(normal.x * normal.x + normal.y * normal.y);
  }
  QUADLOOP_REQUIRE(false, "a goal without a quantity");
  return 0;
}

/// Returns a flag for each boundary: whether it counts. Throws InputError for an unknown name.
std::vector<bool> counted(const FlowModel& model, const std::vector<std::string>& boundaries,
                          const Goal& goal) {
  std::vector<bool> counts;
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    const Condition condition = model.boundaries[b].condition;
    const bool named = std::ranges::find(goal.boundaries, boundaries[b]) != goal.boundaries.end();
    counts.push_back(condition != Condition::none &&
                     (goal.boundaries.empty() ? feels_force(condition) : named));
  }
  return counts;
}

}  // namespace

GoalFunctional::GoalFunctional(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                               const std::vector<std::string>& boundaries, const Goal& goal,
                               double reference_length)
    : comm_{comm},
      mesh_{mesh},
      goal_{goal},
      scale_{0},
      length_{reference_length},
      outside_{model.free_stream[3]} {
  if (model.free_stream[1] == 0 && model.free_stream[2] == 0)
    throw InputError(
        "solver.goal is a coefficient, but the free stream is at rest; set a solver.mach above 0");
  const double speed = std::hypot(model.free_stream[1], model.free_stream[2]);
  wind_ = {model.free_stream[1] / speed, model.free_stream[2] / speed};
  scale_ = 1 / (0.5 * speed * speed * reference_length);
  const std::vector<bool> counts = counted(model, boundaries, goal);
  const auto faces = mesh.faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const BoundaryFace& face = faces[f];
    if (!counts[face.boundary]) continue;
    const Point from = mesh.point(face.from), to = mesh.point(face.to);
    const auto share = [&](Point at) {
      return share_of<double>(goal, wind_, scale_, reference_length, face.normal, at);
    };
    parts_.push_back({f, share(0.25 * (3.0 * from + to)), share(0.25 * (from + 3.0 * to))});
  }
  if (comm.any(!parts_.empty())) return;
  throw InputError(
      goal.boundaries.empty()
          ? std::string("solver.goal: no boundary has a force; set bc = \"wall\" for one, or name boundaries "
                        "in solver.goal_on")
          : fmt::format("solver.goal_on: the mesh has no edges on {}", fmt::join(goal.boundaries, ", ")));
}

double GoalFunctional::value(const IdVector<NodeId, State>& states) const {
  std::vector<double> terms;
  for (const Part& part : parts_) {
    const BoundaryFace& face = mesh_.faces()[part.face];
    for (const auto& [own, other, weight] :
         {std::tuple{face.from, face.to, part.of_from}, {face.to, face.from, part.of_to}}) {
      if (!mesh_.is_owned(own)) continue;
      const State state = state_at_half(face, states[own], states[other]);
      terms.push_back(weight * ((state[3] - outside_) * face.half_size));
    }
  }
  return reproducible_sum(comm_, terms);
}

IdVector<NodeId, State> GoalFunctional::derivative() const {
  IdVector<NodeId, State> result(mesh_.nodes(), State{});
  for (const Part& part : parts_) {
    const BoundaryFace& face = mesh_.faces()[part.face];
    const double of_other = face.blend / 6, from = face.half_size * part.of_from,
                 to = face.half_size * part.of_to;
    result[face.from][3] += (1 - of_other) * from + of_other * to;
    result[face.to][3] += (1 - of_other) * to + of_other * from;
  }
  return result;
}

void GoalFunctional::add_place_derivative(const IdVector<NodeId, State>& states,
                                          IdVector<NodeId, Point>& sums) const {
  using Dual = DualNumber<4>;
  using Vector = VectorOf<Dual>;
  for (const Part& part : parts_) {
    const BoundaryFace& face = mesh_.faces()[part.face];
    const Point a = mesh_.point(face.from), b = mesh_.point(face.to);
    const Vector from{Dual::variable(a.x, 0), Dual::variable(a.y, 1)},
        to{Dual::variable(b.x, 2), Dual::variable(b.y, 3)};
    const Vector half_normal{0.5 * (to.y - from.y), 0.5 * (from.x - to.x)};
    for (const bool at_from : {true, false}) {
      const auto& [own, other] = at_from ? std::pair{face.from, face.to} : std::pair{face.to, face.from};
      const Vector &near = at_from ? from : to, &far = at_from ? to : from;
      const Vector at{0.25 * (3 * near.x + far.x), 0.25 * (3 * near.y + far.y)};
      const double pressure = state_at_half(face, states[own], states[other])[3] - outside_;
      const Dual term = pressure * share_of<Dual>(goal_, wind_, scale_, length_, half_normal, at);
      sums[face.from] = sums[face.from] + Point{term.slopes[0], term.slopes[1]};
      sums[face.to] = sums[face.to] + Point{term.slopes[2], term.slopes[3]};
    }
  }
}

}  // namespace quadloop::flow::euler
