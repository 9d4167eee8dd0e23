#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "io/model/clean_up.hpp"
#include "io/msh/msh_file.hpp"
#include "io/msh/msh_text.hpp"
#include "io/msh/msh_values.hpp"

namespace quadloop::io {

namespace {

/// The elements of one kind, in file order.
template <std::size_t width>
struct ElementList {
  std::vector<std::array<std::int32_t, width>> nodes;
  std::vector<std::int64_t> tags;
  std::vector<std::int32_t> groups;  ///< number of the group that defines their block or boundary
  std::vector<std::size_t> places;   ///< positions in the text; for lines only

  void add(const MshElement& element, std::int32_t group) {
    nodes.push_back(element.as<width>());
    tags.push_back(element.tag);
    groups.push_back(group);
    if constexpr (width == 2) places.push_back(element.place);
  }
};

/// The group that defines a block or a boundary: a physical group or, without one, an entity.
struct ElementGroup {
  int dimension;
  std::int64_t physical, entity;  ///< 0 for the unused one

  friend auto operator<=>(const ElementGroup&, const ElementGroup&) = default;
};

class MshReader {
 public:
  explicit MshReader(const std::string& path) : text_{path} {}

  MeshOfFile read() {
    text_.read([this](std::int64_t tag, Point3 point) { put_point(tag, point); },
               [this](const MshElement& element) { put_element(element); });
    mesh_.dimension = groups_.empty() || highest_dimension() < 3 ? 2 : 3;
    if (is_plane()) require_plane();
    name_groups();
    is_plane() ? take_plane_elements() : take_elements();
    if (!is_plane()) mesh_.named_nodes.clear();
    if (is_plane()) mesh_.periodic_nodes = text_.periodic_nodes();
    keep_used_tags();
    read_solution();
    if (text_.may_repeat()) drop_repeated(mesh_, path(), group_sizes());
    drop_unused_nodes(mesh_, path());
    warn_of_names();
    if (is_plane()) return plane_mesh(std::move(mesh_), text_.scan());
    drop_empty_groups(mesh_);
    return std::move(mesh_);
  }

 private:
  bool is_plane() const { return mesh_.dimension == 2; }
  const std::string& path() const { return text_.scan().path(); }
  int highest_dimension() const { return std::ranges::max(groups_, {}, &ElementGroup::dimension).dimension; }

  void put_point(std::int64_t tag, Point3 point) {
    if (!mesh_.points.empty() && point.z != mesh_.points.front().z && !off_plane_)
      off_plane_ = {tag, text_.scan().place()};
    mesh_.points.push_back(point);
    node_tags_.push_back(tag);
  }

  void require_plane() {
    if (off_plane_)
      text_.scan().refuse_at(off_plane_->second,
                             fmt::format("node {} does not lie in the first node's plane z = "
                                         "constant; without 3D elements a mesh is plane",
                                         off_plane_->first));
    for (Point3& point : mesh_.points) point.z = 0;
  }

  void put_element(const MshElement& element) {
    switch (element.type) {
      case msh_point: return put_named_node(element);
      case msh_line: return lines_.add(element, group_of(1, element));
      case msh_triangle: return triangles_.add(element, group_of(2, element));
      case msh_quad: return quads_.add(element, group_of(2, element));
      case msh_tetrahedron: return tetrahedra_.add(element, group_of(3, element));
      case msh_pyramid: return pyramids_.add(element, group_of(3, element));
      case msh_prism: return prisms_.add(element, group_of(3, element));
      case msh_hexahedron: return hexahedra_.add(element, group_of(3, element));
      default: return;
    }
  }

  /// Points in no physical group are corners of the geometry, for example.
  void put_named_node(const MshElement& element) {
    const std::int64_t physical = std::abs(element.physical);
    if (physical != 0)
      mesh_.named_nodes.push_back({text_.groups().name_of(0, physical), GlobalNodeId{element.nodes[0]}});
  }

  /// Groups are numbered in the order of their first elements.
  std::int32_t group_of(int dimension, const MshElement& element) {
    const std::int64_t physical = std::abs(element.physical);
    const ElementGroup group{dimension, physical, physical == 0 ? element.entity : 0};
    if (!groups_.empty() && groups_[last_group_] == group) return last_group_;
    const auto [found, is_new] = numbers_.try_emplace(group, size32(groups_));
    if (is_new) groups_.push_back(group);
    return last_group_ = found->second;
  }

