#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "io/files/binary_output.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/model/file_part.hpp"
#include "io/native/binary_file.hpp"
#include "io/native/binary_header.hpp"
#include "io/text/name_index.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"

namespace quadloop::io {

namespace {

/// Each rank reads its even share of every array.
class BinaryReader {
 public:
  BinaryReader(const Communicator& comm, const std::string& path) : comm_{comm}, path_{path} {
    comm.together([&] { file_.emplace(path); });  // not a pipe, as the size must be known
    require_same_size(comm, path, file_->size());
  }

  LoadedMesh read() {
    comm_.together([&] {
      const std::string head = read_head();
      place_ = std::ssize(head);
      header_ = header_of_text(head, file_->size(), path_);
      require_limits();
    });
    FilePart parts(comm_, path_, read_points());
    if (header_.node_bytes == 4)
      read_connectivity<std::int32_t>(parts);
    else
      read_connectivity<std::int64_t>(parts);
    parts.add_comments(header_.comments, header_.nodes);
    return parts.finish(read_solution());
  }

 private:
  std::string read_head() const {
    constexpr std::string_view says = "header ";
    std::string text(std::min<std::int64_t>(file_->size(), 64), '\0');
    file_->read_at(0, std::as_writable_bytes(std::span(text)));
    const bool is_ours = text.starts_with(binary_first_line);
    const std::size_t second = binary_first_line.size(), end = text.find('\n', second);
    if (!is_ours || end == std::string::npos || !text.substr(second).starts_with(says)) {
      throw InputError(path_ + ": does not begin as a .qmesh file does ('" +
                       std::string(binary_first_line.substr(0, second - 1)) +
                       "', then 'header' and its bytes); it is damaged, or another kind of file");
    }
    const std::size_t begin = std::min(text.find_first_not_of(' ', second + says.size()), end);
    std::int64_t wanted = 0;
    const auto [stopped, error] = std::from_chars(text.data() + begin, text.data() + end, wanted);
    if (error != std::errc{} || stopped != text.data() + end || wanted < std::ssize(text) ||
        wanted > file_->size())
      throw InputError(path_ + ":2: this is not how many bytes the head has; the file is damaged");
    const std::size_t before = text.size();
    text.resize(wanted);
    file_->read_at(static_cast<std::int64_t>(before),
                   std::as_writable_bytes(std::span(text).subspan(before)));
    return text;
  }

  void require_limits() const {
    const std::int64_t most = std::int64_t{std::numeric_limits<std::int32_t>::max()} * comm_.size();
    if (std::max({header_.nodes, header_.triangles(), header_.quads(), header_.edges()}) > most)
      throw InputError(path_ + ": more than 2^31 - 1 nodes, cells or edges cannot be read on one rank");
  }

  /// Reads this rank's share of the next array, of `rows` rows in the file, and goes to its end.
  template <class Row>
  std::vector<Row> read_share(std::int64_t rows) {
    const EvenShare share(comm_, rows);
    std::vector<Row> own(share.size());
    file_->read_at(place_ + share.begin * std::int64_t{sizeof(Row)}, std::as_writable_bytes(std::span(own)));
    place_ += rows * std::int64_t{sizeof(Row)};
    return own;
  }

  /// Reads rows of `width` values.
  std::vector<double> read_reals(std::int64_t rows, std::int64_t width) {
    const EvenShare share(comm_, rows);
    std::vector<double> values(share.size() * width);
    file_->read_at(place_ + share.begin * width * real_bytes, std::as_writable_bytes(std::span(values)));
    place_ += rows * width * real_bytes;
    for (double& value : values) value = in_order<std::endian::little>(value);
    return values;
  }

  static std::size_t first_not_finite(std::span<const double> values) {
    return std::ranges::find_if_not(values, [](double v) { return std::isfinite(v); }) - values.begin();
  }

  std::vector<Point> read_points() {
    std::vector<Point> points;
    comm_.together([&] {
      points = read_share<Point>(header_.nodes);
      const std::int64_t first = EvenShare(comm_, header_.nodes).begin;
      for (std::int64_t i = 0; i < std::ssize(points); ++i) {
        Point& p = points[i];
        p = {in_order<std::endian::little>(p.x), in_order<std::endian::little>(p.y)};
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
          throw InputError(
              fmt::format("{}: node {} lies at ({}, {}), which is not finite", path_, first + i, p.x, p.y));
      }
    });
    return points;
  }

