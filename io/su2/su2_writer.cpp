#include <span>

#include "io/su2/su2_file.hpp"
#include "io/text/plain_names.hpp"
#include "io/text/text_output.hpp"

namespace quadloop {

namespace {

constexpr int vtk_line = 3, vtk_triangle = 5, vtk_quad = 9;

class Su2Writer {
 public:
  Su2Writer(OutputSet& outputs, const Mesh& mesh, const std::string& path)
      : comm_{outputs.communicator()}, mesh_{mesh}, file_{outputs, path} {}

  void write_mesh() {
    const std::int64_t triangles = total(mesh_.triangles), quads = total(mesh_.quads);
    file_.write("NDIME= 2\nNELEM= " + std::to_string(triangles + quads) + "\n");
    write_elements(vtk_triangle, std::span(mesh_.triangles), 0);
    write_elements(vtk_quad, std::span(mesh_.quads), triangles);
    write_points();
    write_markers();
    file_.close();
  }

 private:
  std::int64_t total(const auto& rows) const { return comm_.sum(std::ssize(rows)); }

  /// Each row ends with its number, counted from `first` over all ranks.
  template <std::size_t width>
  void write_elements(int type, std::span<const std::array<NodeId, width>> rows, std::int64_t first) {
    const std::int64_t number = first + comm_.exclusive_sum(std::ssize(rows));
    file_.write_rows(rows.size(), width + 2, [&](TextRows& text, std::int64_t i) {
      text.put(type, ' ');
      for (const NodeId node : rows[i]) text.put(mesh_.global(node).value(), ' ');
      text.put(number + i, '\n');
    });
  }

  void write_points() {
    file_.write("NPOIN= " + std::to_string(comm_.sum(mesh_.owned_nodes)) + "\n");
    file_.write_rows(mesh_.owned_nodes, 3, [&](TextRows& text, std::int64_t i) {
      text.put(mesh_.points[i].x, ' ');
      text.put(mesh_.points[i].y, ' ');
      text.put(mesh_.first_node + i, '\n');
    });
  }

  void write_markers() {
    const BoundaryStream boundaries(comm_, mesh_);
    std::vector<std::string> own_names;
    for (const BoundaryEdges* boundary : boundaries.present()) own_names.push_back(boundary->name);
    const std::vector<std::string> names = su2_marker_names(own_names);
    file_.write("NMARK= " + std::to_string(names.size()) + "\n");
    file_.write_boundaries(
        boundaries, 3,
        [&](std::size_t n) {
          return "MARKER_TAG= " + names[n] + "\nMARKER_ELEMS= " + std::to_string(boundaries.edges_of(n)) +
                 "\n";
        },
        [](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          text.put(vtk_line, ' ');
          text.put(edge[0], ' ');
          text.put(edge[1], '\n');
        });
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  TextOutput file_;
};

}  // namespace

std::vector<std::string> su2_marker_names(const std::vector<std::string>& boundaries) {
  return plain_names(boundaries);
}

void write_su2(OutputSet& outputs, const Mesh& mesh, const std::string& path) {
  Su2Writer(outputs, mesh, path).write_mesh();
}

void write_su2(const Communicator& comm, const Mesh& mesh, const std::string& path) {
  OutputSet outputs(comm);
  write_su2(outputs, mesh, path);
  outputs.commit();
}

}  // namespace quadloop
