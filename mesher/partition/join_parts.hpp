#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/partition/mesh_part.hpp"

namespace quadloop {

/// The whole mesh that parts are put into, on one rank.
struct JoinedMesh {
  Mesh mesh;
  std::vector<std::int32_t> triangle_to_block, quad_to_block;
  std::optional<Field> field;
};

/// What the whole has; its boundaries by name, with the number of edges of each.
struct WholeCounts {
  std::int32_t nodes = 0, triangles = 0, quads = 0;
  std::vector<std::int32_t> edges;
};

/// Puts parts, one after another, into their places in the whole. A node's position and values are those of
/// the part that owns it; its other parts must have it at the same place, to the bit.
class PartJoiner {
 public:
  /// `boundaries` are the whole's, without their edges.
  PartJoiner(const WholeCounts& counts, std::vector<BoundaryEdges> boundaries);

  /// The part's first boundaries are the whole's; `shown` names it in messages. Throws InputError where it
  /// does not fit.
  void put(const MeshPart& part, const std::string& shown);
  /// Throws InputError, which names `shown`, where places are left empty.
  JoinedMesh finish(const std::string& shown);

 private:
  template <std::size_t width>
  void put_rows(const MeshPart& part, const std::vector<std::array<NodeId, width>>& rows,
                const std::vector<std::int64_t>& places, std::vector<std::array<NodeId, width>>& whole,
                const std::string& shown);
  void put_nodes(const MeshPart& part, const std::string& shown);
  void put_values(const MeshPart& part, const std::string& shown);
  void put_cell_values(const MeshPart& part, CellValues& whole) const;

  JoinedMesh whole_;
  std::vector<char> placed_, owned_;  ///< nodes: of any part; of the one that owns it
  std::int64_t rows_put_ = 0, rows_ = 0;
  std::int32_t parts_ = 0;
};

}  // namespace quadloop
