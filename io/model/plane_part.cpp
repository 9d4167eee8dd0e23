#include "io/model/plane_part.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/model/inner_curves.hpp"
#include "io/model/orient_cells.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"

namespace quadloop::io {

namespace {

/// Reverses edges with their only cell on the right. Returns false if one belongs to no cell. *Collective.*
bool turn_edges(const Communicator& comm, Mesh& mesh) {
  const std::vector<std::int64_t> left = cells_left_of_boundaries(comm, mesh);
  if (!comm.any(std::ranges::count(left, EdgeCells::none) > 0)) return true;
  const std::vector<std::int64_t> right = cells_right_of_boundaries(comm, mesh);
  bool good = true;
  std::size_t number = 0;
  for (BoundaryEdges& boundary : mesh.boundaries) {
    for (auto& [from, to] : boundary.edges) {
      if (left[number] == EdgeCells::none) {
        good = good && right[number] != EdgeCells::none;
        std::swap(from, to);
      }
      ++number;
    }
  }
  return !comm.any(!good);
}

}  // namespace

void complete_plane_part(const Communicator& comm, LoadedMesh& loaded, const std::string& path) {
  Mesh& mesh = loaded.mesh;
  const bool good = surely_oriented(comm, mesh) && turn_edges(comm, mesh);
  if (good) {
    drop_empty_boundaries(comm, mesh);
    separate_inner_curves(comm, loaded, path);
  }
  if (!good || mesh.boundaries.empty()) throw InputError(path + ": needs corrections");
}

}  // namespace quadloop::io
