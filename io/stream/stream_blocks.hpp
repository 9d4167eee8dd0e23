#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Cells grouped by block, in each block in their order.
class CellsByBlock {
 public:
  CellsByBlock() = default;
  /// `block_of`: the block of each cell, from 0.
  CellsByBlock(std::span<const std::int32_t> block_of, std::int32_t blocks);

  std::span<const std::int32_t> operator[](std::int32_t block) const {
    return std::span(cells_).subspan(first_[block], first_[block + 1] - first_[block]);
  }

 private:
  std::vector<std::int64_t> first_;  ///< for each block its first entry of `cells_`, then their number
  std::vector<std::int32_t> cells_;
};

/// Rows of a stream's cells in one block.
class BlockRows {
 public:
  /// `cells`: cells of the plane, or of the stored mesh; must outlive the object.
  BlockRows(std::span<const std::int32_t> cells, std::int64_t layers)
      : cells_{cells}, size_{std::ssize(cells) * layers}, layers_{layers} {}
  /// All rows, from 0.
  explicit BlockRows(std::int64_t rows) : size_{rows} {}

  std::int64_t size() const { return size_; }
  std::int64_t operator[](std::int64_t i) const {
    return cells_.empty() ? i : cells_[i / layers_] * layers_ + i % layers_;
  }

 private:
  std::span<const std::int32_t> cells_;
  std::int64_t size_;
  std::int64_t layers_ = 1;
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
  /// Returns this rank's cells of a kind in a block, in the stream's order; the object must outlive them.
  template <CellKind kind>
  BlockRows rows(std::int32_t block) const {
    if (!several()) return BlockRows(stream_.cell_rows<kind>());
    return {cells_[static_cast<std::size_t>(kind)][block], layers_};
  }

 private:
  const MeshStream& stream_;
  std::int64_t layers_;  ///< number of rows per block entry; 1 for a stored mesh
  std::vector<std::string> names_;
  /// For the cells of each kind, one entry per `layers_` rows.
  std::array<std::vector<std::int32_t>, cell_kinds> of_;
  std::array<CellsByBlock, cell_kinds> cells_;  ///< if there are several blocks
};

/// Returns the blocks of a whole mesh; unnamed ones are named "block_2", ... by their number.
PlaneBlocks plane_blocks(const LoadedMesh& whole);

/// Returns global numbers, from 0, of this rank's plane cells, triangles, then quads, such that the cells of
/// a block are contiguous: block by block, in each triangles before quads, each in their order. *Collective.*
std::vector<std::int64_t> numbers_by_block(const Communicator& comm, const PlaneBlocks& blocks);

}  // namespace quadloop::io
