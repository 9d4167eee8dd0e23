#include "io/cgns/cgns_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "io/files/reading/input_file.hpp"
#include "io/model/file_part.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"

namespace quadloop::io {

namespace {

class CgnsRanges {
 public:
  CgnsRanges(const Communicator& comm, const std::string& path, CgnsContents contents)
      : comm_{comm}, path_{path}, contents_{std::move(contents)} {
    comm.together([&] {
      require(is_consistent());
      file_.emplace(path);
    });
    require_same_size(comm, path, file_->size());
  }

  LoadedMesh read() {
    FilePart part(comm_, path_, points());
    const std::int64_t triangles = sum_of(cells_of(CellKind::triangle)),
                       quads = sum_of(cells_of(CellKind::quad));
    part.set_blocks(contents_.mesh.block_names, {&triangles, 1}, {&quads, 1});
    comm_.together([&] {
      read_cells(CellKind::triangle, [&](auto nodes) { part.add_triangles(nodes); });
      read_cells(CellKind::quad, [&](auto nodes) { part.add_quads(nodes); });
    });
    add_boundaries(part);
    LoadedMesh loaded = part.finish(solution());
    FileMesh& mesh = contents_.mesh;
    loaded.mesh.strips = std::move(mesh.strips);
    loaded.mesh.pairs = std::move(mesh.pairs);
    loaded.mesh.named_nodes = std::move(mesh.named_nodes);
    loaded.warnings = std::move(mesh.warnings);
    for (const std::int64_t node : mesh.periodic_nodes) {
      if (const std::int64_t own = node - loaded.mesh.first_node; own >= 0 && own < loaded.mesh.owned_nodes)
        loaded.periodic_nodes.emplace_back(static_cast<std::int32_t>(own));
    }
    return loaded;
  }

 private:
  void require(bool good) const {
    if (!good) throw InputError(path_ + ": is damaged");
  }

  /// A damaged file may have corrupted the process that read it.
  bool is_consistent() const {
    const auto& [mesh, by_ranges, nodes, coordinates, sections, values, cell_values] = contents_;
    const auto has = [](std::int64_t count) {
      return [count](const CgnsArray& array) { return array.count == count && array.place >= 0; };
    };
    std::int64_t cells = 0;
    for (const CgnsSection& section : sections) {
      if (!has(section.cells * width_of(section.kind))(section.nodes) || !section.nodes.is_of_integers())
        return false;
      cells += section.cells;
    }
    const Field none;
    const Field& solution = mesh.solution ? *mesh.solution : none;
    return nodes > 0 && (coordinates.size() == 2 || coordinates.size() == 3) &&
           mesh.block_names.size() == 1 && refers_to_nodes(mesh, nodes) &&
           std::ranges::all_of(coordinates, has(nodes)) && std::ranges::all_of(values, has(nodes)) &&
           std::ranges::all_of(cell_values, has(cells)) && values.size() == solution.names.size() &&
           cell_values.size() == solution.cells.names.size();
  }

  static std::int64_t width_of(CellKind kind) { return kind == CellKind::triangle ? 3 : 4; }

  /// Returns the numbers of cells of the sections of a kind.
  std::vector<std::int64_t> cells_of(CellKind kind) const {
    std::vector<std::int64_t> cells;
    for (const CgnsSection& section : contents_.sections)
      cells.push_back(section.kind == kind ? section.cells : 0);
    return cells;
  }

  static std::int64_t sum_of(const std::vector<std::int64_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  }

  std::vector<Point> points() {
    std::vector<Point> points;
    comm_.together([&] {
      const EvenShare share(comm_, contents_.nodes);
      points.resize(share.size());
      for (std::size_t k = 0; k < contents_.coordinates.size(); ++k) {
        auto point = points.begin();
        read_numbers<double>(*file_, contents_.coordinates[k], share.begin, share.size(),
                             [&](std::span<const double> values) {
                               for (const double value : values) {
                                 require(k < 2 ? std::isfinite(value) : value == 0);
                                 if (k < 2) (k == 0 ? point->x : point->y) = value;
                                 ++point;
                               }
                             });
      }
    });
    return points;
  }

