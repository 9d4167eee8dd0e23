#include <array>
#include <optional>
#include <utility>

#include "io/fluent/fluent_file.hpp"
#include "io/fluent/fluent_zones.hpp"
#include "io/model/cell_faces.hpp"
#include "io/stream/extruded_faces.hpp"
#include "io/stream/held_faces.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/text/text_output.hpp"

namespace quadloop {

namespace {

/// Fluent's numbers for kinds of cells.
template <CellKind kind>
constexpr int fluent_kind = kind == CellKind::triangle      ? 1
                            : kind == CellKind::quad        ? 3
                            : kind == CellKind::tetrahedron ? 2
                            : kind == CellKind::pyramid     ? 5
                            : kind == CellKind::prism       ? 6
                                                            : 4;

/// Zones: 1 the nodes, 2, 3, ... the cells of each block, then the faces inside, then the patches.
class FluentSolidWriter {
 public:
  FluentSolidWriter(OutputSet& outputs, const MeshStream& stream, const std::string& path)
      : stream_{stream}, blocks_{stream}, file_{outputs, path} {
    require_countable_in_fluent(path, stream.counts().nodes, stream.counts().cells());
    if (stream.held() != nullptr) {
      held_.emplace(*stream.held(), path);
      number_held();
    } else {
      const ExtrudedMesh& mesh = *stream.extruded();
      extruded_.emplace(stream.communicator(), mesh,
                        blocks_.several() ? numbers_by_block(stream.communicator(), *mesh.blocks)
                                          : std::vector<std::int64_t>{});
    }
  }

  void write() {
    write_nodes();
    write_cells();
    write_faces();
    write_names();
    file_.close();
  }

 private:
  std::int64_t inner_zone() const { return 2 + blocks_.count(); }
  std::int64_t zone_of_patch(std::size_t n) const { return inner_zone() + 1 + static_cast<std::int64_t>(n); }

  /// Block by block, of each kind after kind.
  void number_held() {
    if (!blocks_.several()) return;
    const std::vector<std::int32_t> block_of = blocks_of_cells(*stream_.held());
    number_.resize(block_of.size());
    std::int64_t next = 0;
    for (std::int32_t block = 0; block < blocks_.count(); ++block) {
      for (std::size_t cell = 0; cell < block_of.size(); ++cell) {
        if (block_of[cell] == block) number_[cell] = next++;
      }
    }
  }
  std::int64_t number(std::int64_t cell) const { return number_.empty() ? cell : number_[cell]; }

  void write_nodes() {
    const std::string nodes = fluent_hexadecimal(stream_.counts().nodes);
    file_.write("(0 \"quadloop\")\n(2 3)\n(10 (0 1 " + nodes + " 0 3))\n(10 (1 1 " + nodes + " 1 3)(\n");
    file_.write_rows(stream_.point_rows(), 3, [&](TextRows& text, std::int64_t i) {
      const Point3 p = stream_.point(i);
      text.put(p.x, ' ');
      text.put(p.y, ' ');
      text.put(p.z, '\n');
    });
    file_.write("))\n");
  }

  /// A zone of several kinds lists the kind of each cell.
  void write_cells() {
    file_.write("(12 (0 1 " + fluent_hexadecimal(stream_.counts().cells()) + " 0))\n");
    std::int64_t first = 1;
    for (std::int32_t block = 0; block < blocks_.count(); ++block) {
      std::int64_t cells = 0;
      int kinds = 0, zone_kind = 0;
      for_each_kind([&]<CellKind kind>() {
        const std::int64_t count = stream_.communicator().sum(blocks_.rows<kind>(block).size());
        if (count == 0) return;
        cells += count;
        zone_kind = ++kinds > 1 ? 0 : fluent_kind<kind>;
      });
      file_.write("(12 (" + fluent_hexadecimal(2 + block) + " " + fluent_hexadecimal(first) + " " +
                  fluent_hexadecimal(first + cells - 1) + " 1 " + std::to_string(zone_kind) + ")");
      if (zone_kind == 0) write_kinds(block);
      file_.write(")\n");
      first += cells;
    }
  }

  void write_kinds(std::int32_t block) {
    file_.write("(\n");
    for_each_kind([&]<CellKind kind>() {
      file_.write_rows(blocks_.rows<kind>(block).size(), 1,
                       [](TextRows& text, std::int64_t) { text.put(fluent_kind<kind>, ' '); });
    });
    file_.write("\n)");
  }

  /// Nodes as seen from outside the owner counter-clockwise: Fluent's face looks into its first cell. Cells
  /// from 0; no neighbour is -1. Where faces have different numbers of nodes each tells its own.
  template <class Nodes>
  static void put_face(TextRows& text, bool mixed, const Nodes& nodes, std::int64_t owner,
                       std::int64_t neighbour) {
    if (mixed) text.put_hexadecimal(static_cast<std::int64_t>(nodes.size()), ' ');
    for (std::size_t k = nodes.size(); k > 0; --k) text.put_hexadecimal(nodes[k - 1] + 1, ' ');
    text.put_hexadecimal(owner + 1, ' ');
    text.put_hexadecimal(neighbour + 1, '\n');
  }
  static constexpr std::size_t face_width = 7;  ///< its count of nodes, four of them, two cells

