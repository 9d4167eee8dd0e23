#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// Cells that two meshes have in common. Lists are by local cell: triangles, then quads.
struct EqualCells {
  static constexpr std::int32_t none = -1;
  static constexpr std::int32_t elsewhere = -2;

  std::vector<std::int32_t> old_cell;  ///< of each new cell this rank's equal old one, `none` or `elsewhere`
  std::vector<std::int64_t> numbers;   ///< global numbers of those `elsewhere`, in the order of the new cells
  std::vector<char> old_changed;       ///< 1 for each old cell without an equal new one, else 0

  bool is_changed(std::size_t new_cell) const { return old_cell[new_cell] == none; }
};

/// Finds the cells of two meshes whose corners have exactly the same positions. `places` are the positions of
/// the new mesh's nodes, ghosts included. Without `quads`, all quadrilaterals count as changed. Two meshes
/// number their cells along one curve, so most equal cells are found on their own rank without a search; only
/// the others are sent. Independent of the partitions. *Collective.*
EqualCells find_equal_cells(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh,
                            std::span<const Point> places, bool quads = true);

}  // namespace quadloop::adapt
