#include "io/vtu/vtu_ranges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "io/files/placed_array.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/model/file_part.hpp"
#include "io/model/plane_part.hpp"
#include "io/stream/vtk_cell.hpp"
#include "io/vtu/vtu_arrays.hpp"
#include "io/vtu/vtu_document.hpp"
#include "io/vtu/vtu_file.hpp"
#include "io/vtu/vtu_names.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"

namespace quadloop::io {

namespace {

constexpr std::size_t largest_head = std::size_t{1} << 26;  // bytes

/// Edges one after another of one boundary, from 0.
struct EdgeRun {
  std::int64_t boundary = 0, edges = 0;
};

class VtuRanges {
 public:
  VtuRanges(const Communicator& comm, const std::string& path) : comm_{comm}, path_{path} {
    comm.together([&] { file_.emplace(path); });
    require_same_size(comm, path, file_->size());
  }

  LoadedMesh read() {
    read_head();
    comm_.together([&] { read_cells(); });
    require_together(comm_.sum(std::ssize(triangles_) + std::ssize(quads_)) > 0);
    std::optional<Field> solution = read_solution();
    FilePart part(comm_, path_, read_points());
    triangles_ = in_even_shares(comm_, std::move(triangles_), 3);
    quads_ = in_even_shares(comm_, std::move(quads_), 4);
    const std::int64_t triangles = comm_.sum(std::ssize(triangles_)) / 3,
                       quads = comm_.sum(std::ssize(quads_)) / 4;
    part.set_blocks({"domain"}, {&triangles, 1}, {&quads, 1});
    part.add_triangles(std::exchange(triangles_, {}));
    part.add_quads(std::exchange(quads_, {}));
    add_boundaries(part);
    LoadedMesh loaded = part.finish(std::move(solution));
    loaded.mesh.strips = std::move(mesh_.strips);
    loaded.mesh.pairs = std::move(mesh_.pairs);
    loaded.mesh.named_nodes = std::move(mesh_.named_nodes);
    complete_plane_part(comm_, loaded, path_);
    return loaded;
  }

 private:
  void require(bool usual) const {
    if (!usual) throw InputError(path_ + ": is not read by ranges");
  }
  void require_together(bool usual) const {
    comm_.together([&] { require(usual); });
  }

  /// The root reads what is before the appended data, for all ranks.
  void read_head() {
    std::vector<char> head;
    comm_.together([&] {
      if (!comm_.is_root()) return;
      constexpr std::size_t piece = std::size_t{1} << 16;
      const auto size = static_cast<std::size_t>(file_->size());
      const auto ends = [&] {
        const std::string_view text(head.data(), head.size());
        const std::size_t tag = text.find("<AppendedData");
        return tag != std::string_view::npos && text.find('_', tag) != std::string_view::npos;
      };
      while (!ends()) {
        const std::size_t before = head.size();
        require(before < std::min(size, largest_head));
        head.resize(std::min(size, before + piece));
        file_->read_at(static_cast<std::int64_t>(before),
                       std::as_writable_bytes(std::span(head).subspan(before)));
      }
    });
    comm_.broadcast(head);
    comm_.together([&] { take_head(std::string(head.begin(), head.end())); });
  }

  void take_head(std::string head) {
    const TextScanner scan(path_, std::move(head), TextScanner::no_comments);
    document_ = parse_vtu(scan);
    require(document_.appended_raw && !document_.compressed && document_.points > 0 && document_.cells > 0);
    const VtuNumbers numbers(scan, document_);
    for (const VtuArray& array : document_.arrays)
      require(array.section == "FieldData" ? array.format == "ascii" : array.format == "appended");
    require(document_.find("FieldData", "boundary_names") != nullptr &&
            document_.find("CellData", "block") == nullptr);
    names_ = read_vtu_names(scan, document_, numbers, mesh_);
    require(names_.blocks.empty());
    for (const VtuArray& array : document_.arrays) {
      const bool nodal = is_nodal_variable(array, names_);
      if (!nodal && !is_cell_variable(array)) continue;
      for (std::size_t k = 0; k < static_cast<std::size_t>(array.components); ++k)
        (nodal ? nodal_ : cell_)
            .push_back({placed(array), name_of_component(scan, array, k), k,
                        static_cast<std::size_t>(array.components), is_third(array, k)});
    }
    points_ = placed(needed("Points", ""));
    connectivity_ = placed(needed("Cells", "connectivity"));
    offsets_ = placed(needed("Cells", "offsets"));
    types_ = placed(needed("Cells", "types"));
    boundary_ = placed(needed("CellData", "boundary"));
    require(points_.count == 3 * document_.points && offsets_.count == document_.cells &&
            types_.count == document_.cells && boundary_.count == document_.cells);
    for (const PlacedArray& array : {connectivity_, offsets_, types_, boundary_})
      require(array.is_of_integers());
  }

