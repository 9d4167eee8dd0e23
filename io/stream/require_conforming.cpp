#include "io/stream/require_conforming.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"

namespace quadloop {

void require_conforming(const Communicator& comm, const Mesh& mesh, const EdgeCells& cells,
                        std::int64_t between, const std::string& path) {
  std::int64_t on_boundaries = -between;
  for (const BoundaryEdges& boundary : mesh.boundaries) on_boundaries += std::ssize(boundary.edges);
  const std::int64_t outer = std::ranges::count(cells.across, EdgeCells::none);
  const std::int64_t without_cell = std::ranges::count(cells.of_boundary, EdgeCells::none);
  if (comm.sum(outer) == comm.sum(on_boundaries) && comm.sum(without_cell) == 0) return;
  throw OutputError(
      path +
      ": this format needs each edge between two cells, or of one cell and on one boundary; this "
      "mesh has others (`quadloop check` says where)");
}

}  // namespace quadloop
