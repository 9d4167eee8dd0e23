#include <array>
#include <string>
#include <utility>
#include <vector>

#include "io/fluent/fluent_file.hpp"
#include "io/fluent/fluent_zones.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/stream/stream_faces.hpp"
#include "io/text/plain_names.hpp"
#include "io/text/text_output.hpp"

namespace quadloop::io {

namespace {

/// Fluent's numbers of cell kinds.
template <CellKind kind>
constexpr int fluent_kind = kind == CellKind::triangle      ? 1
                            : kind == CellKind::quad        ? 3
                            : kind == CellKind::tetrahedron ? 2
                            : kind == CellKind::pyramid     ? 5
                            : kind == CellKind::prism       ? 6
                                                            : 4;

/// Zones: 1 for the nodes, 2, 3, ... for the cells of each block, then the inner faces, then the patches.
class FluentWriter {
 public:
  FluentWriter(OutputSet& outputs, const MeshStream& stream, const std::string& path)
      : stream_{stream}, blocks_{stream}, file_{outputs, path}, dimension_{stream.is_plane() ? "2" : "3"} {
    require_countable_in_fluent(path, stream.counts().nodes, stream.counts().cells());
    faces_.emplace(stream, StreamFaces::CellNumbers::by_block, path);
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

  void write_nodes() {
    const std::string nodes = fluent_hexadecimal(stream_.counts().nodes);
    file_.write("(0 \"quadloop\")\n(2 " + dimension_ + ")\n(10 (0 1 " + nodes + " 0 " + dimension_ +
                "))\n(10 (1 1 " + nodes + " 1 " + dimension_ + ")(\n");
    file_.write_rows(stream_.point_rows(), 3, [&](TextRows& text, std::int64_t i) {
      const Point3 p = stream_.point(i);
      text.put(p.x, ' ');
      text.put(p.y, stream_.is_plane() ? '\n' : ' ');
      if (!stream_.is_plane()) text.put(p.z, '\n');
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

  /// The normal of a Fluent face points into its first cell; an edge has it on its left. With mixed numbers
  /// of nodes each face starts with its own. Cells are numbered from 0 here, and StreamFaces::no_cell becomes
  /// 0.
  template <class Nodes>
  static void put_face(TextRows& text, bool mixed, const Nodes& nodes, std::int64_t owner,
                       std::int64_t neighbour) {
    const std::size_t count = nodes.size();
    if (mixed) text.put_hexadecimal(static_cast<std::int64_t>(count), ' ');
    for (std::size_t k = 0; k < count; ++k)
      text.put_hexadecimal(nodes[count == 2 ? k : count - 1 - k] + 1, ' ');
    text.put_hexadecimal(owner + 1, ' ');
    text.put_hexadecimal(neighbour + 1, '\n');
  }
  static constexpr std::size_t face_width = 7;  ///< its number of nodes, up to four nodes, two cells

  void write_faces() {
    const std::int64_t inner = faces_->internal();
    file_.write("(13 (0 1 " + fluent_hexadecimal(faces_->all()) + " 0))\n");
    if (inner > 0) {
      file_.write(zone_head(inner_zone(), 1, inner, fluent_interior, stream_.is_plane() ? 2 : 0));
      faces_->write_internal(
          file_, face_width,
          [&](TextRows& text, const auto& nodes, std::int64_t owner, std::int64_t neighbour) {
            put_face(text, !stream_.is_plane(), nodes, owner, neighbour);
          });
      file_.write("))\n");
    }
    std::int64_t next = inner + 1;
    bool is_open = false;
    faces_->write_patches(
        file_, face_width,
        [&](std::size_t n) {
          const std::int64_t first = std::exchange(next, next + stream_.patches()[n].faces());
          return std::string(std::exchange(is_open, true) ? "))\n" : "") +
                 zone_head(zone_of_patch(n), first, next - 1, number_of(n), kind_of(stream_.patches()[n]));
        },
        [&](TextRows& text, std::size_t n, const auto& nodes, std::int64_t owner, std::int64_t neighbour) {
          put_face(text, kind_of(stream_.patches()[n]) == 0, nodes, owner, neighbour);
        });
    if (faces_->all() > inner) file_.write("))\n");
  }

  static std::string zone_head(std::int64_t zone, std::int64_t first, std::int64_t last, std::int64_t type,
                               int kind) {
    return "(13 (" + fluent_hexadecimal(zone) + " " + fluent_hexadecimal(first) + " " +
           fluent_hexadecimal(last) + " " + fluent_hexadecimal(type) + " " + std::to_string(kind) + ")(\n";
  }

  /// Returns the number of nodes of the patch's faces, 0 if it varies.
  static int kind_of(const StreamedPatch& patch) {
    if (patch.edges > 0) return 2;
    return patch.triangles > 0 && patch.quads > 0 ? 0 : patch.triangles > 0 ? 3 : 4;
  }

  BoundaryCondition condition_of(std::size_t n) const { return stream_.patches()[n].condition; }
  /// Whether flow passes through a patch because it has cells on both sides.
  bool is_interior(std::size_t n) const {
    const BoundaryCondition condition = condition_of(n);
    return faces_->is_interface(n) &&
           (condition == BoundaryCondition::none || condition == BoundaryCondition::interface);
  }
  std::int64_t number_of(std::size_t n) const {
    return is_interior(n) ? fluent_interior : fluent_number(condition_of(n));
  }

  void write_names() {
    std::string text;
    const std::vector<std::string> blocks = fluent_zone_names(blocks_.names());
    for (std::int32_t block = 0; block < blocks_.count(); ++block)
      text += fluent_zone_name(2 + block, "fluid", blocks[block]);
    if (faces_->internal() > 0) text += fluent_zone_name(inner_zone(), "interior", fluent_inner_zone);
    const std::vector<std::string> names = fluent_zone_names(stream_.patch_names());
    for (std::size_t n = 0; n < names.size(); ++n)
      text += fluent_zone_name(zone_of_patch(n), is_interior(n) ? "interior" : fluent_word(condition_of(n)),
                               names[n]);
    file_.write(text);
  }

  const MeshStream& stream_;
  const StreamBlocks blocks_;
  TextOutput file_;
  std::string dimension_;
  std::optional<StreamFaces> faces_;
};

}  // namespace

std::vector<std::string> fluent_zone_names(const std::vector<std::string>& names) {
  return plain_names(names);
}

void write_fluent(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  FluentWriter(outputs, mesh, path).write();
}

}  // namespace quadloop::io