  const VtuArray& needed(const std::string& section, const std::string& name) const {
    const auto found = std::ranges::find_if(document_.arrays, [&](const VtuArray& array) {
      return array.section == section && (name.empty() || array.name == name);
    });
    require(found != document_.arrays.end());
    return *found;
  }

  /// The size of the numbers in bytes precedes them.
  PlacedArray placed(const VtuArray& array) const {
    using enum PlacedArray::Number;
    constexpr std::array<std::pair<std::string_view, PlacedArray::Number>, 5> kinds{{{"Float64", real_64},
                                                                                     {"Float32", real_32},
                                                                                     {"Int64", integer_64},
                                                                                     {"Int32", integer_32},
                                                                                     {"UInt8", integer_8}}};
    const auto kind = std::ranges::find(kinds, array.type, [](const auto& entry) { return entry.first; });
    require(kind != kinds.end() && array.offset);
    const std::int64_t header = document_.wide_header ? 8 : 4,
                       begin = static_cast<std::int64_t>(document_.appended_begin) + *array.offset;
    require(*array.offset <= file_->size() && begin + header <= file_->size());
    PlacedArray length{1, begin, document_.wide_header ? integer_64 : integer_32, document_.big_endian};
    std::int64_t bytes = 0;
    read_numbers<std::int64_t>(*file_, length, 0, 1, [&](auto values) { bytes = values[0]; });
    const std::int64_t width = size_of(kind->second);
    require(bytes >= 0 && bytes % width == 0 && bytes <= file_->size() - begin - header);
    return {bytes / width, begin + header, kind->second, document_.big_endian};
  }
  static std::int64_t size_of(PlacedArray::Number number) {
    using enum PlacedArray::Number;
    return number == integer_8 ? 1 : number == real_32 || number == integer_32 ? 4 : 8;
  }

  std::vector<std::int64_t> integers(const PlacedArray& array, std::int64_t first, std::int64_t count) const {
    require(first >= 0 && count >= 0 && first + count <= array.count);
    std::vector<std::int64_t> all;
    all.reserve(count);
    read_numbers<std::int64_t>(*file_, array, first, count, [&](std::span<const std::int64_t> values) {
      all.insert(all.end(), values.begin(), values.end());
    });
    return all;
  }

  /// Reads this rank's share of all cells, with the edges of boundaries.
  void read_cells() {
    const EvenShare share(comm_, document_.cells);
    if (share.size() == 0) return;
    const std::vector<std::int64_t> types = integers(types_, share.begin, share.size()),
                                    boundaries = integers(boundary_, share.begin, share.size()),
                                    ends = integers(offsets_, share.begin, share.size());
    std::int64_t begin = share.begin == 0 ? 0 : integers(offsets_, share.begin - 1, 1)[0];
    const std::int64_t first = begin;
    const std::vector<std::int64_t> nodes = integers(connectivity_, begin, ends.back() - begin);
    for (std::size_t cell = 0; cell < types.size(); begin = ends[cell++]) {
      require(ends[cell] >= begin && ends[cell] <= ends.back());
      add_cell(types[cell], boundaries[cell], std::span(nodes).subspan(begin - first, ends[cell] - begin));
      kinds_.push_back(types[cell]);
    }
    require(share.end < document_.cells || ends.back() == connectivity_.count);
  }

  void add_cell(std::int64_t type, std::int64_t boundary, std::span<const std::int64_t> nodes) {
    const std::size_t width = type == vtk_triangle ? 3 : type == vtk_quad ? 4 : 2;
    require((type == vtk_line || width > 2) && nodes.size() == width);
    std::vector<GlobalNodeId>& to = width == 3 ? triangles_ : width == 4 ? quads_ : edges_;
    for (const std::int64_t node : nodes) {
      require(node >= 0 && node < document_.points);
      to.emplace_back(node);
    }
    if (width > 2) return;
    require(boundary >= 1 && boundary <= std::ssize(names_.boundaries));
    if (runs_.empty() || runs_.back().boundary != boundary - 1) runs_.push_back({boundary - 1, 0});
    ++runs_.back().edges;
  }

