#include "mesher/mesh/check/block_statistics.hpp"

#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

std::vector<BlockStatistics> block_statistics(const Mesh& mesh, const CellBlocks& blocks,
                                              std::span<const std::string> names) {
  std::vector<BlockStatistics> sizes(blocks.count);
  for (std::size_t b = 0; b < sizes.size() && b < names.size(); ++b) sizes[b].name = names[b];
  std::vector<long double> sums(sizes.size(), 0);
  const std::vector<double> areas = cell_areas(mesh);
  for (std::int32_t cell = 0; cell < std::ssize(areas); ++cell) {
    const std::int32_t block = blocks.of(cell);
    ++sizes[block].cells;
    sums[block] += areas[cell];
  }
  for (std::size_t b = 0; b < sizes.size(); ++b) sizes[b].area = static_cast<double>(sums[b]);
  return sizes;
}

InterfaceEdges interface_edges(const Mesh& mesh, const CellBlocks& blocks, const MeshTopology& topology) {
  InterfaceEdges edges;
  std::int64_t named = 0;
  auto beyond = topology.beyond().begin();
  for_each_cell_edge(mesh, [&](NodeId, NodeId, std::int32_t cell) {
    const std::int32_t other = *beyond++;
    edges.all += other >= 0 && blocks.of(cell) < blocks.of(other) ? 1 : 0;
  });
  const EdgeTable& table = topology.table();
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges)
      named += table.cell_left_of(from, to) >= 0 && table.cell_left_of(to, from) >= 0 ? 1 : 0;
  }
  edges.unnamed = edges.all - named;
  return edges;
}

}  // namespace quadloop
