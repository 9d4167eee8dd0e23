#include "flow/euler/scheme/far_field.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "mesher/mesh/box_over_ranks.hpp"

namespace quadloop::flow::euler {

FarField::FarField(const Communicator& comm, const DualMesh& mesh, const FlowModel& model)
    : gas_{model.gas}, free_stream_{model.free_stream} {
  std::vector<Point> walls;
  for (const BoundaryFace& face : mesh.faces()) {
    if (!feels_force(model.boundaries[face.boundary].condition)) continue;
    for (const NodeId node : {face.from, face.to}) walls.push_back(mesh.point(node));
  }
  centre_ = box_over_ranks(comm, walls).centre();
}

State FarField::at(Point place) const {
  const double u = free_stream_[1], v = free_stream_[2], speed = std::hypot(u, v);
  if (circulation_ == 0 || speed == 0 || speed >= 1) return free_stream_;
  const Point way = place - centre_;
  const double square = dot(way, way), across = (u * way.y - v * way.x) / speed;  // distance times sine
  const double swirl = circulation_ * std::sqrt(1 - speed * speed) /
                       (2 * std::numbers::pi * (square - speed * speed * across * across));
  const double x = u + swirl * way.y, y = v - swirl * way.x;
  const double g = gas_.gamma,
               // relative square of the speed of sound
      heat = 1 + 0.5 * (g - 1) * (speed * speed - x * x - y * y);
  const double density = std::pow(heat, 1 / (g - 1));
  return {density, x, y, density * heat / g};
}

}  // namespace quadloop::flow::euler
