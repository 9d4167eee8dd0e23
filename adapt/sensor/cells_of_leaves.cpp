#include "adapt/sensor/cells_of_leaves.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>

#include "mesher/base/error.hpp"

namespace quadloop {

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

template <class Joined>
std::vector<double> CellsOfLeaves::fold(const Communicator& comm, std::span<const double> of_cells,
                                        const Joined& joined) const {
  const std::vector<double> of_triangles = triangles_.bring(comm, of_cells.first(own_triangles_));
  const std::vector<double> of_quads = quads_.bring(comm, of_cells.subspan(own_triangles_));
  std::vector<double> of_leaves(leaves_.size(), 0);
  auto triangle = of_triangles.begin(), quad = of_quads.begin();
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    bool is_first = true;
    const auto take = [&](double value) {
      of_leaves[i] = is_first ? value : joined(of_leaves[i], value);
      is_first = false;
    };
    for (std::int32_t k = 0; k < leaves_[i].triangles; ++k) take(*triangle++);
    for (std::int32_t k = 0; k < leaves_[i].quads; ++k) take(*quad++);
  }
  return of_leaves;
}

std::vector<double> CellsOfLeaves::largest(const Communicator& comm, std::span<const double> of_cells) const {
  return fold(comm, of_cells, [](double a, double b) { return std::max(a, b); });
}

std::vector<double> CellsOfLeaves::smallest(const Communicator& comm,
                                            std::span<const double> of_cells) const {
  return fold(comm, of_cells, [](double a, double b) { return std::min(a, b); });
}

std::vector<double> CellsOfLeaves::sums(const Communicator& comm, std::span<const double> of_cells) const {
  return fold(comm, of_cells, std::plus<>());
}

}  // namespace quadloop
