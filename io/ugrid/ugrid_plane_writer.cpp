#include <vector>

#include "io/stream/stream_blocks.hpp"
#include "io/text/text_output.hpp"
#include "io/ugrid/ugrid_file.hpp"
#include "io/ugrid/ugrid_plane_file.hpp"

namespace quadloop::io {

namespace {

class UgridPlaneWriter {
 public:
  UgridPlaneWriter(OutputSet& outputs, const MeshStream& stream, const std::string& path)
      : stream_{stream}, blocks_{stream}, file_{outputs, path}, names_{outputs, plane_mapbc_path(path)} {}

  void write() {
    write_names();
    const StreamCounts& all = stream_.counts();
    file_.write(std::to_string(all.nodes) + " " + std::to_string(all.of(CellKind::triangle)) + " " +
                std::to_string(all.of(CellKind::quad)) + " 0 0 0 0\n");
    file_.write_rows(stream_.point_rows(), 3, [&](TextRows& text, std::int64_t i) {
      const Point3 p = stream_.point(i);
      text.put(p.x, ' ');
      text.put(p.y, ' ');
      text.put(0, '\n');
    });
    write_cells<CellKind::triangle>();
    write_cells<CellKind::quad>();
    write_blocks<CellKind::triangle>();
    write_blocks<CellKind::quad>();
    file_.write(std::to_string(stream_.boundaries()->all_edges()) + "\n");
    file_.write_boundaries(
        *stream_.boundaries(), 3, [](std::size_t) { return std::string(); },
        [](TextRows& text, std::size_t n, const BoundaryStream::Edge& edge) {
          text.put(edge[0] + 1, ' ');
          text.put(edge[1] + 1, ' ');
          text.put(n + 1, '\n');
        });
    file_.close();
  }

 private:
  template <CellKind kind>
  void write_cells() {
    file_.write_rows(stream_.cell_rows<kind>(), cell_width<kind>, [&](TextRows& text, std::int64_t i) {
      const auto nodes = stream_.cell<kind>(i);
      for (const NodeNumber& node : nodes) text.put(node + 1, &node < &nodes.back() ? ' ' : '\n');
    });
  }

  template <CellKind kind>
  void write_blocks() {
    file_.write_rows(stream_.cell_rows<kind>(), 1,
                     [&](TextRows& text, std::int64_t i) { text.put(blocks_.of<kind>(i) + 1, '\n'); });
  }

  void write_names() {
    std::vector<MapbcPatch> patches;
    for (const StreamedPatch& patch : stream_.patches())
      patches.push_back({patch.name, mapbc_condition(patch.condition)});
    names_.write(mapbc_text(patches));
    names_.close();
  }

  const MeshStream& stream_;
  const StreamBlocks blocks_;
  TextOutput file_, names_;
};

}  // namespace

void write_ugrid_plane(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  UgridPlaneWriter(outputs, mesh, path).write();
}

}  // namespace quadloop::io
