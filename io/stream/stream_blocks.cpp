#include "io/stream/stream_blocks.hpp"

#include <algorithm>
#include <numeric>

namespace quadloop::io {

CellsByBlock::CellsByBlock(std::span<const std::int32_t> block_of, std::int32_t blocks)
    : first_(blocks + 1), cells_(block_of.size()) {
  for (const std::int32_t block : block_of) ++first_[block + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::int64_t> next = first_;
  for (std::int32_t cell = 0; cell < std::ssize(block_of); ++cell) cells_[next[block_of[cell]]++] = cell;
}

StreamBlocks::StreamBlocks(const MeshStream& stream)
    : stream_{stream}, layers_{std::max<std::int64_t>(1, stream.layers())} {
  if (const FileMesh* held = stream.held(); held != nullptr) {
    if (held->has_blocks()) names_ = held->block_names;
    if (several()) of_ = held->cell_to_block;
  } else if (const PlaneBlocks* blocks = stream.extruded()->blocks; blocks != nullptr) {
    names_ = blocks->names;
    const CellKind first = stream.is_plane() ? CellKind::triangle : CellKind::prism;
    of_[static_cast<std::size_t>(first)] = blocks->of_triangles;
    of_[static_cast<std::size_t>(first) + 1] = blocks->of_quads;  // quads, or hexahedra
  }
  if (names_.empty()) names_ = {"domain"};
  if (!several()) return;
  std::ranges::transform(of_, cells_.begin(), [&](const auto& of) { return CellsByBlock(of, count()); });
}

PlaneBlocks plane_blocks(const LoadedMesh& whole) {
  PlaneBlocks blocks{whole.block_names, whole.triangle_to_block, whole.quad_to_block};
  for (std::size_t b = blocks.names.size(); std::ssize(blocks.names) < whole.blocks; ++b)
    blocks.names.push_back(usual_block_name(whole.blocks, static_cast<std::int32_t>(b)));
  return blocks;
}

std::vector<std::int64_t> numbers_by_block(const Communicator& comm, const PlaneBlocks& blocks) {
  std::vector<std::int64_t> numbers(blocks.of_triangles.size() + blocks.of_quads.size());
  const auto count = static_cast<std::int32_t>(blocks.names.size());
  const CellsByBlock triangles(blocks.of_triangles, count), quads(blocks.of_quads, count);
  std::int64_t next = 0;
  for (std::int32_t block = 0; block < count; ++block) {
    std::int64_t before = 0;  // this rank's cells of earlier kinds
    for (const CellsByBlock* cells : {&triangles, &quads}) {
      const std::span<const std::int32_t> own = (*cells)[block];
      std::int64_t mine = next + comm.exclusive_sum(std::ssize(own));
      for (const std::int32_t cell : own) numbers[before + cell] = mine++;
      next += comm.sum(std::ssize(own));
      before = std::ssize(blocks.of_triangles);
    }
  }
  return numbers;
}

}  // namespace quadloop::io
