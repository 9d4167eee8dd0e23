#include "io/solid/solid_stream.hpp"
#include "io/solid/vtk_cell.hpp"
#include "io/su2/su2_file.hpp"
#include "io/text/text_output.hpp"

namespace quadloop {

namespace {

/// VTK's numbers of kinds of cells, by how many nodes they have.
template <std::size_t width>
constexpr int su2_solid = width == 4   ? vtk_tetrahedron
                          : width == 5 ? vtk_pyramid
                          : width == 6 ? vtk_wedge
                                       : vtk_hexahedron;
template <std::size_t width>
constexpr int vtk_face = width == 3 ? vtk_triangle : vtk_quad;

/// That of VTK (the faces of SU2's CPrism).
template <std::size_t width>
std::array<SolidNode, width> in_su2_order(const std::array<SolidNode, width>& cell) {
  if constexpr (width == 6) return vtk_wedge_order(cell);
  return cell;
}

template <std::size_t width>
void put_element(TextRows& text, int type, const std::array<SolidNode, width>& nodes) {
  text.put(type, ' ');
  for (std::size_t i = 0; i < width; ++i) text.put(nodes[i], i + 1 < width ? ' ' : '\n');
}

class Su2SolidWriter {
 public:
  Su2SolidWriter(const SolidStream& stream, OutputSet& outputs, const std::string& path)
      : stream_{stream}, file_{outputs, path} {}

  void write() {
    file_.write("NDIME= 3\nNELEM= " + std::to_string(stream_.counts().cells()) + "\n");
    for_each_kind_of_cell([&]<std::size_t width>() {
      file_.write_rows(stream_.cell_rows<width>(), width + 1, [&](TextRows& text, std::int64_t i) {
        put_element(text, su2_solid<width>, in_su2_order(stream_.cell<width>(i)));
      });
    });
    write_points();
    write_markers();
    file_.close();
  }

 private:
  void write_points() {
    file_.write("NPOIN= " + std::to_string(stream_.counts().nodes) + "\n");
    file_.write_rows(stream_.point_rows(), 3, [&](TextRows& text, std::int64_t i) {
      const Point3 p = stream_.point(i);
      text.put(p.x, ' ');
      text.put(p.y, ' ');
      text.put(p.z, '\n');
    });
  }

  void write_markers() {
    const std::vector<std::string> names = su2_marker_names(stream_.patch_names());
    const auto head = [&](std::size_t n) {
      return "MARKER_TAG= " + names[n] + "\nMARKER_ELEMS= " + std::to_string(stream_.patches()[n].faces()) +
             "\n";
    };
    file_.write("NMARK= " + std::to_string(names.size()) + "\n");
    if (stream_.boundaries() != nullptr)
      file_.write_boundaries(*stream_.boundaries(), 5 * stream_.layers(), head,
                             [&](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
                               for (std::int64_t layer = 0; layer < stream_.layers(); ++layer)
                                 put_element(text, vtk_face<4>, stream_.side(edge, layer));
                             });
    for (std::size_t n = stream_.side_patches(); n < names.size(); ++n) {
      file_.write(head(n));
      write_faces<3>(n);
      write_faces<4>(n);
    }
  }

  template <std::size_t width>
  void write_faces(std::size_t patch) {
    file_.write_rows(stream_.face_rows<width>(patch), width + 1, [&](TextRows& text, std::int64_t i) {
      put_element(text, vtk_face<width>, stream_.face<width>(patch, i));
    });
  }

  const SolidStream& stream_;
  TextOutput file_;
};

}  // namespace

void write_su2_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path) {
  Su2SolidWriter(mesh, outputs, path).write();
}

}  // namespace quadloop