  /// All must have one height.
  std::vector<Point> read_points() {
    std::vector<Point> points;
    double low = 0, high = 0;
    comm_.together([&] {
      const EvenShare share(comm_, document_.points);
      points.reserve(share.size());
      std::array<double, 3> p{};
      std::size_t k = 0;
      read_numbers<double>(*file_, points_, 3 * share.begin, 3 * share.size(),
                           [&](std::span<const double> values) {
                             for (const double value : values) {
                               require(std::isfinite(value));
                               p[k] = value;
                               k = (k + 1) % 3;
                               if (k > 0) continue;
                               low = points.empty() ? p[2] : std::min(low, p[2]);
                               high = points.empty() ? p[2] : std::max(high, p[2]);
                               points.push_back({p[0], p[1]});
                             }
                           });
    });
    if (points.empty()) low = std::numeric_limits<double>::infinity();
    if (points.empty()) high = -low;
    require_together(comm_.minimum(low) == comm_.maximum(high));
    return points;
  }

  /// Every rank has the runs of edges of all.
  void add_boundaries(FilePart& part) {
    for (const FileBoundary& boundary : mesh_.boundaries)
      part.add_boundary(boundary.name, {}, boundary.layers);
    std::vector<std::int32_t> entries;
    std::vector<std::int64_t> counts;
    for (const EdgeRun& run : comm_.all_gather_values(std::span<const EdgeRun>(runs_))) {
      entries.push_back(mesh_.boundary_named(names_.boundaries[run.boundary]));
      counts.push_back(run.edges);
    }
    part.set_edges(in_even_shares(comm_, std::move(edges_), 2), entries, counts);
  }

  /// A variable: a component of an array.
  struct Variable {
    PlacedArray array;
    std::string name;
    std::size_t component, components;
    bool is_third;
  };

  /// Returns the values of rows of a variable; they must be finite.
  std::vector<double> column(const Variable& variable, std::int64_t first, std::int64_t rows) const {
    std::vector<double> values;
    values.reserve(rows);
    const auto width = static_cast<std::int64_t>(variable.components);
    std::size_t k = 0;
    read_numbers<double>(*file_, variable.array, first * width, rows * width,
                         [&](std::span<const double> numbers) {
                           for (const double number : numbers) {
                             if (k == variable.component) values.push_back(number);
                             k = (k + 1) % variable.components;
                           }
                         });
    require(std::ranges::all_of(values, [](double value) { return std::isfinite(value); }));
    return values;
  }

  /// Reads columns of `rows` rows over all ranks, without third components that are 0 everywhere.
  std::vector<std::vector<double>> columns(const std::vector<Variable>& variables, std::int64_t rows,
                                           std::vector<std::string>& names) const {
    std::vector<std::vector<double>> all;
    const EvenShare share(comm_, rows);
    for (const Variable& variable : variables) {
      std::vector<double> own;
      comm_.together([&] {
        require(variable.array.count == rows * static_cast<std::int64_t>(variable.components));
        own = column(variable, share.begin, share.size());
      });
      const bool zero = std::ranges::all_of(own, [](double value) { return value == 0; });
      if (variable.is_third && !comm_.any(!zero)) continue;
      names.push_back(variable.name);
      all.push_back(std::move(own));
    }
    return all;
  }

  std::optional<Field> read_solution() {
    Field solution;
    const auto nodal = columns(nodal_, document_.points, solution.names),
               cells = columns(cell_, document_.cells, solution.cells.names);
    if (solution.empty()) return {};
    const EvenShare share(comm_, document_.points);
    for (std::int64_t i = 0; i < share.size(); ++i) {
      for (const std::vector<double>& column : nodal) solution.values.push_back(column[i]);
    }
    for (const std::int64_t kind : {vtk_triangle, vtk_quad}) {
      std::vector<double> rows;
      for (std::size_t cell = 0; cell < kinds_.size(); ++cell) {
        for (const std::vector<double>& column : cells) {
          if (kinds_[cell] == kind) rows.push_back(column[cell]);
        }
      }
      rows = in_even_shares(comm_, std::move(rows), std::ssize(solution.cells.names));
      solution.cells.values.insert(solution.cells.values.end(), rows.begin(), rows.end());
    }
    return solution;
  }

  const Communicator& comm_;
  const std::string& path_;
  std::optional<PlacedInput> file_;
  VtuDocument document_;
  VtuNames names_;
  FileMesh mesh_;  ///< without nodes and cells
  PlacedArray points_, connectivity_, offsets_, types_, boundary_;
  std::vector<Variable> nodal_, cell_;
  // of this rank's share of cells:
  std::vector<std::int64_t> kinds_;
  std::vector<GlobalNodeId> triangles_, quads_, edges_;
  std::vector<EdgeRun> runs_;
};

}  // namespace

LoadedMesh read_vtu_ranges(const Communicator& comm, const std::string& path) {
  return VtuRanges(comm, path).read();
}

}  // namespace quadloop::io
