#include "mesher/mesh/check/block_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

namespace {

/// Returns the sum of the areas of each block's cells. *Collective.*
std::vector<double> block_areas(const Communicator& comm, const std::vector<double>& areas,
                                const CellBlocks& blocks) {
  double largest = 0;
  for (const double area : areas) largest = std::max(largest, std::abs(area));
  largest = comm.maximum(largest);
  const bool finite = std::ranges::all_of(areas, [](double area) { return std::isfinite(area); });
  if (comm.any(!finite) || largest == 0)
    return std::vector<double>(blocks.count, largest == 0 ? 0 : std::numeric_limits<double>::quiet_NaN());
  ReproducibleSums sums(blocks.count, largest, comm.sum(std::ssize(areas)));
  for (std::size_t cell = 0; cell < areas.size(); ++cell) sums.add(blocks.of(cell), areas[cell]);
  return sums.over(comm);
}

}  // namespace

std::vector<BlockStatistics> block_statistics(const Communicator& comm, const Mesh& mesh,
                                              const CellBlocks& blocks, std::span<const std::string> names) {
  std::vector<BlockStatistics> sizes(blocks.count);
  for (std::size_t b = 0; b < sizes.size() && b < names.size(); ++b) sizes[b].name = names[b];
  const std::vector<double> areas = cell_areas(mesh);
  for (std::size_t cell = 0; cell < areas.size(); ++cell) ++sizes[blocks.of(cell)].cells;
  const std::vector<double> sums = block_areas(comm, areas, blocks);
  for (std::size_t b = 0; b < sizes.size(); ++b) {
    sizes[b].cells = comm.sum(sizes[b].cells);
    sizes[b].area = sums[b];
  }
  return sizes;
}

InterfaceEdges interface_edges(const Communicator& comm, const Mesh& mesh, std::int64_t between_blocks) {
  InterfaceEdges edges{between_blocks, 0};
  if (between_blocks == 0) return edges;
  const std::vector<std::int64_t> left = cells_left_of_boundaries(comm, mesh),
                                  right = cells_right_of_boundaries(comm, mesh);
  std::int64_t named = 0;
  for (std::size_t i = 0; i < left.size(); ++i) named += left[i] >= 0 && right[i] >= 0 ? 1 : 0;
  edges.unnamed = edges.all - comm.sum(named);
  return edges;
}

}  // namespace quadloop
