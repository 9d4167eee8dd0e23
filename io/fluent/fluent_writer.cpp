#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <span>

#include "io/fluent/fluent_file.hpp"
#include "io/fluent/fluent_zones.hpp"
#include "io/stream/require_conforming.hpp"
#include "io/text/plain_names.hpp"
#include "io/text/text_output.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

/// Zones: 1 the nodes, 2, 3, ... the cells of each block, then the faces inside, then the boundaries.
class FluentPlaneWriter {
 public:
  FluentPlaneWriter(OutputSet& outputs, const MeshStream& stream, const std::string& path)
      : comm_{outputs.communicator()},
        mesh_{stream.extruded()->plane},
        whole_{stream.extruded()->blocks},
        file_{outputs, path},
        boundaries_{*stream.boundaries()},
        cells_{edge_cells(comm_, mesh_)},
        triangles_{stream.counts().of(CellKind::triangle)},
        quads_{stream.counts().of(CellKind::quad)},
        in_block_{{.triangles = triangles_, .quads = quads_}} {
    require_countable_in_fluent(path, comm_.sum(mesh_.owned_nodes), triangles_ + quads_);
    if (whole_ != nullptr) number_by_block();
    require_conforming(comm_, mesh_, cells_, std::ssize(between_), path);
  }

  void write() {
    write_nodes();
    write_cells();
    write_faces();
    write_names();
    file_.close();
  }

 private:
  std::int32_t blocks() const { return whole_ != nullptr ? size32(whole_->names) : 1; }
  std::int64_t inner_zone() const { return 2 + blocks(); }

  /// Numbers of cells from 1; those of a block follow each other.
  std::int64_t number(std::int64_t cell) const { return (number_.empty() ? cell : number_[cell]) + 1; }