  void write_faces() {
    const std::int64_t inner = extruded_ ? extruded_->internal() : std::ssize(held_->internal());
    file_.write("(13 (0 1 " + fluent_hexadecimal(inner + stream_.patch_triangles() + stream_.patch_quads()) +
                " 0))\n");
    has_inner_ = inner > 0;
    if (has_inner_) {
      file_.write("(13 (" + fluent_hexadecimal(inner_zone()) + " 1 " + fluent_hexadecimal(inner) + " " +
                  std::to_string(fluent_interior) + " 0)(\n");
      write_inner();
      file_.write("))\n");
    }
    next_face_ = inner + 1;
    if (extruded_) write_sides();
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      if (stream_.patches()[n].faces() == 0) continue;
      file_.write(patch_head(n));
      write_patch(n);
      file_.write("))\n");
    }
  }

  static bool is_mixed(const StreamedPatch& patch) { return patch.triangles > 0 && patch.quads > 0; }

  std::string patch_head(std::size_t n) {
    const StreamedPatch& patch = stream_.patches()[n];
    const std::int64_t first = next_face_;
    next_face_ += patch.faces();
    const int kind = is_mixed(patch) ? 0 : patch.triangles > 0 ? 3 : 4;
    return "(13 (" + fluent_hexadecimal(zone_of_patch(n)) + " " + fluent_hexadecimal(first) + " " +
           fluent_hexadecimal(next_face_ - 1) + " " + fluent_hexadecimal(fluent_number(condition(patch))) +
           " " + std::to_string(kind) + ")(\n";
  }

  /// An interface that has no other side here is no interface there.
  static std::string condition(const StreamedPatch& patch) {
    return patch.condition == "interface" ? "none" : patch.condition;
  }

  template <class Use>
  static void use_held(const FileBoundary::Face& face, const Use& use) {
    if (is_triangle(face)) {
      use(std::array{face[0], face[1], face[2]});
    } else {
      use(face);
    }
  }

  void write_inner() {
    const auto put = [](TextRows& text, const auto& nodes, std::int64_t owner, std::int64_t neighbour) {
      put_face(text, true, nodes, owner, neighbour);
    };
    if (extruded_) return extruded_->write_internal(file_, face_width, put);
    file_.write_rows(std::ssize(held_->internal()), face_width, [&](TextRows& text, std::int64_t i) {
      const HeldFaces::Inner& face = held_->internal()[i];
      use_held(held_->nodes(face),
               [&](const auto& nodes) { put(text, nodes, number(face.owner), number(face.neighbour)); });
    });
  }

  void write_sides() {
    const ExtrudedMesh& mesh = *stream_.extruded();
    bool is_open = false;
    file_.write_boundaries(
        extruded_->sides_with_owners(), face_width * mesh.layers(),
        [&](std::size_t n) {
          return std::string(std::exchange(is_open, true) ? "))\n" : "") + patch_head(n);
        },
        [&](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          const auto [from, to] = ExtrudedFaces::side_nodes(edge);
          for (std::int64_t layer = 0; layer < mesh.layers(); ++layer)
            put_face(text, false, mesh.side(from, to, layer), edge[1] * mesh.layers() + layer, -1);
        });
    if (stream_.side_patches() > 0) file_.write("))\n");
  }

  /// A patch that is none of the sides.
  void write_patch(std::size_t n) {
    const bool mixed = is_mixed(stream_.patches()[n]);
    if (extruded_) {
      const bool front = n > stream_.side_patches();
      extruded_->write_end(file_, face_width, front,
                           [&](TextRows& text, const auto& nodes, std::int64_t owner) {
                             put_face(text, mixed, nodes, owner, -1);
                           });
      return;
    }
    const std::vector<std::int32_t>& cells = held_->cells_at(n);
    file_.write_rows(std::ssize(cells), face_width, [&](TextRows& text, std::int64_t i) {
      use_held(held_->patch_nodes(n, i),
               [&](const auto& nodes) { put_face(text, mixed, nodes, number(cells[i]), -1); });
    });
  }

  void write_names() {
    std::string text;
    const std::vector<std::string> blocks = fluent_zone_names(blocks_.names());
    for (std::int32_t block = 0; block < blocks_.count(); ++block)
      text += fluent_zone_name(2 + block, "fluid", blocks[block]);
    if (has_inner_) text += fluent_zone_name(inner_zone(), "interior", fluent_inner_zone);
    const std::vector<std::string> names = fluent_zone_names(stream_.patch_names());
    for (std::size_t n = 0; n < names.size(); ++n)
      text += fluent_zone_name(zone_of_patch(n), fluent_word(condition(stream_.patches()[n])), names[n]);
    file_.write(text);
  }

  const MeshStream& stream_;
  const StreamBlocks blocks_;
  TextOutput file_;
  std::optional<ExtrudedFaces> extruded_;  ///< this or the next
  std::optional<HeldFaces> held_;
  std::vector<std::int64_t> number_;  ///< of each cell that is held, where there are blocks
  std::int64_t next_face_ = 1;
  bool has_inner_ = false;
};

}  // namespace

void write_fluent_solid(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  FluentSolidWriter(outputs, mesh, path).write();
}

}  // namespace quadloop
