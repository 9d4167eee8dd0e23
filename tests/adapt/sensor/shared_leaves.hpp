#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "adapt/sensor/recovery/scaled_field.hpp"
#include "adapt/sensor/thresholds.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "mesher/mesh/tree_record.hpp"
#include "tests/mesh/grid_mesh.hpp"

namespace quadloop::test {

/// A leaf with so many cells.
LeafRecord leaf_with(std::int32_t triangles, std::int32_t quads);

/// Leaves for all of a whole mesh's cells, 0 to 3 of each kind in a leaf, as the seed has it.
std::vector<LeafRecord> leaves_of(const Mesh& whole, std::uint64_t seed);

/// The ways in which leaves are shared out here: even, uneven with empty ranks, all on one rank.
enum class Sharing { even, uneven, last_rank };
inline constexpr Sharing all_sharings[] = {Sharing::even, Sharing::uneven, Sharing::last_rank};

/// Where this rank's piece of `count` things begins and ends.
struct Piece {
  std::size_t begin = 0, end = 0;
};
Piece piece_of(std::size_t count, Sharing sharing);

template <class T>
std::vector<T> share_of(const std::vector<T>& all, Sharing sharing) {
  const Piece piece = piece_of(all.size(), sharing);
  return {all.begin() + static_cast<std::ptrdiff_t>(piece.begin),
          all.begin() + static_cast<std::ptrdiff_t>(piece.end)};
}

/// All ranks' values, one after another.
template <class T>
std::vector<T> joined(const Communicator& comm, const std::vector<T>& values) {
  return comm.all_gather_values(std::span<const T>(values));
}

/// A mesh as one rank has it, numbered as its parts are, and this rank's part.
struct Pieces {
  Pieces(const Mesh& mesh, const MeshOrder& order);
  Mesh whole, part;
};

/// This rank's part of a grid in its own order.
Mesh part_of(const Grid& grid);

/// Calls `check(pieces)` for several meshes and orders.
void for_each_distribution(const std::function<void(const Pieces&)>& check);

/// A field by a function of the global node number and the position. Ghosts' values are wrong, which nobody
/// must notice.
Field field_of(const Mesh& mesh, const std::string& name,
               const std::function<double(std::int64_t, Point)>& value);

/// Flags by a rule, as MarkFamily comes to them, and what they follow from.
struct RuledFlags {
  std::vector<adapt::RefinementFlag> flags;  ///< of this rank's share
  adapt::IndicatorStatistics statistics;
  adapt::Thresholds thresholds;
  std::int64_t refined = 0, coarsened = 0;  ///< of all ranks' leaves
};
RuledFlags flags_by(const adapt::ThresholdRule& rule, const Communicator& comm,
                    std::span<const LeafRecord> leaves, std::span<const double> values);

/// The variables of both at the same nodes.
Field joined_fields(const Field& one, const Field& other);

}  // namespace quadloop::test
