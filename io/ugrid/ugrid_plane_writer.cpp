#include <vector>

#include "io/text/text_output.hpp"
#include "io/ugrid/ugrid_file.hpp"
#include "io/ugrid/ugrid_plane_file.hpp"

namespace quadloop {

namespace {

class UgridPlaneWriter {
 public:
  UgridPlaneWriter(OutputSet& outputs, const Mesh& mesh, const std::string& path)
      : comm_{outputs.communicator()},
        mesh_{mesh},
        file_{outputs, path},
        names_{outputs, plane_mapbc_path(path)},
        boundaries_{comm_, mesh} {}

  void write() {
    write_names();
    const std::int64_t triangles = comm_.sum(std::ssize(mesh_.triangles)),
                       quads = comm_.sum(std::ssize(mesh_.quads));
    file_.write(std::to_string(comm_.sum(mesh_.owned_nodes)) + " " + std::to_string(triangles) + " " +
                std::to_string(quads) + " 0 0 0 0\n");
    file_.write_rows(mesh_.owned_nodes, 3, [&](TextRows& text, std::int64_t i) {
      text.put(mesh_.points[i].x, ' ');
      text.put(mesh_.points[i].y, ' ');
      text.put(0, '\n');
    });
    write_cells(mesh_.triangles);
    write_cells(mesh_.quads);
    file_.write_root_rows(triangles + quads, 1, [](TextRows& text, std::int64_t) { text.put(1, '\n'); });
    file_.write(std::to_string(boundaries_.all_edges()) + "\n");
    file_.write_boundaries(
        boundaries_, 3, [](std::size_t) { return std::string(); },
        [](TextRows& text, std::size_t n, const BoundaryStream::Edge& edge) {
          text.put(edge[0] + 1, ' ');
          text.put(edge[1] + 1, ' ');
          text.put(n + 1, '\n');
        });
    file_.close();
  }

 private:
  template <std::size_t width>
  void write_cells(const std::vector<std::array<NodeId, width>>& cells) {
    file_.write_rows(std::ssize(cells), width, [&](TextRows& text, std::int64_t i) {
      for (std::size_t k = 0; k < width; ++k)
        text.put(mesh_.global(cells[i][k]).value() + 1, k + 1 < width ? ' ' : '\n');
    });
  }

  void write_names() {
    std::vector<MapbcPatch> patches;
    for (const BoundaryEdges* boundary : boundaries_.present())
      patches.push_back({boundary->name, mapbc_condition(boundary->condition)});
    names_.write(mapbc_text(patches));
    names_.close();
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  TextOutput file_, names_;
  BoundaryStream boundaries_;
};

}  // namespace

void write_ugrid_plane(OutputSet& outputs, const Mesh& mesh, const std::string& path) {
  UgridPlaneWriter(outputs, mesh, path).write();
}

}  // namespace quadloop
