#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <numeric>
#include <tuple>

#include "io/solid/block_collector.hpp"
#include "io/text/text_scanner.hpp"
#include "io/vtu/pvtu_solid_file.hpp"
#include "io/vtu/vtu_document.hpp"
#include "io/vtu/vtu_solid_file.hpp"

namespace quadloop {

namespace {

/// Which of the rows have the nodes, in any order, of an earlier one.
template <class Row>
std::vector<char> repeated(std::vector<Row> rows) {
  for (Row& row : rows) std::ranges::sort(row);
  std::vector<std::int32_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::int32_t i) { return rows[i]; });
  std::vector<char> is_repeated(rows.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k)
    is_repeated[order[k]] = rows[order[k]] == rows[order[k - 1]] ? 1 : 0;
  return is_repeated;
}

class PvtuSolidReader {
 public:
  explicit PvtuSolidReader(const std::string& path) : scan_{path, TextScanner::no_comments} {
    sources_ = parse_pvtu(scan_);
  }

  std::optional<SolidMesh> read() {
    const std::filesystem::path folder = std::filesystem::path(scan_.path()).parent_path();
    for (const std::string& source : sources_) {
      std::optional<SolidMesh> piece = read_vtu_solid((folder / source).string());
      if (!piece && &source == &sources_.front()) return std::nullopt;
      if (sources_.size() == 1) return piece;
      if (!piece) scan_.refuse("the piece " + source + " is no 3D mesh, as the first is");
      add(*piece, source);
    }
    if (whole_.points.size() > std::numeric_limits<std::int32_t>::max())
      scan_.refuse("its pieces have more than 2^31 - 1 nodes, which cannot be read on one rank");
    unite_nodes();
    drop_repeated();
    blocks_.put_into(whole_);
    if (!names_.empty() || !cell_names_.empty())
      whole_.solution = Field{names_, std::move(values_), {}, {cell_names_, std::move(of_all_cells_)}};
    return std::move(whole_);
  }

 private:
  /// Its nodes after those of the pieces before.
  void add(const SolidMesh& piece, const std::string& source) {
    take_solution(piece, source);
    const auto first = static_cast<std::int32_t>(whole_.points.size());
    const auto moved = [&](auto nodes) {
      for (std::int32_t& node : nodes) node += node == SolidPatch::no_node ? 0 : first;
      return nodes;
    };
    whole_.points.insert(whole_.points.end(), piece.points.begin(), piece.points.end());
    for_each_kind_of_cell([&]<std::size_t width>() {
      for (const auto& cell : cells_of<width>(piece)) cells_of<width>(whole_).push_back(moved(cell));
    });
    take_blocks(piece);
    for (const SolidPatch& patch : piece.patches) {
      auto found = std::ranges::find(whole_.patches, patch.name, &SolidPatch::name);
      if (found == whole_.patches.end())
        found = whole_.patches.insert(found, {patch.name, patch.condition, {}});
      for (const SolidPatch::Face& face : patch.faces) found->faces.push_back(moved(face));
    }
    whole_.warnings.insert(whole_.warnings.end(), piece.warnings.begin(), piece.warnings.end());
  }

  /// A piece of one block does not say of which.
  void take_blocks(const SolidMesh& piece) {
    for (const std::string& name : piece.block_names) blocks_.named(name);
    auto next = piece.cell_to_block.begin();
    for_each_kind_of_cell([&]<std::size_t width>() {
      std::vector<std::int32_t>& blocks = blocks_.of<width>();
      for (std::size_t i = 0; i < cells_of<width>(piece).size(); ++i)
        blocks.push_back(blocks_.named(piece.block_names.empty() ? "domain" : piece.block_names[*next++]));
    });
  }

  void take_solution(const SolidMesh& piece, const std::string& source) {
    const Field solution = piece.solution.value_or(Field{});
    if (whole_.points.empty()) {
      names_ = solution.names;
      cell_names_ = solution.cells.names;
    }
    if (solution.names != names_)
      scan_.refuse("the point data of the piece " + source + " are not those of the first piece");
    if (solution.cells.names != cell_names_)
      scan_.refuse("the cell data of the piece " + source + " are not those of the first piece");
    values_.insert(values_.end(), solution.values.begin(), solution.values.end());
    auto row = solution.cells.values.begin();
    for_each_kind_of_cell([&]<std::size_t width>() {
      const auto end = row + std::ssize(cells_of<width>(piece)) * std::ssize(cell_names_);
      of_cells_[width].insert(of_cells_[width].end(), row, end);
      row = end;
    });
  }

  /// Of nodes at the same place the first stays, with its values.
  void unite_nodes() {
    std::vector<Point3>& points = whole_.points;
    std::vector<std::int32_t> order(points.size()), first_of(points.size()), new_id(points.size(), -1);
    std::iota(order.begin(), order.end(), 0);
    const auto place = [&](std::int32_t i) { return std::tuple(points[i].x, points[i].y, points[i].z); };
    std::ranges::stable_sort(order, {}, place);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const bool again = k > 0 && place(order[k]) == place(order[k - 1]);
      first_of[order[k]] = again ? first_of[order[k - 1]] : order[k];
    }
    const auto width = std::ssize(names_);
    std::int32_t kept = 0;
    for (std::int32_t i = 0; i < std::ssize(points); ++i) {
      if (first_of[i] != i) continue;
      std::copy_n(values_.begin() + i * width, width, values_.begin() + kept * width);
      points[kept] = points[i];
      new_id[i] = kept++;
    }
    points.resize(kept);
    values_.resize(kept * width);
    const auto renumber = [&](auto& rows) {
      for (auto& nodes : rows) {
        for (std::int32_t& node : nodes) node = node == SolidPatch::no_node ? node : new_id[first_of[node]];
      }
    };
    for_each_kind_of_cell([&]<std::size_t of>() { renumber(cells_of<of>(whole_)); });
    for (SolidPatch& patch : whole_.patches) renumber(patch.faces);
  }

  /// The first of each stays; cells with their values.
  void drop_repeated() {
    const std::size_t width = cell_names_.size();
    const auto drop = [](auto& rows, const std::vector<char>& flags) {
      std::size_t i = 0;
      std::erase_if(rows, [&](const auto&) { return flags[i++] != 0; });
    };
    for_each_kind_of_cell([&]<std::size_t nodes>() {
      const std::vector<char> flags = repeated(cells_of<nodes>(whole_));
      for (std::size_t cell = 0; cell < flags.size(); ++cell) {
        const auto row = of_cells_[nodes].begin() + static_cast<std::ptrdiff_t>(cell * width);
        if (flags[cell] == 0)
          of_all_cells_.insert(of_all_cells_.end(), row, row + static_cast<std::ptrdiff_t>(width));
      }
      drop(cells_of<nodes>(whole_), flags);
      drop(blocks_.of<nodes>(), flags);
    });
    for (SolidPatch& patch : whole_.patches) drop(patch.faces, repeated(patch.faces));
  }

  TextScanner scan_;
  std::vector<std::string> sources_;
  SolidMesh whole_;
  BlockCollector blocks_;
  std::vector<std::string> names_, cell_names_;
  std::vector<double> values_;                   ///< rows for the points
  std::array<std::vector<double>, 9> of_cells_;  ///< rows for cells of so many nodes, of all pieces
  std::vector<double> of_all_cells_;             ///< of those that stay, kind after kind
};

}  // namespace

std::optional<SolidMesh> read_pvtu_solid(const std::string& path) { return PvtuSolidReader(path).read(); }

}  // namespace quadloop
