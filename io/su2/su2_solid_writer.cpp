#include "io/solid/extruded_stream.hpp"
#include "io/su2/su2_file.hpp"
#include "io/su2/su2_solid_file.hpp"
#include "io/text/text_output.hpp"

namespace quadloop {

namespace {

constexpr int vtk_triangle = 5, vtk_quad = 9, vtk_hexahedron = 12, vtk_prism = 13;

template <std::size_t width>
void put_element(TextRows& text, int type, const std::array<SolidNode, width>& nodes) {
  text.put(type, ' ');
  for (std::size_t i = 0; i < width; ++i) text.put(nodes[i], i + 1 < width ? ' ' : '\n');
}

class Su2SolidWriter {
 public:
  Su2SolidWriter(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path)
      : stream_{outputs.communicator(), mesh}, mesh_{mesh}, file_{outputs, path} {}

  void write() {
    file_.write("NDIME= 3\nNELEM= " + std::to_string(stream_.counts().cells()) + "\n");
    file_.write_rows(mesh_.prism_rows(), 7,
                     [&](TextRows& text, std::int64_t i) { put_element(text, vtk_prism, mesh_.prism(i)); });
    file_.write_rows(mesh_.hexahedron_rows(), 9, [&](TextRows& text, std::int64_t i) {
      put_element(text, vtk_hexahedron, mesh_.hexahedron(i));
    });
    write_points();
    write_markers();
    file_.close();
  }

 private:
  void write_points() {
    file_.write("NPOIN= " + std::to_string(stream_.counts().nodes) + "\n");
    file_.write_rows(mesh_.point_rows(), 3, [&](TextRows& text, std::int64_t i) {
      const Point3 p = mesh_.point(i);
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
    file_.write_boundaries(stream_.boundaries(), 5 * mesh_.layers(), head,
                           [&](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
                             for (std::int64_t layer = 0; layer < mesh_.layers(); ++layer) {
                               put_element(text, vtk_quad,
                                           mesh_.side(GlobalNodeId{edge[0]}, GlobalNodeId{edge[1]}, layer));
                             }
                           });
    for (const bool front : {false, true}) {
      file_.write(head(stream_.sides() + (front ? 1 : 0)));
      write_end(vtk_triangle, mesh_.plane.triangles, front);
      write_end(vtk_quad, mesh_.plane.quads, front);
    }
  }

  template <class Cells>
  void write_end(int type, const Cells& cells, bool front) {
    file_.write_rows(std::ssize(cells), 5, [&](TextRows& text, std::int64_t i) {
      put_element(text, type, front ? mesh_.front_face(cells[i]) : mesh_.back_face(cells[i]));
    });
  }

  ExtrudedStream stream_;
  const ExtrudedMesh& mesh_;
  TextOutput file_;
};

}  // namespace

void write_su2_solid(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path) {
  Su2SolidWriter(outputs, mesh, path).write();
}

}  // namespace quadloop
