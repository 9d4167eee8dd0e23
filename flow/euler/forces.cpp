#include "flow/euler/forces.hpp"

#include "flow/euler/scheme/residual.hpp"
#include "mesher/base/reproducible_sum.hpp"

namespace quadloop::euler {

ForceCoefficients wall_forces(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                              const std::vector<State>& states, double reference_length) {
  std::vector<double> along_x, along_y;  // of each half of a wall face that belongs to an owned node
  for (const BoundaryFace& face : mesh.faces()) {
    if (!feels_force(model.boundaries[face.boundary].condition)) continue;
    for (const auto& [own, other] : {std::pair{face.from, face.to}, {face.to, face.from}}) {
      if (!mesh.is_owned(own)) continue;
      const State state = state_at_half(face, states[own], states[other]);
      const double push = (state[3] - model.free_stream[3]) * face.half_size;
      along_x.push_back(push * face.normal.x);
      along_y.push_back(push * face.normal.y);
    }
  }
  const double x = reproducible_sum(comm, along_x), y = reproducible_sum(comm, along_y);
  const double speed = std::hypot(model.free_stream[1], model.free_stream[2]);
  if (speed == 0) return {};
  const double scale = 1 / (0.5 * speed * speed * reference_length), cosine = model.free_stream[1] / speed,
               sine = model.free_stream[2] / speed;
  return {scale * (y * cosine - x * sine), scale * (x * cosine + y * sine)};
}

}  // namespace quadloop::euler
