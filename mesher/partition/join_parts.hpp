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

/// The whole mesh assembled from parts, on one rank.
struct JoinedMesh {
  Mesh mesh;
  std::optional<Field> field;
};

/// Size of the whole mesh, with the number of edges of each boundary.
struct WholeCounts {
  std::int32_t nodes = 0, triangles = 0, quads = 0;
  std::vector<std::int32_t> edges;
};

/// Inserts parts one after another into the whole mesh. A node's position and values are those of the part
/// that owns it; its positions in other parts must be bitwise identical.
class PartJoiner {
 public:
  /// `boundaries` are those of the whole mesh, without edges and inner lines; `blocks` its blocks' names.
  PartJoiner(const WholeCounts& counts, std::vector<BoundaryEdges> boundaries,
             std::vector<std::string> blocks);

  /// The first boundaries of the part must be those of the whole mesh; `shown` names the part in messages.
  /// Throws InputError if the part does not fit.
  void put(const MeshPart& part, const std::string& shown);
  /// Throws InputError, which names `shown`, if nodes or cells are missing.
  JoinedMesh finish(const std::string& shown);

 private:
  template <std::size_t width>
  void put_rows(const MeshPart& part, const std::vector<std::array<NodeId, width>>& rows,
                const std::vector<std::int64_t>& places, std::vector<std::array<NodeId, width>>& whole,
                const std::string& shown);
  void put_nodes(const MeshPart& part, const std::string& shown);
  void put_blocks(const MeshPart& part);
  void put_values(const MeshPart& part, const std::string& shown);
  void put_cell_values(const MeshPart& part, CellValues& whole) const;

  JoinedMesh whole_;
  std::vector<char> placed_, owned_;  ///< nodes that are in any part; in the part that owns them
  std::int64_t rows_put_ = 0, rows_ = 0;
  std::int32_t parts_ = 0;
};

}  // namespace quadloop
