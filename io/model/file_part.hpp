#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/part_builder.hpp"

namespace quadloop::io {

/// Builds a rank's part of a mesh in a file from its even shares of the arrays. Global node numbers
/// are those of the file, from 0. All other arguments are the same on all ranks.
class FilePart {
 public:
  /// `path` is for warnings. *Collective.*
  FilePart(const Communicator& comm, const std::string& path, std::vector<Point> points)
      : comm_{comm}, path_{path}, builder_{comm, std::move(points)} {}

  /// The blocks with their numbers of cells.
  void set_blocks(std::vector<std::string> names, std::span<const std::int64_t> triangles,
                  std::span<const std::int64_t> quads);
  /// Append cells, given by their nodes: three after three, four after four.
  void add_triangles(std::span<const GlobalNodeId> nodes);
  void add_quads(std::span<const GlobalNodeId> nodes);

  void add_boundary(const std::string& name, BoundaryCondition condition, const WallLayers& layers);
  /// Returns the entry of the line's edges, for set_edges().
  std::int32_t add_inner_line(const std::string& name);
  /// The edges of the file are those of several lists, each of a boundary, by its number, or of an inner
  /// line.
  void set_edges(std::span<const GlobalNodeId> nodes, std::span<const std::int32_t> entries,
                 std::span<const std::int64_t> counts);

  /// Adds the strips, pairs, named nodes and inner lines in comments.
  void add_comments(std::string_view comments, std::int64_t nodes);

  /// *Collective.*
  LoadedMesh finish(std::optional<Field> solution);

 private:
  BoundaryEdges& boundary_or_line(std::int32_t entry);
  void add_share(BoundaryEdges line, std::int64_t before, std::int64_t all);

  const Communicator& comm_;
  const std::string& path_;
  PartBuilder builder_;
  LoadedMesh loaded_;
};

}  // namespace quadloop::io
