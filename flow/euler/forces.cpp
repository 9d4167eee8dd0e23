#include "flow/euler/forces.hpp"

#include <algorithm>
#include <optional>

#include "flow/euler/scheme/residual.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::flow::euler {

namespace {

/// Converts forces to coefficients in wind axes.
struct WindAxes {
  double scale, cosine, sine;

  double lift(Point force) const { return scale * (force.y * cosine - force.x * sine); }
  double drag(Point force) const { return scale * (force.x * cosine + force.y * sine); }
};

Point sum_over_ranks(const Communicator& comm, const std::vector<Point>& forces) {
  std::vector<double> along_x, along_y;
  for (const Point& force : forces) {
    along_x.push_back(force.x);
    along_y.push_back(force.y);
  }
  const double x = reproducible_sum(comm, along_x);
  return {x, reproducible_sum(comm, along_y)};
}

/// Pressure forces on the halves of boundary faces at owned nodes. `counts` selects the faces.
template <class Counts>
std::vector<Point> pushes_on(const DualMesh& mesh, const FlowModel& model,
                             const IdVector<NodeId, State>& states, const Counts& counts) {
  std::vector<Point> pushes;
  for (const BoundaryFace& face : mesh.faces()) {
    if (!counts(face)) continue;
    for (const auto& [own, other] : {std::pair{face.from, face.to}, {face.to, face.from}}) {
      if (!mesh.is_owned(own)) continue;
      const State state = state_at_half(face, states[own], states[other]);
      const double push = (state[3] - model.free_stream[3]) * face.half_size;
      pushes.push_back(push * face.normal);
    }
  }
  return pushes;
}

/// Sums over all ranks, as coefficients.
ForceCoefficients coefficients(const Communicator& comm, const FlowModel& model,
                               const std::vector<Point>& pushes, const std::vector<Point>& rubs,
                               double reference_length) {
  const Point push = sum_over_ranks(comm, pushes), rub = sum_over_ranks(comm, rubs);
  const double speed = std::hypot(model.free_stream[1], model.free_stream[2]);
  if (speed == 0) return {};
  const WindAxes axes{1 / (0.5 * speed * speed * reference_length), model.free_stream[1] / speed,
                      model.free_stream[2] / speed};
  const double lift = axes.lift(rub), drag = axes.drag(rub);
  return {axes.lift(push) + lift, axes.drag(push) + drag, lift, drag};
}

/// For each owned node the length of its halves of no-slip faces, of one boundary or of all.
IdVector<NodeId, double> no_slip_lengths(const DualMesh& mesh, const FlowModel& model,
                                         std::optional<std::int32_t> boundary) {
  IdVector<NodeId, double> lengths(mesh.nodes(), 0.0);
  for (const BoundaryFace& face : mesh.faces()) {
    if (model.boundaries[face.boundary].condition != Condition::no_slip) continue;
    if (boundary && face.boundary != *boundary) continue;
    for (const NodeId node : {face.from, face.to}) lengths[node] += face.half_size;
  }
  lengths.resize(mesh.owned_nodes());
  return lengths;
}

}  // namespace

ForceCoefficients wall_forces(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                              const IdVector<NodeId, State>& states, const IdVector<NodeId, Point>& friction,
                              double reference_length) {
  const auto counts = [&](const BoundaryFace& face) {
    return feels_force(model.boundaries[face.boundary].condition);
  };
  std::vector<Point> rubs;
  if (!friction.empty())
    for (const NodeId node : mesh.owned_ids()) rubs.push_back(-1.0 * friction[node]);
  return coefficients(comm, model, pushes_on(mesh, model, states, counts), rubs, reference_length);
}

std::vector<BoundaryForce> forces_of_boundaries(const Communicator& comm, const DualMesh& mesh,
                                                const FlowModel& model, const IdVector<NodeId, State>& states,
                                                const IdVector<NodeId, Point>& friction,
                                                double reference_length,
                                                const std::vector<BoundaryEdges>& boundaries) {
  const IdVector<NodeId, double> all = no_slip_lengths(mesh, model, {});
  std::vector<BoundaryForce> forces;
  for (std::int32_t b = 0; b < std::ssize(boundaries); ++b) {
    const Condition condition = model.boundaries[b].condition;
    if (condition == Condition::none || !feels_force(condition)) continue;
    const IdVector<NodeId, double> lengths = no_slip_lengths(mesh, model, b);
    std::vector<Point> rubs;
    for (const NodeId node : lengths.ids()) {
      if (lengths[node] > 0) rubs.push_back(-lengths[node] / all[node] * friction[node]);
    }
    const auto counts = [&](const BoundaryFace& face) { return face.boundary == b; };
    const ForceCoefficients sum =
        coefficients(comm, model, pushes_on(mesh, model, states, counts), rubs, reference_length);
    forces.push_back({boundaries[b].name, sum.cl, sum.cd, sum.cl_friction, sum.cd_friction});
  }
  return forces;
}

IdVector<NodeId, double> wall_shear(const DualMesh& mesh, const FlowModel& model,
                                    const IdVector<NodeId, Point>& friction) {
  IdVector<NodeId, Point> normals(mesh.nodes());
  IdVector<NodeId, double> sizes(mesh.nodes(), 0.0), shear(mesh.owned_nodes(), 0.0);
  for (const BoundaryFace& face : mesh.faces()) {
    if (model.boundaries[face.boundary].condition != Condition::no_slip) continue;
    for (const NodeId node : {face.from, face.to}) {
      normals[node] = normals[node] + face.half_size * face.normal;
      sizes[node] += face.half_size;
    }
  }
  for (const NodeId node : shear.ids()) {
    const double size = length(normals[node]);
    if (size == 0) continue;
    Point along{-normals[node].y / size, normals[node].x / size};
    if (along.x * model.free_stream[1] + along.y * model.free_stream[2] < 0) along = -1.0 * along;
    shear[node] = -dot(friction[node], along) / sizes[node];
  }
  return shear;
}

}  // namespace quadloop::flow::euler
