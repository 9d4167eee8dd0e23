#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "io/loaded/foreign_mesh.hpp"
#include "io/msh/msh_file.hpp"
#include "io/msh/msh_text.hpp"
#include "io/msh/msh_values.hpp"

namespace quadloop {

namespace {

class MshReader {
 public:
  explicit MshReader(const std::string& path) : text_{path, 2} {}

  LoadedMesh read() {
    text_.read([this](std::int64_t tag, Point3 point) { put_point(tag, point); },
               [this](const MshElement& element) { put_element(element); });
    for (const std::int32_t node : text_.periodic_nodes())
      foreign_.loaded.periodic_nodes.push_back(NodeId{node});
    drop_unused_tags();
    read_solution();
    if (text_.may_repeat()) drop_repeated(foreign_, text_.scan().path(), text_.groups().sizes());
    drop_unused_nodes(foreign_, text_.scan().path());
    warn_of_names();
    return finish(std::move(foreign_), text_.scan());
  }

 private:
  void warn_of_names() {
    for (const std::string& warning : text_.warnings(1)) foreign_.loaded.warnings.push_back(warning);
    const std::int64_t curves = text_.groups().curves_without_group();
    if (curves == 0) return;
    foreign_.loaded.warnings.push_back(
        text_.scan().path() + ": " + std::to_string(curves) +
        " curves are in no physical group; their boundaries are called " +
        "boundary_ and the curve's number (in Gmsh, Physical Curve gives names)");
  }

  /// What drop_unused_nodes() is going to do: nodes of no cell need no values.
  void drop_unused_tags() {
    std::vector<char> is_used(node_tags_.size(), 0);
    const auto mark = [&](const auto& nodes) {
      for (const NodeId node : nodes) is_used[node.value()] = 1;
    };
    std::ranges::for_each(foreign_.loaded.mesh.triangles, mark);
    std::ranges::for_each(foreign_.loaded.mesh.quads, mark);
    for (const ForeignEdge& edge : foreign_.edges) mark(edge.nodes);
    std::size_t at = 0;
    std::erase_if(node_tags_, [&](std::int64_t) { return is_used[at++] == 0; });
  }

  void read_solution() {
    const MshSolution found = text_.read_values();
    if (found.empty()) return;
    std::vector<std::string> losses;
    if (found.others > 0)
      losses.push_back(std::to_string(found.others) +
                       " sections $ElementNodeData, values at the nodes of each element, are left out");
    CellValues at_nodes = msh_columns(found.at_nodes, node_tags_, "nodes", losses);
    triangle_tags_.insert(triangle_tags_.end(), quad_tags_.begin(), quad_tags_.end());
    CellValues in_cells = msh_columns(found.in_elements, triangle_tags_, "cells", losses);
    for (const std::string& loss : losses)
      foreign_.loaded.warnings.push_back(text_.scan().path() + ": " + loss);
    foreign_.loaded.solution =
        Field{std::move(at_nodes.names), std::move(at_nodes.values), {}, std::move(in_cells)};
  }

  void put_point(std::int64_t tag, Point3 point) {
    if (!z_) z_ = point.z;
    if (point.z != *z_)
      text_.scan().refuse("node " + std::to_string(tag) +
                          " does not lie in the first node's plane z = constant; only plane meshes can be "
                          "read");
    foreign_.loaded.mesh.points.push_back({point.x, point.y});
    node_tags_.push_back(tag);
  }

  void put_element(const MshElement& element) {
    if (element.type == msh_triangle) {
      foreign_.add_triangle(element.as<NodeId, 3>(), text_.groups().block_of(foreign_, element.physical));
      triangle_tags_.push_back(element.tag);
    } else if (element.type == msh_quad) {
      foreign_.add_quad(element.as<NodeId, 4>(), text_.groups().block_of(foreign_, element.physical));
      quad_tags_.push_back(element.tag);
    } else if (element.type == msh_line) {
      foreign_.edges.push_back({element.as<NodeId, 2>(),
                                text_.groups().boundary_of(foreign_, element.physical, element.entity),
                                element.place});
    }
  }

  MshText text_;
  std::optional<double> z_;
  ForeignMesh foreign_;
  std::vector<std::int64_t> node_tags_, triangle_tags_, quad_tags_;  ///< in the order of the mesh's
};

}  // namespace

LoadedMesh read_msh(const std::string& path) { return MshReader(path).read(); }

}  // namespace quadloop