  /// Passes the nodes of this rank's share of the cells of a kind to `take(nodes)`, piece by piece.
  template <class Take>
  void read_cells(CellKind kind, const Take& take) {
    const std::int64_t width = width_of(kind);
    std::vector<GlobalNodeId> nodes;
    for_share_of_lists(comm_, cells_of(kind), [&](std::size_t s, std::int64_t first, std::int64_t rows) {
      read_numbers<std::int64_t>(*file_, contents_.sections[s].nodes, first * width, rows * width,
                                 [&](std::span<const std::int64_t> numbers) {
                                   for (const std::int64_t number : numbers) {
                                     require(number >= 1 && number <= contents_.nodes);
                                     nodes.emplace_back(number - 1);
                                   }
                                   const std::size_t whole = nodes.size() - nodes.size() % width;
                                   take(std::span<const GlobalNodeId>(nodes).first(whole));
                                   nodes.erase(nodes.begin(),
                                               nodes.begin() + static_cast<std::ptrdiff_t>(whole));
                                 });
    });
  }

  /// Every rank has all edges, and takes its share of them.
  void add_boundaries(FilePart& part) {
    std::vector<FileBoundary>& boundaries = contents_.mesh.boundaries;
    std::vector<std::int64_t> counts;
    std::vector<std::int32_t> entries;
    for (const FileBoundary& boundary : boundaries) {
      part.add_boundary(boundary.name, boundary.condition, boundary.layers);
      entries.push_back(static_cast<std::int32_t>(entries.size()));
      counts.push_back(std::ssize(boundary.faces));
    }
    std::vector<GlobalNodeId> nodes;
    for_share_of_lists(comm_, counts, [&](std::size_t b, std::int64_t first, std::int64_t rows) {
      for (std::int64_t i = first; i < first + rows; ++i) {
        const FileBoundary::Face& edge = boundaries[b].faces[i];
        nodes.insert(nodes.end(), {GlobalNodeId{edge[0]}, GlobalNodeId{edge[1]}});
      }
    });
    part.set_edges(nodes, entries, counts);
  }

  /// Reads the values of rows, from `first`, of all variables, and appends them row by row.
  void append_rows(const std::vector<CgnsArray>& variables, std::int64_t first, std::int64_t rows,
                   std::vector<double>& values) const {
    const std::size_t width = variables.size(), before = values.size();
    values.resize(before + rows * width);
    for (std::size_t k = 0; k < width; ++k) {
      std::size_t at = before + k;
      read_numbers<double>(*file_, variables[k], first, rows, [&](std::span<const double> column) {
        for (const double value : column) {
          values[at] = value;
          at += width;
        }
      });
    }
  }

  std::optional<Field> solution() {
    std::optional<Field> solution = std::move(contents_.mesh.solution);
    if (!solution) return {};
    comm_.together([&] {
      const EvenShare share(comm_, contents_.nodes);
      append_rows(contents_.values, share.begin, share.size(), solution->values);
      for (const CellKind kind : {CellKind::triangle, CellKind::quad}) {
        for_share_of_lists(comm_, cells_of(kind), [&](std::size_t s, std::int64_t first, std::int64_t rows) {
          append_rows(contents_.cell_values, contents_.sections[s].first_row + first, rows,
                      solution->cells.values);
        });
      }
    });
    return solution;
  }

  const Communicator& comm_;
  const std::string& path_;
  CgnsContents contents_;
  std::optional<PlacedInput> file_;
};

}  // namespace

LoadedMesh read_cgns_ranges(const Communicator& comm, const std::string& path, CgnsContents contents) {
  return CgnsRanges(comm, path, std::move(contents)).read();
}

}  // namespace quadloop::io