  /// Groups of the mesh's dimension are blocks, those of one less boundaries.
  void name_groups() {
    for (const ElementGroup& group : groups_) {
      const bool is_block = group.dimension == mesh_.dimension;
      std::int32_t number = -1;
      if (is_block || group.dimension + 1 == mesh_.dimension) {
        const std::string name = group.physical != 0 ? text_.groups().name_of(group.dimension, group.physical)
                                 : is_block          ? "domain"
                                                     : "boundary_" + std::to_string(group.entity);
        number = is_block ? mesh_.block_named(name) : mesh_.boundary_named(name);
      }
      number_of_group_.push_back(number);
    }
  }

  GroupSizes group_sizes() const {
    GroupSizes sizes{std::vector<std::int64_t>(mesh_.boundaries.size(), 0),
                     std::vector<std::int64_t>(mesh_.block_names.size(), 0)};
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (number_of_group_[g] < 0) continue;
      auto& of_kind = groups_[g].dimension == mesh_.dimension ? sizes.of_blocks : sizes.of_boundaries;
      of_kind[number_of_group_[g]] += text_.groups().members_of(groups_[g].dimension, groups_[g].physical);
    }
    return sizes;
  }

  void take_plane_elements() {
    take_cells<CellKind::triangle>(triangles_);
    take_cells<CellKind::quad>(quads_);
    take_faces(lines_);
  }
  void take_elements() {
    take_cells<CellKind::tetrahedron>(tetrahedra_);
    take_cells<CellKind::pyramid>(pyramids_);
    take_cells<CellKind::prism>(prisms_);
    take_cells<CellKind::hexahedron>(hexahedra_);
    take_faces(triangles_);
    take_faces(quads_);
  }

  template <CellKind kind, std::size_t width>
  void take_cells(ElementList<width>& list) {
    cells_of<kind>(mesh_) = std::move(list.nodes);
    auto& blocks = mesh_.cell_to_block[static_cast<std::size_t>(kind)];
    blocks = std::move(list.groups);
    for (std::int32_t& block : blocks) block = number_of_group_[block];
    cell_tags_.insert(cell_tags_.end(), list.tags.begin(), list.tags.end());
  }

  template <std::size_t width>
  void take_faces(const ElementList<width>& list) {
    for (std::size_t i = 0; i < list.nodes.size(); ++i) {
      FileBoundary& boundary = mesh_.boundaries[number_of_group_[list.groups[i]]];
      FileBoundary::Face& face = boundary.faces.emplace_back();
      face.fill(FileBoundary::no_node);
      std::ranges::copy(list.nodes[i], face.begin());
      if constexpr (width == 2) boundary.places.push_back(list.places[i]);
    }
  }

  /// Nodes that drop_unused_nodes() will remove need no values.
  void keep_used_tags() {
    const std::vector<char> is_used = used_nodes(mesh_);
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
    CellValues in_cells = msh_columns(found.in_elements, cell_tags_, "cells", losses);
    for (const std::string& loss : losses) mesh_.warnings.push_back(path() + ": " + loss);
    mesh_.solution = Field{std::move(at_nodes.names), std::move(at_nodes.values), {}, std::move(in_cells)};
  }

  void warn_of_names() {
    const int of_boundaries = mesh_.dimension - 1;
    for (const std::string& warning : text_.warnings(of_boundaries)) mesh_.warnings.push_back(warning);
    const auto unnamed = std::ranges::count_if(groups_, [&](const ElementGroup& group) {
      return group.dimension == of_boundaries && group.physical == 0;
    });
    if (unnamed == 0) return;
    mesh_.warnings.push_back(fmt::format(
        "{0}: {1} {2}s are in no physical group; their boundaries are called boundary_ and the {2}'s number "
        "(in Gmsh, Physical {3} gives names)",
        path(), unnamed, is_plane() ? "curve" : "surface", is_plane() ? "Curve" : "Surface"));
  }

  MshText text_;
  FileMesh mesh_;
  /// A node's tag, and its position in the text.
  std::optional<std::pair<std::int64_t, std::size_t>> off_plane_;
  ElementList<2> lines_;
  ElementList<3> triangles_;
  ElementList<4> quads_, tetrahedra_;
  ElementList<5> pyramids_;
  ElementList<6> prisms_;
  ElementList<8> hexahedra_;
  std::vector<ElementGroup> groups_;
  std::map<ElementGroup, std::int32_t> numbers_;
  std::int32_t last_group_ = 0;
  std::vector<std::int32_t> number_of_group_;  ///< number of its block or boundary; -1: neither
  std::vector<std::int64_t> node_tags_, cell_tags_;
};

}  // namespace

MeshOfFile read_msh(const std::string& path) { return MshReader(path).read(); }

}  // namespace quadloop::io