  /// Reads this rank's share of an array of node numbers, and passes the nodes of its rows to `take(nodes)`
  /// piece by piece; `name(row)` names one of its rows in the file. *Collective.*
  template <class Number, std::size_t width, class Name, class Take>
  void read_nodes(std::int64_t count, const Name& name, const Take& take) {
    constexpr std::int64_t rows_of_piece = std::int64_t{1} << 14;
    constexpr std::int64_t row_bytes = width * sizeof(Number);
    comm_.together([&] {
      const EvenShare share(comm_, count);
      std::vector<Number> numbers;
      std::vector<GlobalNodeId> nodes;
      for (std::int64_t row = share.begin; row < share.end; row += rows_of_piece) {
        numbers.resize(width * std::min(rows_of_piece, share.end - row));
        file_->read_at(place_ + row * row_bytes, std::as_writable_bytes(std::span(numbers)));
        nodes.clear();
        for (const Number number : numbers) {
          const std::int64_t node = in_order<std::endian::little>(number);
          if (node < 0 || node >= header_.nodes)
            throw InputError(fmt::format("{}: {} has node {}, which is none of the nodes 0 to {}", path_,
                                         name(row + std::ssize(nodes) / std::int64_t{width}), node,
                                         header_.nodes - 1));
          nodes.emplace_back(node);
        }
        take(std::span<const GlobalNodeId>(nodes));
      }
      place_ += count * row_bytes;
    });
  }

  template <class Number>
  void read_connectivity(FilePart& parts) {
    const auto cell = [](const char* of) {
      return [of](std::int64_t row) { return fmt::format("{} {}", of, row); };
    };
    std::vector<std::string> names;
    std::vector<std::int64_t> triangles, quads;
    for (const auto& block : header_.blocks) {
      names.push_back(block.name);
      triangles.push_back(block.triangles);
      quads.push_back(block.quads);
    }
    parts.set_blocks(std::move(names), triangles, quads);
    read_nodes<Number, 3>(header_.triangles(), cell("triangle"),
                          [&](std::span<const GlobalNodeId> nodes) { parts.add_triangles(nodes); });
    read_nodes<Number, 4>(header_.quads(), cell("quad"),
                          [&](std::span<const GlobalNodeId> nodes) { parts.add_quads(nodes); });
    NameIndex known;
    std::vector<std::int32_t> entries;
    std::vector<std::int64_t> counts;
    for (const auto& [name, condition, edges, layers, inner_line] : header_.boundaries) {
      counts.push_back(edges);
      if (inner_line) {
        entries.push_back(parts.add_inner_line(name));
        continue;
      }
      const auto [index, is_new] = known.entry_of(name);
      if (is_new) parts.add_boundary(name, condition, layers);
      entries.push_back(index);
    }
    std::vector<GlobalNodeId> edges;
    read_nodes<Number, 2>(
        header_.edges(), [&](std::int64_t row) { return edge_name(row); },
        [&](std::span<const GlobalNodeId> nodes) { edges.insert(edges.end(), nodes.begin(), nodes.end()); });
    parts.set_edges(edges, entries, counts);
  }

  /// Returns what a message calls an edge: its number is that in its list.
  std::string edge_name(std::int64_t row) const {
    for (const auto& list : header_.boundaries) {
      if (row < list.edges)
        return fmt::format("{} {}", list.inner_line ? "edge of an inner line" : "boundary edge", row);
      row -= list.edges;
    }
    return {};
  }

  std::optional<Field> read_solution() {
    if (header_.constants == 0 && header_.variables.empty() && header_.cell_variables.empty())
      return std::nullopt;
    Field solution;
    comm_.together([&] {
      solution.constants.resize(header_.constants);
      file_->read_at(place_, std::as_writable_bytes(std::span(solution.constants)));
      place_ += header_.constants * real_bytes;
      for (double& value : solution.constants) value = in_order<std::endian::little>(value);
      if (const std::size_t at = first_not_finite(solution.constants); at < solution.constants.size())
        throw InputError(fmt::format("{}: constant {} is not finite", path_, at));
    });
    solution.names = header_.variables;
    solution.values = read_values(solution.names, header_.nodes, 0, "node");
    solution.cells.names = header_.cell_variables;
    solution.cells.values = read_values(solution.cells.names, header_.triangles(), 0, "cell");
    const std::vector<double> of_quads =
        read_values(solution.cells.names, header_.quads(), header_.triangles(), "cell");
    solution.cells.values.insert(solution.cells.values.end(), of_quads.begin(), of_quads.end());
    return solution;
  }

  /// `before` is added to numbers of rows in messages. *Collective.*
  std::vector<double> read_values(const std::vector<std::string>& names, std::int64_t rows,
                                  std::int64_t before, const char* place) {
    std::vector<double> values;
    comm_.together([&] {
      values = read_reals(rows, std::ssize(names));
      const std::size_t at = first_not_finite(values);
      if (at == values.size()) return;
      const std::int64_t first = before + EvenShare(comm_, rows).begin;
      throw InputError(fmt::format("{}: {} is not finite at {} {}", path_, names[at % names.size()], place,
                                   first + static_cast<std::int64_t>(at / names.size())));
    });
    return values;
  }

  static constexpr std::int64_t real_bytes = sizeof(double);

  const Communicator& comm_;
  const std::string& path_;
  std::optional<PlacedInput> file_;
  std::int64_t place_ = 0;  ///< of the next array
  BinaryHeader header_;
};

}  // namespace

LoadedMesh read_binary(const Communicator& comm, const std::string& path) {
  return BinaryReader(comm, path).read();
}

}  // namespace quadloop::io
