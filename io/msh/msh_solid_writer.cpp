#include "io/msh/msh_file.hpp"
#include "io/msh/msh_solid_file.hpp"
#include "io/msh/msh_text.hpp"
#include "io/text/text_output.hpp"

namespace quadloop {

namespace {

template <std::size_t width>
constexpr MshType type_of_cell = width == 4   ? msh_tetrahedron
                                 : width == 5 ? msh_pyramid
                                 : width == 6 ? msh_prism
                                              : msh_hexahedron;
template <std::size_t width>
constexpr MshType type_of_face = width == 3 ? msh_triangle : msh_quad;

/// Groups are numbered 1, 2, ... over patches and the volume together, as write_msh() does.
class MshSolidWriter {
 public:
  MshSolidWriter(const SolidStream& stream, OutputSet& outputs, const std::string& path)
      : stream_{stream}, file_{outputs, path} {}

  void write() {
    write_names();
    write_nodes();
    const std::int64_t elements =
        stream_.counts().cells() + stream_.patch_triangles() + stream_.patch_quads();
    file_.write("$Elements\n" + std::to_string(elements) + "\n");
    write_sides();
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      write_faces<3>(n);
      write_faces<4>(n);
    }
    for_each_kind_of_cell([&]<std::size_t width>() { write_cells<width>(); });
    file_.write("$EndElements\n");
    file_.close();
  }

 private:
  std::int64_t volume() const { return std::ssize(stream_.patches()) + 1; }

  void write_names() {
    std::string text =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" + std::to_string(volume()) + "\n";
    std::int64_t group = 0;
    for (const std::string& name : stream_.patch_names())
      text += "2 " + std::to_string(++group) + " \"" + msh_group_name(name) + "\"\n";
    file_.write(text + "3 " + std::to_string(volume()) + " \"domain\"\n$EndPhysicalNames\n");
  }

  void write_nodes() {
    const std::int64_t first = file_.communicator().exclusive_sum(stream_.point_rows()) + 1;
    file_.write("$Nodes\n" + std::to_string(stream_.counts().nodes) + "\n");
    file_.write_rows(stream_.point_rows(), 4, [&](TextRows& text, std::int64_t i) {
      const Point3 p = stream_.point(i);
      text.put(first + i, ' ');
      text.put(p.x, ' ');
      text.put(p.y, ' ');
      text.put(p.z, '\n');
    });
    file_.write("$EndNodes\n");
  }

  /// Number, type, two tags: the group, and the surface or volume of the same number; the nodes.
  template <std::size_t width>
  static void put_element(TextRows& text, std::int64_t number, int type, std::int64_t group,
                          const std::array<SolidNode, width>& nodes) {
    text.put(number, ' ');
    text.put(type, ' ');
    text.put(2, ' ');
    text.put(group, ' ');
    text.put(group, ' ');
    for (std::size_t k = 0; k < width; ++k) text.put(nodes[k] + 1, k + 1 < width ? ' ' : '\n');
  }

  void write_sides() {
    if (stream_.boundaries() == nullptr) return;
    std::int64_t number = next_;
    file_.write_boundaries(
        *stream_.boundaries(), 9 * stream_.layers(), [](std::size_t) { return std::string(); },
        [&](TextRows& text, std::int64_t n, const BoundaryStream::Edge& edge) {
          for (std::int64_t layer = 0; layer < stream_.layers(); ++layer)
            put_element(text, number++, msh_quad, n + 1, stream_.side(edge, layer));
        });
    next_ += stream_.boundaries()->all_edges() * stream_.layers();
  }

  template <std::size_t width>
  void write_faces(std::size_t patch) {
    write_elements<width>(stream_.face_rows<width>(patch), type_of_face<width>,
                          static_cast<std::int64_t>(patch) + 1,
                          [&](std::int64_t i) { return stream_.face<width>(patch, i); });
  }

  template <std::size_t width>
  void write_cells() {
    write_elements<width>(stream_.cell_rows<width>(), type_of_cell<width>, volume(),
                          [&](std::int64_t i) { return stream_.cell<width>(i); });
  }

  template <std::size_t width, class Nodes>
  void write_elements(std::int64_t rows, int type, std::int64_t group, const Nodes& nodes) {
    const std::int64_t first = next_ + file_.communicator().exclusive_sum(rows);
    next_ += file_.communicator().sum(rows);
    file_.write_rows(rows, 5 + width, [&](TextRows& text, std::int64_t i) {
      put_element(text, first + i, type, group, nodes(i));
    });
  }

  const SolidStream& stream_;
  TextOutput file_;
  std::int64_t next_ = 1;
};

}  // namespace

void write_msh_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path) {
  MshSolidWriter(mesh, outputs, path).write();
}

}  // namespace quadloop
