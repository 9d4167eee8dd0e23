#include "io/stream/stream_blocks.hpp"

#include <algorithm>

namespace quadloop::io {

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
}

PlaneBlocks plane_blocks(const LoadedMesh& whole) {
  PlaneBlocks blocks{whole.block_names, whole.triangle_to_block, whole.quad_to_block};
  for (std::size_t b = blocks.names.size(); std::ssize(blocks.names) < whole.blocks; ++b)
    blocks.names.push_back(usual_block_name(whole.blocks, static_cast<std::int32_t>(b)));
  return blocks;
}

std::vector<std::int64_t> numbers_by_block(const Communicator& comm, const PlaneBlocks& blocks) {
  std::vector<std::int64_t> numbers(blocks.of_triangles.size() + blocks.of_quads.size());
  std::int64_t next = 0;
  for (std::int32_t block = 0; block < std::ssize(blocks.names); ++block) {
    auto number = numbers.begin();
    for (const auto* cells : {&blocks.of_triangles, &blocks.of_quads}) {
      const std::int64_t own = std::ranges::count(*cells, block);
      std::int64_t mine = next + comm.exclusive_sum(own);
      for (const std::int32_t of_cell : *cells) {
        if (of_cell == block) *number = mine++;
        ++number;
      }
      next += comm.sum(own);
    }
  }
  return numbers;
}

}  // namespace quadloop::io