  /// Also finds the edges between blocks, which are faces of their boundaries.
  void number_by_block() {
    in_block_.assign(blocks(), {});
    for (std::int64_t cell = 0; cell < triangles_ + quads_; ++cell)
      ++(cell < triangles_ ? in_block_[block_of(cell)].triangles : in_block_[block_of(cell)].quads);
    std::vector<std::int64_t> next{0};
    for (const MeshCounts& counts : in_block_) next.push_back(next.back() + counts.triangles + counts.quads);
    number_.resize(triangles_ + quads_);
    for (std::int64_t cell = 0; cell < triangles_ + quads_; ++cell) number_[cell] = next[block_of(cell)]++;
    const EdgeTable table(mesh_);
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      for (const auto& [from, to] : boundary.edges) {
        if (table.cell_left_of(from, to) >= 0 && table.cell_left_of(to, from) >= 0)
          between_.insert(key_of(from, to));
      }
    }
  }
  std::int32_t block_of(std::int64_t cell) const {
    return cell < triangles_ ? whole_->of_triangles[cell] : whole_->of_quads[cell - triangles_];
  }

  void write_nodes() {
    const std::string nodes = fluent_hexadecimal(comm_.sum(mesh_.owned_nodes));
    file_.write("(0 \"quadloop\")\n(2 2)\n(10 (0 1 " + nodes + " 0 2))\n(10 (1 1 " + nodes + " 1 2)(\n");
    file_.write_rows(mesh_.owned_nodes, 2, [&](TextRows& text, std::int64_t i) {
      text.put(mesh_.points[i].x, ' ');
      text.put(mesh_.points[i].y, '\n');
    });
    file_.write("))\n");
  }

  /// A zone of both kinds lists the kind of each cell.
  void write_cells() {
    constexpr int triangle = 1, quad = 3;
    file_.write("(12 (0 1 " + fluent_hexadecimal(triangles_ + quads_) + " 0))\n");
    std::int64_t first = 1;
    for (std::int32_t block = 0; block < blocks(); ++block) {
      const std::int64_t triangles = in_block_[block].triangles, quads = in_block_[block].quads;
      const int kind = quads == 0 ? triangle : triangles == 0 ? quad : 0;
      file_.write("(12 (" + fluent_hexadecimal(2 + block) + " " + fluent_hexadecimal(first) + " " +
                  fluent_hexadecimal(first + triangles + quads - 1) + " 1 " + std::to_string(kind) + ")");
      if (kind == 0) {
        file_.write("(\n");
        file_.write_root_rows(triangles, 1, [](TextRows& text, std::int64_t) { text.put(triangle, ' '); });
        file_.write_root_rows(quads, 1, [](TextRows& text, std::int64_t) { text.put(quad, ' '); });
        file_.write("\n)");
      }
      file_.write(")\n");
      first += triangles + quads;
    }
  }

  static void put_face(TextRows& text, std::int64_t from, std::int64_t to, std::int64_t left,
                       std::int64_t right) {
    text.put_hexadecimal(from + 1, ' ');
    text.put_hexadecimal(to + 1, ' ');
    text.put_hexadecimal(left, ' ');
    text.put_hexadecimal(right, '\n');
  }

  void write_faces() {
    std::int64_t inner = 0;
    std::size_t edge = 0;
    for_each_cell_edge(mesh_, [&](NodeId from, NodeId to, std::int32_t cell) {
      if (cells_.across[edge++] > global(cell) && !is_between(from, to)) ++inner;
    });
    inner = comm_.sum(inner);
    has_inner_ = inner > 0;
    file_.write("(13 (0 1 " + fluent_hexadecimal(inner + boundaries_.all_edges()) + " 0))\n");
    if (has_inner_) {
      file_.write("(13 (" + fluent_hexadecimal(inner_zone()) + " 1 " + fluent_hexadecimal(inner) +
                  " 2 2)(\n");
      write_inner();
      file_.write("))\n");
    }
    write_boundaries(inner + 1);
  }

  static std::pair<std::int32_t, std::int32_t> key_of(NodeId from, NodeId to) {
    return {std::min(from.value(), to.value()), std::max(from.value(), to.value())};
  }
  bool is_between(NodeId from, NodeId to) const {
    return !between_.empty() && between_.contains(key_of(from, to));
  }

  std::int64_t global(std::int64_t cell) const {
    const std::int64_t own = std::ssize(mesh_.triangles);
    return cell < own ? cells_.first_triangle + cell : cells_.first_quad + cell - own;
  }

  /// Each with the cell of the lower number to its left.
  void write_inner() {
    const auto write_of = [&]<std::size_t width>(const std::vector<std::array<NodeId, width>>& cells,
                                                 std::size_t first_edge, std::int64_t first) {
      file_.write_rows(std::ssize(cells), 4 * width, [&](TextRows& text, std::int64_t i) {
        for (std::size_t k = 0; k < width; ++k) {
          const NodeId from = cells[i][k], to = cells[i][(k + 1) % width];
          const std::int64_t across = cells_.across[first_edge + i * width + k];
          if (across > first + i && !is_between(from, to))
            put_face(text, mesh_.global(from).value(), mesh_.global(to).value(), number(first + i),
                     number(across));
        }
      });
    };
    write_of(mesh_.triangles, 0, cells_.first_triangle);
    write_of(mesh_.quads, 3 * mesh_.triangles.size(), cells_.first_quad);
  }

  void write_boundaries(std::int64_t first) {
    bool is_open = false;
    file_.write_boundaries(
        BoundaryStream(comm_, mesh_, packed_edges()), 4,
        [&](std::size_t n) {
          const std::int64_t last = first + boundaries_.edges_of(n) - 1;
          const std::string head = std::string(is_open ? "))\n" : "") + "(13 (" +
                                   fluent_hexadecimal(inner_zone() + 1 + static_cast<std::int64_t>(n)) + " " +
                                   fluent_hexadecimal(first) + " " + fluent_hexadecimal(last) + " " +
                                   fluent_hexadecimal(type_of(n)) + " 2)(\n";
          first = last + 1;
          is_open = true;
          return head;
        },
        [&](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          const auto [from, to] = unpacked(edge[0]);
          const auto [left, right] = unpacked(edge[1]);
          put_face(text, from, to, left, right);
        });
    if (boundaries_.all_edges() > 0) file_.write("))\n");
  }

  /// Two numbers below 2^31 as one, and back.
  static std::int64_t packed(std::int64_t first, std::int64_t second) { return first << 32 | second; }
  static std::array<std::int64_t, 2> unpacked(std::int64_t both) { return {both >> 32, both & 0xffffffff}; }

  /// Of this rank's boundary edges: the two nodes; the numbers of the cells to the left and to the right, 0
  /// for none.
  std::vector<BoundaryStream::Edge> packed_edges() const {
    std::vector<BoundaryStream::Edge> edges;
    const std::optional<EdgeTable> table = between_.empty() ? std::nullopt : std::optional<EdgeTable>(mesh_);
    auto left = cells_.of_boundary.begin();
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      for (const auto& [from, to] : boundary.edges) {
        const std::int32_t right = table ? table->cell_left_of(to, from) : -1;
        edges.push_back({packed(mesh_.global(from).value(), mesh_.global(to).value()),
                         packed(number(*left++), right < 0 ? 0 : number(right))});
      }
    }
    return edges;
  }

  bool is_interface(const BoundaryEdges& boundary) const {
    return !boundary.edges.empty() && is_between(boundary.edges[0][0], boundary.edges[0][1]);
  }
  std::int64_t type_of(std::size_t n) const {
    const BoundaryEdges& boundary = *boundaries_.present()[n];
    return is_interface(boundary) ? fluent_interior : fluent_number(outer_condition(boundary));
  }
  /// An interface that has no other side here is no interface there.
  static std::string outer_condition(const BoundaryEdges& boundary) {
    return boundary.condition == "interface" ? "none" : boundary.condition;
  }

  void write_names() {
    std::vector<std::string> names;
    for (const BoundaryEdges* boundary : boundaries_.present()) names.push_back(boundary->name);
    names = fluent_zone_names(names);
    std::string text;
    const std::vector<std::string> of_blocks = block_names();
    for (std::int32_t block = 0; block < blocks(); ++block)
      text += fluent_zone_name(2 + block, "fluid", of_blocks[block]);
    if (has_inner_) text += fluent_zone_name(inner_zone(), "interior", fluent_inner_zone);
    for (std::size_t n = 0; n < names.size(); ++n) {
      const BoundaryEdges& boundary = *boundaries_.present()[n];
      text += fluent_zone_name(inner_zone() + 1 + static_cast<std::int64_t>(n),
                               fluent_word(is_interface(boundary) ? "interface" : outer_condition(boundary)),
                               names[n]);
    }
    file_.write(text);
  }

  std::vector<std::string> block_names() const {
    if (whole_ == nullptr) return {"domain"};
    return fluent_zone_names(whole_->names);
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const PlaneBlocks* whole_;  ///< null: one; else the only rank has the whole mesh
  TextOutput file_;
  const BoundaryStream& boundaries_;
  EdgeCells cells_;
  std::int64_t triangles_, quads_;  ///< over all ranks
  bool has_inner_ = false;
  std::vector<MeshCounts> in_block_;                         ///< cells of each block
  std::vector<std::int64_t> number_;                         ///< of each cell, where there are blocks
  std::set<std::pair<std::int32_t, std::int32_t>> between_;  ///< edges between blocks
};

}  // namespace

std::vector<std::string> fluent_zone_names(const std::vector<std::string>& names) {
  return plain_names(names);
}

void write_fluent(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  if (!mesh.is_plane()) return write_fluent_solid(outputs, mesh, path);
  FluentPlaneWriter(outputs, mesh, path).write();
}

}  // namespace quadloop
