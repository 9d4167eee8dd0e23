#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>

#include "io/files/binary_output.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/model/node_text.hpp"
#include "io/model/pair_text.hpp"
#include "io/model/strip_text.hpp"
#include "io/native/binary_file.hpp"
#include "io/native/binary_header.hpp"
#include "io/text/name_index.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

class BinaryReader {
 public:
  explicit BinaryReader(const std::string& path) : path_{path} {
    require_input_file(path);  // not a pipe, as the size must be known
    file_.emplace(path);
    size_ = static_cast<std::int64_t>(file_->bytes_left());
  }

  LoadedMesh read() {
    const std::string head = read_head();
    header_ = header_of_text(head, size_, path_);
    read_nodes();
    if (header_.node_bytes == 4)
      read_connectivity<std::int32_t>();
    else
      read_connectivity<std::int64_t>();
    if (header_.constants > 0 || !header_.variables.empty() || !header_.cell_variables.empty())
      read_solution();
    read_strips();
    return std::move(loaded_);
  }

 private:
  std::string read_head() {
    constexpr std::string_view says = "header ";
    std::string text(std::min<std::int64_t>(size_, 64), '\0');
    read_into(std::span(text));
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
    if (error != std::errc{} || stopped != text.data() + end || wanted < std::ssize(text) || wanted > size_)
      throw InputError(path_ + ":2: this is not how many bytes the head has; the file is damaged");
    const std::size_t before = text.size();
    text.resize(wanted);
    read_into(std::span(text).subspan(before));
    return text;
  }

  template <class T>
  void read_into(std::span<T> into) {
    file_->read_all(reinterpret_cast<char*>(into.data()), into.size_bytes());
  }

  std::vector<double> read_reals(std::size_t count) {
    std::vector<double> values(count);
    read_into(std::span(values));
    for (double& value : values) value = in_order<std::endian::little>(value);
    return values;
  }

  static std::size_t first_not_finite(std::span<const double> values) {
    return std::ranges::find_if_not(values, [](double v) { return std::isfinite(v); }) - values.begin();
  }

  void read_nodes() {
    Mesh& mesh = loaded_.mesh;
    mesh.points.resize(header_.nodes);
    mesh.owned_nodes = size32(mesh.points);
    read_into(std::span(mesh.points));
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      Point& p = mesh.points[i];
      p = {in_order<std::endian::little>(p.x), in_order<std::endian::little>(p.y)};
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        throw InputError(
            fmt::format("{}: node {} lies at ({}, {}), which is not finite", path_, i, p.x, p.y));
    }
  }

  template <class Number, std::size_t width>
  void read_rows(std::size_t count, const char* of, std::vector<std::array<NodeId, width>>& rows) {
    constexpr std::size_t rows_of_piece = std::size_t{1} << 14;
    std::vector<std::array<Number, width>> piece(std::min(count, rows_of_piece));
    rows.reserve(rows.size() + count);
    for (std::size_t done = 0; done < count; done += piece.size()) {
      piece.resize(std::min(count - done, rows_of_piece));
      read_into(std::span(piece));
      for (std::size_t i = 0; i < piece.size(); ++i) {
        auto& row = rows.emplace_back();
        for (std::size_t k = 0; k < width; ++k) {
          const std::int64_t node = in_order<std::endian::little>(piece[i][k]);
          if (node < 0 || node >= header_.nodes) refuse_node(node, of, done + i);
          row[k] = NodeId{static_cast<std::int32_t>(node)};
        }
      }
    }
  }

  [[noreturn]] void refuse_node(std::int64_t node, const char* of, std::size_t row) const {
    throw InputError(fmt::format("{}: {} {} has node {}, which is none of the nodes 0 to {}", path_, of, row,
                                 node, header_.nodes - 1));
  }

  template <class Number>
  void read_connectivity() {
    Mesh& mesh = loaded_.mesh;
    read_rows<Number>(header_.triangles(), "triangle", mesh.triangles);
    read_rows<Number>(header_.quads(), "quad", mesh.quads);
    loaded_.blocks = size32(header_.blocks);
    for (std::int32_t b = 0; b < loaded_.blocks; ++b) {
      const auto& [name, triangles, quads] = header_.blocks[b];
      loaded_.block_names.push_back(name);
      loaded_.triangle_to_block.resize(loaded_.triangle_to_block.size() + triangles, b);
      loaded_.quad_to_block.resize(loaded_.quad_to_block.size() + quads, b);
    }
    NameIndex names;
    for (const auto& [name, condition, edges, layers, inner_line] : header_.boundaries) {
      if (inner_line) {
        loaded_.inner_curves.push_back({.name = name, .condition = {}, .edges = {}});
        read_rows<Number>(edges, "edge of an inner line", loaded_.inner_curves.back().edges);
        continue;
      }
      const auto [index, is_new] = names.entry_of(name);
      if (is_new) mesh.boundaries.push_back({name, condition, {}, layers});
      read_rows<Number>(edges, "boundary edge", mesh.boundaries[index].edges);
    }
  }

  void read_solution() {
    Field solution;
    const std::size_t cells = loaded_.mesh.cell_count();
    solution.constants = read_reals(header_.constants);
    if (const std::size_t at = first_not_finite(solution.constants); at < solution.constants.size())
      throw InputError(fmt::format("{}: constant {} is not finite", path_, at));
    solution.names = header_.variables;
    solution.values = read_values(solution.names, loaded_.mesh.points.size(), "node");
    solution.cells.names = header_.cell_variables;
    solution.cells.values = read_values(solution.cells.names, cells, "cell");
    loaded_.solution = std::move(solution);
  }

  std::vector<double> read_values(const std::vector<std::string>& names, std::size_t rows,
                                  const char* place) {
    std::vector<double> values = read_reals(rows * names.size());
    if (const std::size_t at = first_not_finite(values); at < values.size())
      throw InputError(fmt::format("{}: {} is not finite at {} {}", path_, names[at % names.size()], place,
                                   at / names.size()));
    return values;
  }

  void read_strips() {
    const StripsInText found = strips_in_comments(header_.comments, loaded_.mesh.owned_nodes);
    loaded_.mesh.strips = found.strips;
    loaded_.mesh.pairs = pairs_in_comments(header_.comments);
    loaded_.mesh.named_nodes = nodes_in_comments(header_.comments, loaded_.mesh.owned_nodes);
    for (const std::string& name : found.damaged)
      loaded_.warnings.push_back(
          path_ + ": the comment '# strip " + name +
          "' does not list the nodes of a strip; its cells are treated as ordinary cells");
  }

  const std::string& path_;
  std::optional<InputPieces> file_;
  std::int64_t size_ = 0;
  BinaryHeader header_;
  LoadedMesh loaded_;
};

}  // namespace

LoadedMesh read_binary(const std::string& path) { return BinaryReader(path).read(); }

}  // namespace quadloop::io
