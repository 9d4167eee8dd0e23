#include <algorithm>
#include <span>

#include "io/msh/msh_file.hpp"
#include "io/msh/msh_output.hpp"
#include "io/msh/msh_text.hpp"

namespace quadloop {

namespace {

std::string block_name(const LoadedMesh* whole, std::int32_t blocks, std::int32_t block) {
  const std::size_t b = block;
  if (whole != nullptr && b < whole->block_names.size()) return whole->block_names[b];
  return blocks == 1 ? "domain" : "block_" + std::to_string(block + 1);
}

/// Groups: the boundaries, then the blocks.
std::vector<MshOutputGroup> groups_of(const BoundaryStream& boundaries, const LoadedMesh* whole,
                                      std::int32_t blocks) {
  std::vector<MshOutputGroup> groups;
  for (const BoundaryEdges* boundary : boundaries.present()) groups.push_back({1, boundary->name});
  for (std::int32_t block = 0; block < blocks; ++block)
    groups.push_back({2, block_name(whole, blocks, block)});
  return groups;
}

class MshWriter {
 public:
  /// `whole`, where given, is the mesh with its blocks, on one rank.
  MshWriter(OutputSet& outputs, const Mesh& mesh, const std::string& path, MshVersion version,
            const LoadedMesh* whole = nullptr)
      : mesh_{mesh},
        whole_{whole},
        boundaries_{outputs.communicator(), mesh},
        output_{outputs, path, version, groups_of(boundaries_, whole, blocks())} {}

  void write_mesh() {
    output_.write_nodes(mesh_.owned_nodes, [&](std::int64_t i) {
      return Point3{mesh_.points[i].x, mesh_.points[i].y, 0};
    });
    const std::int64_t edges = boundaries_.all_edges();
    output_.begin_elements(std::ssize(boundaries_.present()) + blocks_of_cells(),
                           edges + total(mesh_.triangles) + total(mesh_.quads));
    output_.write_on_boundaries<2>(boundaries_, msh_line, 1,
                                   [](const BoundaryStream::Edge& edge, std::int64_t) { return edge; });
    for (std::int32_t block = 0; block < blocks(); ++block) {
      write_cells(msh_triangle, block, triangles_of(block));
      write_cells(msh_quad, block, quads_of(block));
    }
    output_.end_elements();
  }

 private:
  std::int64_t total(const auto& rows) const { return output_.communicator().sum(std::ssize(rows)); }
  std::int32_t blocks() const { return whole_ != nullptr ? whole_->blocks : 1; }

  template <class Cells>
  std::span<const typename Cells::value_type> cells_in(const Cells& cells,
                                                       std::vector<std::int32_t> LoadedMesh::*cell_to_block,
                                                       std::int32_t block) const {
    if (whole_ == nullptr) return std::span(cells);
    return cells_of_block(cells, whole_->*cell_to_block, block);
  }

  std::span<const std::array<NodeId, 3>> triangles_of(std::int32_t block) const {
    return cells_in(mesh_.triangles, &LoadedMesh::triangle_to_block, block);
  }
  std::span<const std::array<NodeId, 4>> quads_of(std::int32_t block) const {
    return cells_in(mesh_.quads, &LoadedMesh::quad_to_block, block);
  }

  /// How many kinds of cells there are in all blocks.
  std::int64_t blocks_of_cells() const {
    std::int64_t count = 0;
    for (std::int32_t block = 0; block < blocks(); ++block) {
      if (total(triangles_of(block)) > 0) ++count;
      if (total(quads_of(block)) > 0) ++count;
    }
    return count;
  }

  template <std::size_t width>
  void write_cells(int type, std::int32_t block, std::span<const std::array<NodeId, width>> cells) {
    const std::int64_t group = std::ssize(boundaries_.present()) + 1 + block;
    output_.write_elements<width>(type, group, std::ssize(cells), [&](std::int64_t i) {
      std::array<std::int64_t, width> nodes;
      std::ranges::transform(cells[i], nodes.begin(),
                             [&](NodeId node) { return mesh_.global(node).value(); });
      return nodes;
    });
  }

  const Mesh& mesh_;
  const LoadedMesh* whole_;
  BoundaryStream boundaries_;
  MshOutput output_;
};

}  // namespace

std::string msh_group_name(std::string boundary) {
  for (char& c : boundary) {
    if (c == '"') c = '\'';
    if (c == '\n' || c == '\r') c = ' ';
  }
  return boundary;
}

void write_msh(OutputSet& outputs, const Mesh& mesh, const std::string& path, MshVersion version) {
  MshWriter(outputs, mesh, path, version).write_mesh();
}

void write_msh(OutputSet& outputs, const LoadedMesh& whole, const std::string& path, MshVersion version) {
  MshWriter(outputs, whole.mesh, path, version, &whole).write_mesh();
}

void write_msh(const Communicator& comm, const Mesh& mesh, const std::string& path) {
  OutputSet outputs(comm);
  write_msh(outputs, mesh, path);
  outputs.commit();
}

}  // namespace quadloop
