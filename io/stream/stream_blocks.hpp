#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Rows of a stream's cells.
class BlockRows {
 public:
  BlockRows(std::vector<std::int32_t> cells, std::int64_t layers)
      : cells_{std::move(cells)}, layers_{layers} {}

  std::int64_t size() const { return std::ssize(cells_) * layers_; }
  std::int64_t operator[](std::int64_t i) const { return cells_[i / layers_] * layers_ + i % layers_; }

 private:
  std::vector<std::int32_t> cells_;  ///< of the plane, or of the stored mesh
  std::int64_t layers_;
};

/// The blocks of a mesh that is written to a file. A mesh without blocks is one block, "domain".
class StreamBlocks {
 public:
  explicit StreamBlocks(const MeshStream& stream);

  bool several() const { return names_.size() > 1; }
  /// Whether there are several, or one with a name of its own.
  bool are_named() const { return several() || names_[0] != "domain"; }
  const std::vector<std::string>& names() const { return names_; }
  std::int32_t count() const { return static_cast<std::int32_t>(names_.size()); }

  /// Returns the block of a cell, from 0, by its row in the stream.
  template <CellKind kind>
  std::int32_t of(std::int64_t row) const {
    return several() ? of_[static_cast<std::size_t>(kind)][row / layers_] : 0;
  }
  /// Returns this rank's cells of a kind in a block, in the stream's order.
  template <CellKind kind>
  BlockRows rows(std::int32_t block) const {
    std::vector<std::int32_t> cells;
    const std::int64_t all = stream_.cell_rows<kind>() / layers_;
    for (std::int32_t cell = 0; cell < all; ++cell) {
      if (of<kind>(cell * layers_) == block) cells.push_back(cell);
    }
    return {std::move(cells), layers_};
  }

 private:
  const MeshStream& stream_;
  std::int64_t layers_;  ///< number of rows per block entry; 1 for a stored mesh
  std::vector<std::string> names_;
  /// For the cells of each kind, one entry per `layers_` rows.
  std::array<std::vector<std::int32_t>, cell_kinds> of_;
};

/// Returns the blocks of a whole mesh; unnamed ones are named "block_2", ... by their number.
PlaneBlocks plane_blocks(const LoadedMesh& whole);

/// Returns global numbers, from 0, of this rank's plane cells, triangles, then quads, such that the cells of
/// a block are contiguous: block by block, in each triangles before quads, each in their order. *Collective.*
std::vector<std::int64_t> numbers_by_block(const Communicator& comm, const PlaneBlocks& blocks);

}  // namespace quadloop::io
