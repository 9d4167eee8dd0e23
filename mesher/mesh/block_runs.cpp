#include "mesher/mesh/block_runs.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"

namespace quadloop {

namespace {

constexpr std::int64_t triangle_corners = 3, quad_corners = 4;

void append_runs(std::int64_t corners, const std::vector<std::int32_t>& blocks, std::vector<BlockRun>& runs) {
  for (const std::int32_t block : blocks) {
    if (runs.empty() || runs.back().corners != corners || runs.back().block != block)
      runs.push_back({corners, block, 0});
    ++runs.back().cells;
  }
}

/// Joins neighbouring runs of the same block, which two ranks share.
std::vector<BlockRun> joined(const std::vector<BlockRun>& runs) {
  std::vector<BlockRun> all;
  for (const BlockRun& run : runs) {
    if (!all.empty() && all.back().corners == run.corners && all.back().block == run.block)
      all.back().cells += run.cells;
    else
      all.push_back(run);
  }
  return all;
}

[[noreturn]] void refuse(std::int64_t block) {
  throw InputError("block " + std::to_string(block + 1) +
                   " has another number of cells than in the tree; give the tree file that was written with "
                   "this mesh");
}

/// Returns the number of each block's cells over all ranks. *Collective.*
std::vector<std::int64_t> cells_of_blocks(const Communicator& comm, const std::vector<std::int32_t>& blocks,
                                          std::size_t count) {
  std::vector<std::int64_t> cells(count, 0);
  for (const std::int32_t block : blocks) ++cells[block];
  const std::vector<std::int64_t> of_ranks = comm.all_gather_values(std::span<const std::int64_t>(cells));
  std::ranges::fill(cells, 0);
  for (std::size_t i = 0; i < of_ranks.size(); ++i) cells[i % count] += of_ranks[i];
  return cells;
}

/// Returns the numbers, in the file, of the cells of a kind that are in this rank's share of the quadtree's
/// order. *Collective.*
std::vector<std::int64_t> order_of_kind(const Communicator& comm, std::int64_t corners,
                                        const std::vector<std::int32_t>& blocks, std::size_t count,
                                        const std::vector<BlockRun>& runs) {
  const std::vector<std::int64_t> cells = cells_of_blocks(comm, blocks, count);
  const EvenShare share(comm, std::accumulate(cells.begin(), cells.end(), std::int64_t{0}));
  std::vector<std::int64_t> next(count, 0), ends(count, 0);  // the cells of a block that were not used yet
  std::inclusive_scan(cells.begin(), cells.end(), ends.begin());
  for (std::size_t b = 1; b < count; ++b) next[b] = ends[b - 1];
  std::vector<std::int64_t> order;
  std::int64_t first = 0;  // place of the run
  for (const BlockRun& run : runs) {
    if (run.corners != corners) continue;
    if (run.block < 0 || run.block >= std::ssize(cells)) refuse(run.block);
    if (run.cells < 0 || run.cells > ends[run.block] - next[run.block]) refuse(run.block);
    const std::int64_t begin = std::max(first, share.begin), end = std::min(first + run.cells, share.end);
    for (std::int64_t i = begin; i < end; ++i) order.push_back(next[run.block] + i - first);
    next[run.block] += run.cells;
    first += run.cells;
  }
  for (std::size_t b = 0; b < count; ++b) {
    if (next[b] < ends[b]) refuse(static_cast<std::int64_t>(b));
  }
  return order;
}

/// Returns the blocks of this rank's `own` cells of a kind, which follow those of lower ranks. *Collective.*
std::vector<std::int32_t> blocks_of_kind(const Communicator& comm, std::int64_t corners, std::int64_t own,
                                         const std::vector<BlockRun>& runs) {
  const std::int64_t begin = comm.exclusive_sum(own);
  std::vector<std::int32_t> blocks;
  std::int64_t first = 0;
  for (const BlockRun& run : runs) {
    if (run.corners != corners) continue;
    const std::int64_t from = std::max(first, begin), to = std::min(first + run.cells, begin + own);
    if (from < to) blocks.insert(blocks.end(), to - from, static_cast<std::int32_t>(run.block));
    first += run.cells;
  }
  return blocks;
}

}  // namespace

std::vector<BlockRun> block_runs(const Communicator& comm, const Mesh& mesh) {
  if (mesh.blocks.names.size() < 2) return {};
  std::vector<BlockRun> own;
  append_runs(triangle_corners, mesh.blocks.of_triangles, own);
  append_runs(quad_corners, mesh.blocks.of_quads, own);
  std::vector<BlockRun> all = comm.all_gather_values(std::span<const BlockRun>(own));
  std::ranges::stable_sort(all, {}, &BlockRun::corners);
  return joined(all);
}

PartOrder order_by_runs(const Communicator& comm, const Mesh& mesh, const std::vector<BlockRun>& runs) {
  PartOrder order = own_order(comm, mesh);
  if (runs.empty()) return order;
  const MeshBlocks& blocks = mesh.blocks;
  const std::size_t count = blocks.names.size();
  order.triangles = order_of_kind(comm, triangle_corners, blocks.of_triangles, count, runs);
  order.quads = order_of_kind(comm, quad_corners, blocks.of_quads, count, runs);
  return order;
}

void set_blocks(const Communicator& comm, const std::vector<std::string>& names,
                const std::vector<BlockRun>& runs, Mesh& mesh) {
  if (runs.empty()) return;
  mesh.blocks.names = names;
  mesh.blocks.of_triangles = blocks_of_kind(comm, triangle_corners, std::ssize(mesh.triangles), runs);
  mesh.blocks.of_quads = blocks_of_kind(comm, quad_corners, std::ssize(mesh.quads), runs);
  comm.together([&] {
    if (mesh.blocks.of_triangles.size() != mesh.triangles.size() ||
        mesh.blocks.of_quads.size() != mesh.quads.size())
      throw InputError("the mesh has more cells than its tree; give the tree file that was written with it");
  });
}

}  // namespace quadloop
