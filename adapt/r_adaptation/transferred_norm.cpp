#include "adapt/r_adaptation/transferred_norm.hpp"

#include <algorithm>

#include "adapt/sensor/interpolation_error.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::adapt {

Field rows_of(const std::vector<Symmetric>& matrices, std::int32_t owned_nodes) {
  Field rows{{"xx", "xy", "yy"}, {}, {}};
  for (std::int32_t n = 0; n < owned_nodes; ++n)
    rows.values.insert(rows.values.end(), {matrices[n].xx, matrices[n].xy, matrices[n].yy});
  return rows;
}

double norm_by_bends(const Communicator& comm, const Mesh& mesh, const std::vector<Symmetric>& bends,
                     double p) {
  std::vector<Symmetric> of_cells;
  const auto add = [&](const auto& nodes) {
    Symmetric sum;
    for (const NodeId node : nodes) sum = sum + bends[node.value()];
    of_cells.push_back((1.0 / static_cast<double>(nodes.size())) * sum);
  };
  std::ranges::for_each(mesh.triangles, add);
  std::ranges::for_each(mesh.quads, add);
  InterpolationError error;
  for (const CellShape& shape : cell_shapes(mesh)) error.areas.push_back(shape.area);
  error.mean.resize(error.areas.size(), 0);
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    const Point e = mesh.point(to) - mesh.point(from);
    const Symmetric& h = of_cells[cell];
    error.mean[cell] += (h.xx * e.x * e.x + 2 * h.xy * e.x * e.y + h.yy * e.y * e.y) / 24;
  });
  return norm_of(comm, error, p);
}

BestPlaces::BestPlaces(const Communicator& comm, const Mesh& solved, const Field& bends, double p,
                       const Mesh& mesh)
    : comm_{comm},
      solved_{solved},
      bends_{bends},
      p_{p},
      first_{norm_on(mesh)},
      least_{first_},
      places_{mesh.points} {}

void BestPlaces::look_at(const Mesh& mesh) {
  const double norm = norm_on(mesh);
  if (!(norm < least_)) return;
  least_ = norm;
  places_ = mesh.points;
}

double BestPlaces::norm_on(const Mesh& mesh) const {
  return norm_by_bends(comm_, mesh, transferred<Symmetric>(comm_, solved_, bends_, mesh), p_);
}

}  // namespace quadloop::adapt
