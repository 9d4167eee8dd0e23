#include <algorithm>
#include <utility>

#include "io/model/layers_text.hpp"
#include "io/model/line_text.hpp"
#include "io/model/node_text.hpp"
#include "io/model/pair_text.hpp"
#include "io/model/strip_text.hpp"
#include "io/native/native_file.hpp"
#include "io/text/name_index.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"

namespace quadloop::io {

namespace {

class NativeReader {
 public:
  explicit NativeReader(const std::string& path) : scan_{path} {}

  LoadedMesh read() {
    read_nodes();
    read_blocks();
    read_boundaries();
    read_strips();
    if (!scan_.at_end()) read_solution();
    if (!scan_.at_end()) {
      const std::string found(scan_.token("").substr(0, 40));
      scan_.refuse("text after the end: \"" + found + "\"; a row too many, or a count too small");
    }
    return std::move(loaded_);
  }

 private:
  void read_nodes() {
    Mesh& mesh = loaded_.mesh;
    mesh.points.resize(scan_.count("grid points", 2));
    mesh.owned_nodes = size32(mesh.points);
    for (Point& p : mesh.points) {
      p.x = scan_.real("an x coordinate");
      p.y = scan_.real("a y coordinate");
    }
  }

  template <std::size_t width>
  void read_rows(const std::string& of, std::vector<std::array<NodeId, width>>& rows) {
    const std::size_t first = rows.size();
    rows.resize(first + scan_.count(of, width));
    const std::string expected = "a node of the " + of;
    for (std::size_t i = first; i < rows.size(); ++i) {
      for (NodeId& node : rows[i]) node = node_of(scan_.integer(expected));
    }
  }

  NodeId node_of(std::int64_t number) const {
    if (number < 1 || number > loaded_.mesh.owned_nodes) {
      scan_.refuse("node " + std::to_string(number) + " is none of the nodes 1 to " +
                   std::to_string(loaded_.mesh.owned_nodes));
    }
    return NodeId{static_cast<std::int32_t>(number - 1)};
  }

  void read_blocks() {
    const std::size_t blocks = scan_.count("blocks", 1);
    if (blocks == 0) scan_.refuse("a mesh has at least one block");
    loaded_.blocks = static_cast<std::int32_t>(blocks);
    for (std::int32_t block = 0; block < loaded_.blocks; ++block) {
      loaded_.block_names.push_back(name_of_block(block));
      read_rows("triangular elements", loaded_.mesh.triangles);
      read_rows("quadrilateral elements", loaded_.mesh.quads);
      loaded_.triangle_to_block.resize(loaded_.mesh.triangles.size(), block);
      loaded_.quad_to_block.resize(loaded_.mesh.quads.size(), block);
    }
  }

  /// Returns the name in the comment "# block NAME" before the next block, if there is one.
  std::string name_of_block(std::int32_t block) {
    constexpr std::string_view head = "# block ";
    scan_.forget_comments();
    scan_.at_end();
    const std::string_view comment = scan_.last_comment_with(head);
    return comment.starts_with(head) ? std::string(comment.substr(head.size()))
                                     : usual_block_name(loaded_.blocks, block);
  }

  void read_boundaries() {
    const std::size_t boundaries = scan_.count("boundaries", 1);
    for (std::size_t b = 1; b <= boundaries; ++b) {
      scan_.forget_comments();
      std::vector<std::array<NodeId, 2>> edges;
      read_rows_named(b, edges);
    }
  }

  void read_rows_named(std::size_t number, std::vector<std::array<NodeId, 2>>& edges) {
    const bool more = !scan_.at_end();
    std::string name = more ? name_in(scan_.last_comment_with("(")) : std::string();
    if (name.empty()) name = std::string("boundary_").append(std::to_string(number));
    const WallLayers layers = more ? layers_of(name) : WallLayers{};
    read_rows("edges of boundary " + std::to_string(number) + " (" + name + ")", edges);
    auto& boundaries = loaded_.mesh.boundaries;
    const auto [index, is_new] = boundary_names_.entry_of(name);
    if (is_new) {
      boundaries.push_back({name, {}, std::move(edges), layers});
    } else {
      auto& same = boundaries[index].edges;
      same.insert(same.end(), edges.begin(), edges.end());
      if (boundaries[index].layers.count == 0) boundaries[index].layers = layers;
    }
  }

