#include "flow/postprocess/boundary_forces.hpp"

#include <cmath>
#include <numbers>

#include "flow/postprocess/flow_quantities.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::flow {

namespace {

/// Forces on one boundary's edges on this rank.
struct EdgeForces {
  std::vector<double> lift, drag, lift_friction, drag_friction;
};

/// `flow` must have ghost rows.
EdgeForces forces_on(const Mesh& mesh, const BoundaryEdges& boundary, const Field& flow,
                     const FreeStream& stream) {
  const FlowColumns columns(flow, "the flow");
  const double angle = stream.alpha * std::numbers::pi / 180;
  const Point wind{std::cos(angle), std::sin(angle)}, up{-wind.y, wind.x};
  EdgeForces forces;
  for (const auto& [a, b] : boundary.edges) {
    const Point along = mesh.point(b) - mesh.point(a);
    const Point outward{along.y, -along.x};
    const double pressure =
        0.5 * (columns.pressure(flow.row(a)) + columns.pressure(flow.row(b))) - stream.pressure;
    const double shear = 0.5 * (columns.shear(flow.row(a)) + columns.shear(flow.row(b)));
    const Point push = pressure * outward, rub = (dot(along, wind) < 0 ? -shear : shear) * along;
    forces.lift.push_back(dot(push, up));
    forces.drag.push_back(dot(push, wind));
    forces.lift_friction.push_back(dot(rub, up));
    forces.drag_friction.push_back(dot(rub, wind));
  }
  return forces;
}

}  // namespace

std::vector<BoundaryForce> boundary_forces(const Communicator& comm, const Mesh& mesh, const Field& flow,
                                           const FreeStream& stream, const std::vector<std::string>& walls) {
  const Field with = with_ghosts(comm, mesh, flow);
  std::vector<BoundaryForce> forces;
  for (const std::string& wall : walls) {
    forces.push_back({wall});
    for (const BoundaryEdges& boundary : mesh.boundaries) {
      if (boundary.name != wall) continue;
      EdgeForces parts;
      comm.together([&] { parts = forces_on(mesh, boundary, with, stream); });
      const double scale = stream.speed > 0 ? 1 / (stream.dynamic_pressure() * stream.reference_length) : 0;
      BoundaryForce& force = forces.back();
      force.cl_friction = scale * reproducible_sum(comm, parts.lift_friction);
      force.cd_friction = scale * reproducible_sum(comm, parts.drag_friction);
      force.cl = scale * reproducible_sum(comm, parts.lift) + force.cl_friction;
      force.cd = scale * reproducible_sum(comm, parts.drag) + force.cd_friction;
    }
  }
  return forces;
}

}  // namespace quadloop::flow
