#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Rows of a stream's cells.
class BlockRows {
 public:
  BlockRows(std::vector<std::int32_t> cells, std::int64_t layers)
      : cells_{std::move(cells)}, layers_{layers} {}

  std::int64_t size() const { return std::ssize(cells_) * layers_; }
  std::int64_t operator[](std::int64_t i) const { return cells_[i / layers_] * layers_ + i % layers_; }

 private:
  std::vector<std::int32_t> cells_;  ///< of the plane, or those that are held
  std::int64_t layers_;
};

/// The blocks of a mesh on its way into a file. A mesh that has none is one block, "domain".
class StreamBlocks {
 public:
  explicit StreamBlocks(const MeshStream& stream);

  bool several() const { return names_.size() > 1; }
  /// Whether there are several, or one with a name of its own.
  bool are_named() const { return several() || names_[0] != "domain"; }
  const std::vector<std::string>& names() const { return names_; }
  std::int32_t count() const { return static_cast<std::int32_t>(names_.size()); }

  /// The block of a cell, from 0; the row is one of the stream's.
  template <CellKind kind>
  std::int32_t of(std::int64_t row) const {
    return several() ? of_[static_cast<std::size_t>(kind)][row / layers_] : 0;
  }
  /// This rank's cells of a kind in a block, in the stream's order.
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
  std::int64_t layers_;  ///< rows that are of one block; 1 of a mesh that is held
  std::vector<std::string> names_;
  std::array<std::vector<std::int32_t>, cell_kinds> of_;  ///< of the cells of each kind, one for so many rows
};

/// Those of a whole mesh, named; one that has no name is "block_2", ... by its number.
PlaneBlocks plane_blocks(const LoadedMesh& whole);

/// This rank's cells of the plane, its triangles, then its quads, numbered over all ranks from 0 so that the
/// cells of a block follow each other: block by block, of each triangles before quads, each in their order.
/// *Collective.*
std::vector<std::int64_t> numbers_by_block(const Communicator& comm, const PlaneBlocks& blocks);

}  // namespace quadloop
