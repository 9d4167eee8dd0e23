#include <charconv>
#include <set>
#include <tuple>

#include "io/medit/medit_file.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/text/text_output.hpp"

namespace quadloop::io {

namespace {

constexpr std::string_view medit_boundary = "boundary_";

/// Returns the reference of a name "boundary_<reference>"; 0 for any other name.
std::int32_t reference_in(const std::string& name) {
  if (!name.starts_with(medit_boundary)) return 0;
  std::int32_t reference = 0;
  const char* const end = name.data() + name.size();
  const auto [stopped, error] = std::from_chars(name.data() + medit_boundary.size(), end, reference);
  const bool is_plain = name[medit_boundary.size()] != '0';
  return error == std::errc{} && stopped == end && is_plain && reference > 0 ? reference : 0;
}

std::vector<std::int32_t> medit_references(const std::vector<std::string>& names) {
  std::set<std::int32_t> taken;
  for (const std::string& name : names) taken.insert(reference_in(name));
  std::vector<std::int32_t> references;
  std::int32_t next = 1;
  for (const std::string& name : names) {
    if (const std::int32_t own = reference_in(name); own > 0) {
      references.push_back(own);
      continue;
    }
    while (taken.contains(next)) ++next;
    references.push_back(next++);
  }
  return references;
}

class MeditWriter {
 public:
  MeditWriter(OutputSet& outputs, const MeshStream& stream, const std::string& path)
      : stream_{stream}, blocks_{stream}, file_{outputs, path} {}

  void write() {
    file_.write("MeshVersionFormatted 2\nDimension 2\n" + head("Vertices", stream_.counts().nodes));
    file_.write_rows(stream_.point_rows(), 3, [&](TextRows& text, std::int64_t i) {
      const Point3 p = stream_.point(i);
      text.put(p.x, ' ');
      text.put(p.y, ' ');
      text.put(0, '\n');
    });
    write_cells<CellKind::triangle>("Triangles");
    write_cells<CellKind::quad>("Quadrilaterals");
    write_edges();
    file_.write("End\n");
    file_.close();
  }

 private:
  static std::string head(const std::string& section, std::int64_t rows) {
    return section + "\n" + std::to_string(rows) + "\n";
  }

  template <CellKind kind>
  void write_cells(const char* section) {
    if (stream_.counts().of(kind) == 0) return;
    file_.write(head(section, stream_.counts().of(kind)));
    file_.write_rows(stream_.cell_rows<kind>(), cell_width<kind> + 1, [&](TextRows& text, std::int64_t i) {
      for (const NodeNumber node : stream_.cell<kind>(i)) text.put(node + 1, ' ');
      text.put(blocks_.of<kind>(i) + 1, '\n');
    });
  }

  void write_edges() {
    const BoundaryStream& boundaries = *stream_.boundaries();
    const std::vector<std::int32_t> references = medit_references(stream_.patch_names());
    file_.write("Edges\n" + std::to_string(boundaries.all_edges()) + "\n");
    file_.write_boundaries(
        boundaries, 3, [](std::size_t) { return std::string(); },
        [&](TextRows& text, std::size_t n, const BoundaryStream::Edge& edge) {
          text.put(edge[0] + 1, ' ');
          text.put(edge[1] + 1, ' ');
          text.put(references[n], '\n');
        });
  }

  const MeshStream& stream_;
  const StreamBlocks blocks_;
  TextOutput file_;
};

}  // namespace

std::vector<std::string> medit_boundary_names(const std::vector<std::string>& names) {
  std::vector<std::string> read_back;
  for (const std::int32_t reference : medit_references(names))
    read_back.push_back(std::string(medit_boundary) + std::to_string(reference));
  return read_back;
}

void write_medit(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  MeditWriter(outputs, mesh, path).write();
}

}  // namespace quadloop::io