  /// Returns the layers in the comment "# layers NAME COUNT THICKNESS", if the boundary has one.
  WallLayers layers_of(const std::string& name) const {
    const std::string head = "# layers " + name + " ";
    const std::string_view comment = scan_.last_comment_with(head);
    return comment.starts_with(head) ? layers_of_text(comment.substr(head.size())) : WallLayers{};
  }

  /// Reads strips, pairs, inner lines and named nodes from comments after the boundaries.
  void read_strips() {
    scan_.forget_comments();
    scan_.at_end();
    for (BoundaryEdges& line : lines_in_comments(scan_.passed_over(), loaded_.mesh.owned_nodes))
      loaded_.inner_curves.push_back(std::move(line));
    const StripsInText found = strips_in_comments(scan_.passed_over(), loaded_.mesh.owned_nodes);
    loaded_.mesh.strips = found.strips;
    loaded_.mesh.pairs = pairs_in_comments(scan_.passed_over());
    loaded_.mesh.named_nodes = nodes_in_comments(scan_.passed_over(), loaded_.mesh.owned_nodes);
    for (const std::string& name : found.damaged)
      loaded_.warnings.push_back(
          scan_.path() + ": the comment '# strip " + name +
          "' does not list the nodes of a strip; its cells are treated as ordinary cells");
  }

  /// Returns the name in the brackets of "#Number of edges for boundary 1 (name)".
  static std::string name_in(std::string_view comment) {
    const std::size_t open = comment.find('('), close = comment.rfind(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return {};
    std::string_view name = comment.substr(open + 1, close - open - 1);
    while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
    while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
    return std::string(name);
  }

  void read_solution() {
    Field solution;
    // A comment distinguishes cell values from other sections and from extra rows.
    const auto at_cells = [this] {
      return !scan_.at_end() && !scan_.last_comment_with("cell variables").empty();
    };
    if (!at_cells()) {
      solution.constants.resize(scan_.count("constants", 1));
      for (double& value : solution.constants) value = scan_.real("a constant");
    }
    if (!scan_.at_end() && !at_cells()) {
      solution.names = read_names("variables");
      solution.values = read_values(solution.names, loaded_.mesh.points.size(), "node");
    }
    if (at_cells()) {
      const std::size_t cells = loaded_.mesh.cell_count();
      solution.cells.names = read_names("cell variables");
      solution.cells.values = read_values(solution.cells.names, cells, "cell");
    }
    if (!solution.empty() || !solution.constants.empty()) loaded_.solution = std::move(solution);
  }

  std::vector<std::string> read_names(const std::string& of) {
    const std::size_t variables = scan_.count(of, 1);
    scan_.forget_comments();
    const bool more = !scan_.at_end();
    return names_in(more ? scan_.last_comment_with("names:") : "", variables);
  }

  std::vector<double> read_values(const std::vector<std::string>& names, std::size_t rows,
                                  const std::string& place) {
    const std::size_t variables = names.size();
    if (variables > 0 && 2 * rows > (scan_.bytes_left() + 1) / variables) {
      scan_.refuse("the file ends before the " + std::to_string(rows) + " rows of " +
                   std::to_string(variables) + " variables");
    }
    std::vector<double> values(rows * variables);
    std::size_t at = 0;
    try {
      for (; at < values.size(); ++at) values[at] = scan_.real("a value of the solution");
    } catch (const InputError& fault) {
      throw InputError(std::string(fault.what()) + "; it is " + names[at % variables] + " at " + place + " " +
                       std::to_string(at / variables + 1));
    }
    return values;
  }

  std::vector<std::string> names_in(std::string_view comment, std::size_t variables) const {
    std::vector<std::string> names;
    const std::size_t colon = comment.find("names:");
    std::string_view rest = colon == std::string_view::npos ? "" : comment.substr(colon + 6);
    while (true) {
      const std::size_t begin = rest.find_first_not_of(" \t");
      if (begin == std::string_view::npos) break;
      const std::size_t end = std::min(rest.find_first_of(" \t", begin), rest.size());
      names.emplace_back(rest.substr(begin, end - begin));
      rest.remove_prefix(end);
    }
    if (!names.empty() && names.size() != variables) {
      scan_.refuse(std::to_string(names.size()) + " names stand over " + std::to_string(variables) +
                   " variables");
    }
    for (std::size_t v = names.size(); v < variables; ++v)
      names.push_back(std::string("v").append(std::to_string(v + 1)));
    return names;
  }

  TextScanner scan_;
  LoadedMesh loaded_;
  NameIndex boundary_names_;
};

}  // namespace

LoadedMesh read_native(const std::string& path) { return NativeReader(path).read(); }

}  // namespace quadloop::io
