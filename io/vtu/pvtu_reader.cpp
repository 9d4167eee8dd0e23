#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numeric>
#include <tuple>

#include "io/loaded/foreign_mesh.hpp"
#include "io/vtu/pvtu_file.hpp"
#include "io/vtu/vtu_document.hpp"
#include "io/vtu/vtu_file.hpp"
#include "mesher/mesh/part_names.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

class PvtuReader {
 public:
  explicit PvtuReader(const std::string& path) : scan_{path, TextScanner::no_comments} {
    sources_ = parse_pvtu(scan_);
  }

  /// A single piece is the mesh as it stands.
  LoadedMesh read() {
    const std::filesystem::path folder = std::filesystem::path(scan_.path()).parent_path();
    if (sources_.size() == 1) return read_vtu((folder / sources_.front()).string());
    for (const std::string& source : sources_) add_piece(read_vtu((folder / source).string()), source);
    return united();
  }

 private:
  LoadedMesh united() {
    if (points_.size() > std::numeric_limits<std::int32_t>::max())
      scan_.refuse("its pieces have more than 2^31 - 1 nodes, which cannot be read on one rank");
    unite_nodes();
    drop_cuts();
    of_triangles_.insert(of_triangles_.end(), of_quads_.begin(), of_quads_.end());
    if (!names_.empty() || !cell_names_.empty())
      foreign_.loaded.solution =
          Field{names_, std::move(values_), {}, {cell_names_, std::move(of_triangles_)}};
    drop_repeated(foreign_, scan_.path());
    if (has_strips_)
      foreign_.loaded.warnings.push_back(scan_.path() +
                                         ": what its pieces tell of the layers of wakes and free lines is "
                                         "left out; where there is a .parts file beside it, read that");
    return finish(std::move(foreign_), scan_);
  }

  /// Its nodes after those of the pieces before.
  void add_piece(const LoadedMesh& piece, const std::string& source) {
    const auto first = static_cast<std::int32_t>(points_.size());
    take_solution(piece, source);
    points_.insert(points_.end(), piece.mesh.points.begin(), piece.mesh.points.end());
    const auto moved = [&](auto nodes) {
      for (NodeId& node : nodes) node = NodeId{node.value() + first};
      return nodes;
    };
    const auto block = [&](std::int32_t b) { return foreign_.block_named(piece.block_names[b]); };
    for (std::size_t i = 0; i < piece.mesh.triangles.size(); ++i)
      foreign_.add_triangle(moved(piece.mesh.triangles[i]), block(piece.triangle_to_block[i]));
    for (std::size_t i = 0; i < piece.mesh.quads.size(); ++i)
      foreign_.add_quad(moved(piece.mesh.quads[i]), block(piece.quad_to_block[i]));
    for (const BoundaryEdges& boundary : piece.mesh.boundaries) {
      const std::int32_t number = foreign_.boundary_named(boundary.name);
      foreign_.loaded.mesh.boundaries[number].layers = boundary.layers;
      for (const auto& edge : boundary.edges) foreign_.edges.push_back({moved(edge), number, 0});
    }
    has_strips_ = has_strips_ || !piece.mesh.strips.empty();
    auto& warnings = foreign_.loaded.warnings;
    warnings.insert(warnings.end(), piece.warnings.begin(), piece.warnings.end());
  }

  void take_solution(const LoadedMesh& piece, const std::string& source) {
    const Field solution = piece.solution.value_or(Field{});
    const CellValues& cells = solution.cells;
    if (points_.empty()) {
      names_ = solution.names;
      cell_names_ = cells.names;
    }
    if (solution.names != names_)
      scan_.refuse("the point data of the piece " + source + " are not those of the first piece");
    if (cells.names != cell_names_)
      scan_.refuse("the cell data of the piece " + source + " are not those of the first piece");
    values_.insert(values_.end(), solution.values.begin(), solution.values.end());
    const auto quads = cells.values.begin() + std::ssize(piece.mesh.triangles) * std::ssize(cells.names);
    of_triangles_.insert(of_triangles_.end(), cells.values.begin(), quads);
    of_quads_.insert(of_quads_.end(), quads, cells.values.end());
  }

  /// Of nodes at the same place the first stays, with its values.
  void unite_nodes() {
    std::vector<std::int32_t> order(points_.size()), first_of(points_.size()), new_id(points_.size(), -1);
    std::iota(order.begin(), order.end(), 0);
    const auto place = [&](std::int32_t i) { return std::tuple(points_[i].x, points_[i].y); };
    std::ranges::stable_sort(order, {}, place);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const bool again = k > 0 && place(order[k]) == place(order[k - 1]);
      first_of[order[k]] = again ? first_of[order[k - 1]] : order[k];
    }
    std::vector<Point>& kept = foreign_.loaded.mesh.points;
    const std::size_t width = names_.size();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (first_of[i] != static_cast<std::int32_t>(i)) continue;
      std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                  values_.begin() + static_cast<std::ptrdiff_t>(kept.size() * width));
      new_id[i] = static_cast<std::int32_t>(kept.size());
      kept.push_back(points_[i]);
    }
    values_.resize(kept.size() * width);
    const auto renumber = [&](auto& nodes) {
      for (NodeId& node : nodes) node = NodeId{new_id[first_of[node.value()]]};
    };
    std::ranges::for_each(foreign_.loaded.mesh.triangles, renumber);
    std::ranges::for_each(foreign_.loaded.mesh.quads, renumber);
    std::ranges::for_each(foreign_.edges, [&](ForeignEdge& edge) { renumber(edge.nodes); });
  }

  /// A piece without lines comes with a boundary "boundary" all round, cuts between pieces too; parts for a
  /// solver's ranks with a boundary for each neighbour.
  void drop_cuts() {
    const EdgeTable table(foreign_.loaded.mesh);
    std::erase_if(foreign_.edges, [&](const ForeignEdge& edge) {
      const std::string& name = foreign_.loaded.mesh.boundaries[edge.boundary].name;
      return (name == "boundary" || is_part_name(name)) &&
             table.cell_left_of(edge.nodes[0], edge.nodes[1]) >= 0 &&
             table.cell_left_of(edge.nodes[1], edge.nodes[0]) >= 0;
    });
  }

  TextScanner scan_;
  bool has_strips_ = false;
  std::vector<std::string> sources_;
  ForeignMesh foreign_;
  std::vector<Point> points_;  ///< of all pieces
  std::vector<std::string> names_, cell_names_;
  std::vector<double> values_;                   ///< rows for the points
  std::vector<double> of_triangles_, of_quads_;  ///< rows for the cells
};

}  // namespace

LoadedMesh read_pvtu(const std::string& path) { return PvtuReader(path).read(); }

}  // namespace quadloop
