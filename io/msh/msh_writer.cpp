#include <algorithm>
#include <span>

#include "io/msh/msh_file.hpp"
#include "io/msh/msh_text.hpp"
#include "io/text/text_output.hpp"

namespace quadloop {

namespace {

std::string quoted(const std::string& name) { return '"' + msh_group_name(name) + '"'; }

/// Groups are numbered 1, 2, ... over curves and surface together, as some readers know them by number alone.
class MshWriter {
 public:
  /// `whole`, where given, is the mesh with its blocks, on one rank.
  MshWriter(OutputSet& outputs, const Mesh& mesh, const std::string& path, const LoadedMesh* whole = nullptr)
      : comm_{outputs.communicator()},
        mesh_{mesh},
        whole_{whole},
        boundaries_{comm_, mesh},
        file_{outputs, path} {}

  void write_mesh() {
    file_.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n");
    write_names();
    write_nodes();
    write_all_elements();
    file_.close();
  }

 private:
  std::int64_t total(const auto& rows) const { return comm_.sum(std::ssize(rows)); }
  std::int32_t blocks() const { return whole_ != nullptr ? whole_->blocks : 1; }
  std::int64_t surface(std::int32_t block) const { return std::ssize(boundaries_.present()) + 1 + block; }
  std::string block_name(std::int32_t block) const {
    const std::size_t b = block;
    if (whole_ != nullptr && b < whole_->block_names.size()) return whole_->block_names[b];
    return blocks() == 1 ? "domain" : "block_" + std::to_string(block + 1);
  }

  void write_names() {
    std::string text = "$PhysicalNames\n" + std::to_string(surface(blocks() - 1)) + "\n";
    std::int64_t group = 0;
    for (const BoundaryEdges* boundary : boundaries_.present())
      text += "1 " + std::to_string(++group) + " " + quoted(boundary->name) + "\n";
    for (std::int32_t block = 0; block < blocks(); ++block)
      text += "2 " + std::to_string(surface(block)) + " " + quoted(block_name(block)) + "\n";
    file_.write(text + "$EndPhysicalNames\n");
  }

  void write_nodes() {
    file_.write("$Nodes\n" + std::to_string(comm_.sum(mesh_.owned_nodes)) + "\n");
    file_.write_rows(mesh_.owned_nodes, 4, [&](TextRows& text, std::int64_t i) {
      text.put(mesh_.first_node + i + 1, ' ');
      text.put(mesh_.points[i].x, ' ');
      text.put(mesh_.points[i].y, ' ');
      text.put(0, '\n');
    });
    file_.write("$EndNodes\n");
  }

  void write_all_elements() {
    const std::int64_t elements = total(mesh_.triangles) + total(mesh_.quads) + boundaries_.all_edges();
    file_.write("$Elements\n" + std::to_string(elements) + "\n");
    write_edges();
    for (std::int32_t block = 0; block < blocks(); ++block) {
      write_elements(msh_triangle, surface(block),
                     cells_of(mesh_.triangles, &LoadedMesh::triangle_to_block, block));
      write_elements(msh_quad, surface(block), cells_of(mesh_.quads, &LoadedMesh::quad_to_block, block));
    }
    file_.write("$EndElements\n");
  }

  template <class Cells>
  std::span<const typename Cells::value_type> cells_of(const Cells& cells,
                                                       std::vector<std::int32_t> LoadedMesh::*cell_to_block,
                                                       std::int32_t block) const {
    if (whole_ == nullptr) return std::span(cells);
    return cells_of_block(cells, whole_->*cell_to_block, block);
  }

  void write_edges() {
    std::int64_t number = next_element_;
    file_.write_boundaries(
        boundaries_, 7, [](std::size_t) { return std::string(); },
        [&](TextRows& text, std::int64_t n, const BoundaryStream::Edge& edge) {
          put_head(text, number++, msh_line, n + 1);
          text.put(edge[0] + 1, ' ');
          text.put(edge[1] + 1, '\n');
        });
    next_element_ += boundaries_.all_edges();
  }

  /// Number, type, two tags: the group, and the curve or surface of the same number. The nodes follow.
  static void put_head(TextRows& text, std::int64_t number, int type, std::int64_t group) {
    text.put(number, ' ');
    text.put(type, ' ');
    text.put(2, ' ');
    text.put(group, ' ');
    text.put(group, ' ');
  }

  template <std::size_t width>
  void write_elements(int type, std::int64_t group, std::span<const std::array<NodeId, width>> rows) {
    const auto own = std::ssize(rows);
    const std::int64_t number = next_element_ + comm_.exclusive_sum(own);
    next_element_ += comm_.sum(own);
    file_.write_rows(rows.size(), 5 + width, [&](TextRows& text, std::int64_t i) {
      put_head(text, number + i, type, group);
      for (std::size_t k = 0; k < width; ++k)
        text.put(mesh_.global(rows[i][k]).value() + 1, k + 1 < width ? ' ' : '\n');
    });
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const LoadedMesh* whole_;
  BoundaryStream boundaries_;
  TextOutput file_;
  std::int64_t next_element_ = 1;
};

}  // namespace

std::string msh_group_name(std::string boundary) {
  for (char& c : boundary) {
    if (c == '"') c = '\'';
    if (c == '\n' || c == '\r') c = ' ';
  }
  return boundary;
}

void write_msh(OutputSet& outputs, const Mesh& mesh, const std::string& path) {
  MshWriter(outputs, mesh, path).write_mesh();
}

void write_msh(OutputSet& outputs, const LoadedMesh& whole, const std::string& path) {
  MshWriter(outputs, whole.mesh, path, &whole).write_mesh();
}

void write_msh(const Communicator& comm, const Mesh& mesh, const std::string& path) {
  OutputSet outputs(comm);
  write_msh(outputs, mesh, path);
  outputs.commit();
}

}  // namespace quadloop
