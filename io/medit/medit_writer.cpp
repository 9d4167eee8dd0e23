#include <charconv>
#include <set>
#include <tuple>

#include "io/medit/medit_file.hpp"
#include "io/text/text_output.hpp"

namespace quadloop {

namespace {

constexpr std::string_view medit_boundary = "boundary_";

/// Of a name "boundary_<reference>"; 0 for any other.
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
  /// `whole`, where given, is the mesh with its blocks, on one rank.
  MeditWriter(OutputSet& outputs, const Mesh& mesh, const std::string& path, const LoadedMesh* whole)
      : comm_{outputs.communicator()}, mesh_{mesh}, whole_{whole}, file_{outputs, path} {}

  void write() {
    file_.write("MeshVersionFormatted 2\nDimension 2\n" + head("Vertices", mesh_.owned_nodes));
    file_.write_rows(mesh_.owned_nodes, 3, [&](TextRows& text, std::int64_t i) {
      text.put(mesh_.points[i].x, ' ');
      text.put(mesh_.points[i].y, ' ');
      text.put(0, '\n');
    });
    write_cells("Triangles", mesh_.triangles, &LoadedMesh::triangle_to_block);
    write_cells("Quadrilaterals", mesh_.quads, &LoadedMesh::quad_to_block);
    write_edges();
    file_.write("End\n");
    file_.close();
  }

 private:
  /// *Collective.*
  std::string head(const std::string& section, std::int64_t rows) const {
    return section + "\n" + std::to_string(comm_.sum(rows)) + "\n";
  }

  template <class Cells>
  void write_cells(const char* section, const Cells& cells,
                   std::vector<std::int32_t> LoadedMesh::*cell_to_block) {
    if (comm_.sum(std::ssize(cells)) == 0) return;
    file_.write(head(section, std::ssize(cells)));
    file_.write_rows(std::ssize(cells), std::tuple_size_v<typename Cells::value_type> + 1,
                     [&](TextRows& text, std::int64_t i) {
                       for (const NodeId node : cells[i]) text.put(mesh_.global(node).value() + 1, ' ');
                       text.put(whole_ == nullptr ? 1 : (whole_->*cell_to_block)[i] + 1, '\n');
                     });
  }

  void write_edges() {
    const BoundaryStream boundaries(comm_, mesh_);
    std::vector<std::string> names;
    for (const BoundaryEdges* boundary : boundaries.present()) names.push_back(boundary->name);
    const std::vector<std::int32_t> references = medit_references(names);
    file_.write("Edges\n" + std::to_string(boundaries.all_edges()) + "\n");
    file_.write_boundaries(
        boundaries, 3, [](std::size_t) { return std::string(); },
        [&](TextRows& text, std::size_t n, const BoundaryStream::Edge& edge) {
          text.put(edge[0] + 1, ' ');
          text.put(edge[1] + 1, ' ');
          text.put(references[n], '\n');
        });
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const LoadedMesh* whole_;
  TextOutput file_;
};

}  // namespace

std::vector<std::string> medit_boundary_names(const std::vector<std::string>& names) {
  std::vector<std::string> read_back;
  for (const std::int32_t reference : medit_references(names))
    read_back.push_back(std::string(medit_boundary) + std::to_string(reference));
  return read_back;
}

void write_medit(OutputSet& outputs, const Mesh& mesh, const std::string& path) {
  MeditWriter(outputs, mesh, path, nullptr).write();
}

void write_medit(OutputSet& outputs, const LoadedMesh& whole, const std::string& path) {
  MeditWriter(outputs, whole.mesh, path, &whole).write();
}

}  // namespace quadloop
