#include "mesher/build/count_nodes.hpp"

#include "mesher/build/islands.hpp"
#include "mesher/build/mesh_estimate.hpp"
#include "mesher/build/number_nodes.hpp"
#include "mesher/build/required_points.hpp"
#include "mesher/build/sized_domain.hpp"
#include "mesher/forest/refine_forest.hpp"

namespace quadloop {

std::int64_t count_nodes(const Communicator& comm, const Geometry& given, const MeshOptions& wanted,
                         const DemandedSplits& demanded) {
  MeshReport dropped;  // reported when the mesh is made
  const std::optional<Geometry> fewer = small_islands_dropped(given, wanted.size.min, dropped);
  const Geometry& geometry = fewer ? *fewer : given;
  const MeshOptions options = with_room_for_points(geometry, wanted);
  SizedDomain domain(geometry, options.size, demanded);
  const LeafEstimate leaves = estimate_leaves(comm, domain.sizes);
  require_within(estimate_mesh(geometry, options.type, domain, leaves), geometry, options, demanded);
  const LeafGraph graph = refine_forest(comm, domain.sizes, leaves);
  const CutForest cut = cut_forest(comm, graph, domain.sizes, domain.outline, domain.inside, options.snap,
                                   options.mirror, positions_of(options.required_points));
  return comm.sum(NodeNumbering(comm, domain.grid, graph, cut).owned());
}

}  // namespace quadloop
