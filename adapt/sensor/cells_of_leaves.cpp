#include "adapt/sensor/cells_of_leaves.hpp"

#include <functional>
#include <numeric>
#include <string>

#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

std::int64_t count_of(std::span<const LeafRecord> leaves, std::int32_t LeafRecord::*member) {
  return std::accumulate(leaves.begin(), leaves.end(), std::int64_t{0},
                         [&](std::int64_t count, const LeafRecord& leaf) { return count + leaf.*member; });
}

std::string cells(std::int64_t triangles, std::int64_t quads) {
  return std::to_string(triangles) + " triangles and " + std::to_string(quads) + " quads";
}

}  // namespace

CellsOfLeaves::CellsOfLeaves(const Communicator& comm, const Mesh& mesh, std::span<const LeafRecord> leaves)
    : leaves_{leaves},
      own_triangles_{mesh.triangles.size()},
      triangles_(comm, std::ssize(mesh.triangles), count_of(leaves, &LeafRecord::triangles)),
      quads_(comm, std::ssize(mesh.quads), count_of(leaves, &LeafRecord::quads)) {
  if (triangles_.all_held() == triangles_.all_wanted() && quads_.all_held() == quads_.all_wanted()) return;
  throw InputError("the mesh has " + cells(triangles_.all_held(), quads_.all_held()) +
                   ", but the leaves of the tree have " +
                   cells(triangles_.all_wanted(), quads_.all_wanted()) +
                   "; give the tree file that was written with this mesh");
}

template <class Better>
std::vector<double> CellsOfLeaves::best(const Communicator& comm, std::span<const double> of_cells,
                                        const Better& better) const {
  const std::vector<double> of_triangles = triangles_.bring(comm, of_cells.first(own_triangles_));
  const std::vector<double> of_quads = quads_.bring(comm, of_cells.subspan(own_triangles_));
  std::vector<double> of_leaves(leaves_.size(), 0);
  auto triangle = of_triangles.begin(), quad = of_quads.begin();
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    if (!has_cells(leaves_[i])) continue;
    double& value = of_leaves[i];
    value = leaves_[i].triangles > 0 ? *triangle : *quad;
    for (std::int32_t k = 0; k < leaves_[i].triangles; ++k, ++triangle)
      value = better(*triangle, value) ? *triangle : value;
    for (std::int32_t k = 0; k < leaves_[i].quads; ++k, ++quad) value = better(*quad, value) ? *quad : value;
  }
  return of_leaves;
}

std::vector<double> CellsOfLeaves::largest(const Communicator& comm, std::span<const double> of_cells) const {
  return best(comm, of_cells, std::greater<>());
}

std::vector<double> CellsOfLeaves::smallest(const Communicator& comm,
                                            std::span<const double> of_cells) const {
  return best(comm, of_cells, std::less<>());
}

}  // namespace quadloop::adapt
