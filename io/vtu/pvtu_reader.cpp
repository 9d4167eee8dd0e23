#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <tuple>
#include <utility>
#include <variant>

#include "io/model/cell_faces.hpp"
#include "io/model/clean_up.hpp"
#include "io/model/repeated_rows.hpp"
#include "io/vtu/pvtu_file.hpp"
#include "io/vtu/vtu_document.hpp"
#include "io/vtu/vtu_file.hpp"
#include "mesher/mesh/part_names.hpp"

namespace quadloop::io {

namespace {

using Face = FileBoundary::Face;

/// Calls `visit(face)` for the faces of a cell.
template <CellKind kind, class Nodes, class Visit>
void for_each_face_of(const Nodes& nodes, const Visit& visit) {
  constexpr std::size_t width = std::tuple_size_v<Nodes>;
  if constexpr (kind == CellKind::triangle || kind == CellKind::quad) {
    for (std::size_t k = 0; k < width; ++k)
      visit(Face{nodes[k], nodes[(k + 1) % width], FileBoundary::no_node, FileBoundary::no_node});
  } else {
    for (const LocalFace& local : CellFaces<width>::faces) visit(face_of(nodes, local));
  }
}

Face sorted(Face face) {
  std::ranges::sort(face);
  return face;
}

/// Returns the faces of all cells, edges in a plane mesh, each with its nodes sorted. Faces between two cells
/// occur twice, consecutively; a cell in several pieces counts once.
std::vector<Face> sorted_faces(const FileMesh& mesh) {
  std::vector<Face> faces;
  for_each_kind([&]<CellKind kind>() {
    const auto& cells = cells_of<kind>(mesh);
    const auto kept = kept_rows(
        cells, [](const auto& nodes) { return nodes; }, [](std::size_t) { return 0; });
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (kept[i] == i) for_each_face_of<kind>(cells[i], [&](const Face& f) { faces.push_back(sorted(f)); });
    }
  });
  std::ranges::sort(faces);
  return faces;
}

class PvtuReader {
 public:
  explicit PvtuReader(const std::string& path) : scan_{path, TextScanner::no_comments} {
    sources_ = parse_pvtu(scan_);
  }

  /// A single piece is returned unchanged.
  MeshOfFile read() {
    const std::filesystem::path folder = std::filesystem::path(scan_.path()).parent_path();
    for (const std::string& source : sources_) {
      MeshOfFile piece = read_vtu((folder / source).string());
      if (sources_.size() == 1) return piece;
      const LoadedMesh* plane = std::get_if<LoadedMesh>(&piece);
      add(plane != nullptr ? file_mesh_of(*plane) : std::get<FileMesh>(std::move(piece)), source);
    }
    return united();
  }

 private:
  MeshOfFile united() {
    if (whole_.points.size() > std::numeric_limits<std::int32_t>::max())
      scan_.refuse("its pieces have more than 2^31 - 1 nodes, which cannot be read on one rank");
    put_solution();
    unite_nodes(whole_);
    drop_cuts();
    drop_repeated(whole_, scan_.path());
    if (has_strips_)
      whole_.warnings.push_back(scan_.path() +
                                ": the layers of wakes and layer lines described in its pieces are ignored; "
                                "if there is a .parts file beside it, read that instead");
    if (whole_.dimension == 2) return plane_mesh(std::move(whole_), scan_);
    drop_empty_groups(whole_);
    return std::move(whole_);
  }

  /// Appends a piece, with its nodes after those of the previous pieces.
  void add(const FileMesh& piece, const std::string& source) {
    if (whole_.points.empty()) whole_.dimension = piece.dimension;
    if (piece.dimension != whole_.dimension)
      scan_.refuse("the piece " + source + " is of other dimensions than the first");
    take_solution(piece, source);
    const auto first = static_cast<std::int32_t>(whole_.points.size());
    const auto moved = [&](auto nodes) {
      for (std::int32_t& node : nodes) node += node == FileBoundary::no_node ? 0 : first;
      return nodes;
    };
    whole_.points.insert(whole_.points.end(), piece.points.begin(), piece.points.end());
    for_each_kind([&]<CellKind kind>() {
      const auto& blocks = piece.cell_to_block[static_cast<std::size_t>(kind)];
      const auto& cells = cells_of<kind>(piece);
      for (std::size_t i = 0; i < cells.size(); ++i)
        add_cell<kind>(whole_, moved(cells[i]), whole_.block_named(piece.block_names[blocks[i]]));
    });
    for (const FileBoundary& boundary : piece.boundaries) {
      FileBoundary& own = whole_.boundaries[whole_.boundary_named(boundary.name)];
      own.layers = boundary.layers;
      for (const Face& face : boundary.faces) own.faces.push_back(moved(face));
    }
    for (const NamedNode& named : piece.named_nodes)
      whole_.named_nodes.push_back({named.name, GlobalNodeId{named.node.value() + first}});
    has_strips_ = has_strips_ || !piece.strips.empty();
    whole_.warnings.insert(whole_.warnings.end(), piece.warnings.begin(), piece.warnings.end());
  }

  void take_solution(const FileMesh& piece, const std::string& source) {
    const Field solution = piece.solution.value_or(Field{});
    const CellValues& cells = solution.cells;
    if (whole_.points.empty()) {
      solution_.names = solution.names;
      solution_.cells.names = cells.names;
    }
    if (solution.names != solution_.names)
      scan_.refuse("the point data of the piece " + source + " are not those of the first piece");
    if (cells.names != solution_.cells.names)
      scan_.refuse("the cell data of the piece " + source + " are not those of the first piece");
    solution_.values.insert(solution_.values.end(), solution.values.begin(), solution.values.end());
    auto row = cells.values.begin();
    for_each_kind([&]<CellKind kind>() {
      const auto end = row + std::ssize(cells_of<kind>(piece)) * std::ssize(cells.names);
      auto& values = values_of_kind_[static_cast<std::size_t>(kind)];
      values.insert(values.end(), row, end);
      row = end;
    });
  }

  void put_solution() {
    if (solution_.empty()) return;
    for (const std::vector<double>& values : values_of_kind_)
      solution_.cells.values.insert(solution_.cells.values.end(), values.begin(), values.end());
    whole_.solution = std::move(solution_);
  }

  /// Removes cuts between pieces: a plane piece without lines has a boundary "boundary" all around, and
  /// partitions for a solver's ranks have a boundary for each neighbour.
  void drop_cuts() {
    const auto may_be_cut = [](const FileBoundary& boundary) {
      return boundary.name == "boundary" || is_part_name(boundary.name);
    };
    if (std::ranges::none_of(whole_.boundaries, may_be_cut)) return;
    const std::vector<Face> faces = sorted_faces(whole_);
    for (FileBoundary& boundary : whole_.boundaries) {
      if (!may_be_cut(boundary)) continue;
      std::erase_if(boundary.faces, [&](const Face& face) {
        const auto [begin, end] = std::ranges::equal_range(faces, sorted(face));
        return end - begin > 1;
      });
    }
  }

  TextScanner scan_;
  bool has_strips_ = false;
  std::vector<std::string> sources_;
  FileMesh whole_;
  Field solution_;                                              ///< of all pieces, without cell rows
  std::array<std::vector<double>, cell_kinds> values_of_kind_;  ///< cell rows
};

}  // namespace

MeshOfFile read_pvtu(const std::string& path) { return PvtuReader(path).read(); }

}  // namespace quadloop::io
