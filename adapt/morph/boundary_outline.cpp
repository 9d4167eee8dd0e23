#include "adapt/morph/boundary_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"

namespace quadloop::adapt {

namespace {

struct OutlineEdge {
  GlobalNodeId from, to;
  Point place;  ///< of the node `from`
  std::int32_t boundary = -1;
};

/// Gathers the edges of all ranks, sorted by their start nodes.
std::vector<OutlineEdge> all_edges(const Communicator& comm, const Mesh& mesh, bool by_pieces,
                                   const std::set<std::string>& names) {
  std::vector<std::int64_t> right;  // the cells to the right of boundary edges
  if (by_pieces) right = cells_right_of_boundaries(comm, mesh);
  auto across = right.begin();
  std::vector<OutlineEdge> own;
  for (std::int32_t b = 0; b < size32(mesh.boundaries); ++b) {
    const BoundaryEdges& boundary = mesh.boundaries[b];
    const bool left_out = boundary.inner_line && !(by_pieces && names.contains(boundary.name));
    for (const auto& [from, to] : boundary.edges) {
      const bool both_ways = by_pieces && *across++ != EdgeCells::none;
      if (left_out) continue;
      own.push_back({mesh.global(from), mesh.global(to), mesh.point(from), b});
      if (both_ways) own.push_back({mesh.global(to), mesh.global(from), mesh.point(to), b});
    }
  }
  std::vector<OutlineEdge> edges = comm.all_gather_values(std::span<const OutlineEdge>(own));
  std::ranges::sort(edges, {}, [](const OutlineEdge& e) { return std::tuple(e.from, e.boundary, e.to); });
  return edges;
}

/// Connects edges to loops.
class Loops {
 public:
  explicit Loops(std::vector<OutlineEdge> edges) : edges_{std::move(edges)}, taken_(edges_.size(), 0) {
    for (std::size_t first = 0; first < edges_.size(); ++first) {
      if (taken_[first] == 0) walk(first);
    }
  }
  BoundaryOutline outline(const std::vector<Boundary>& boundaries) && {
    return {std::move(builder_).geometry(boundaries), std::move(nodes_)};
  }

 private:
  void walk(std::size_t first) {
    for (std::size_t at = first; taken_[at] == 0; at = after(edges_[at], first)) {
      taken_[at] = 1;
      builder_.add(edges_[at].place, BoundaryId{edges_[at].boundary});
      nodes_.push_back(edges_[at].from);
    }
    builder_.end_loop();
  }

  std::span<const OutlineEdge> leaving(GlobalNodeId node) const {
    const auto edges = std::ranges::equal_range(edges_, node, {}, &OutlineEdge::from);
    if (edges.empty()) refuse_open();
    return edges;
  }
  [[noreturn]] static void refuse_open() {
    throw InputError(
        "the boundaries of the mesh are no closed loops, as a boundary between two blocks ends on another "
        "one; give the geometry of the mesh, with the same pieces and numbers of points");
  }
  Point along(const OutlineEdge& edge) const { return leaving(edge.to).front().place - edge.place; }

  /// Returns the turning angle from one edge to the next in millionths of a radian; of two equally sharp
  /// turns, one away from the domain (as at the corner of a body) comes first.
  std::pair<double, bool> turn(const OutlineEdge& edge, const OutlineEdge& next) const {
    const Point before = along(edge), after = along(next);
    const double angle = std::round(1e6 * std::atan2(cross(before, after), dot(before, after)));
    return {std::abs(angle), angle > 0};
  }

  /// Returns the edge that continues a loop that started with `first`. If the boundary passes a node more
  /// than once: an unused edge, of the same boundary if possible, in the straightest direction, so that two
  /// touching bodies remain two loops.
  std::size_t after(const OutlineEdge& edge, std::size_t first) const {
    const std::span<const OutlineEdge> all = leaving(edge.to);
    if (all.size() == 1) return &all.front() - edges_.data();
    const auto cost = [&](const OutlineEdge& e) {
      const std::size_t number = &e - edges_.data();
      return std::tuple(taken_[number] != 0 && number != first, e.boundary != edge.boundary, turn(edge, e));
    };
    return &*std::ranges::min_element(all, {}, cost) - edges_.data();
  }

  std::vector<OutlineEdge> edges_;
  std::vector<char> taken_;
  GeometryBuilder builder_;
  std::vector<GlobalNodeId> nodes_;
};

}  // namespace

BoundaryOutline outline_of(const Communicator& comm, const Mesh& mesh, bool by_pieces,
                           const std::set<std::string>& names) {
  std::vector<Boundary> boundaries;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    boundaries.emplace_back();
    boundaries.back().name = boundary.name;
  }
  return Loops(all_edges(comm, mesh, by_pieces, names)).outline(boundaries);
}

bool has_closed_boundaries(const Communicator& comm, const Mesh& mesh) {
  bool has_lines = false;
  for (const BoundaryEdges& boundary : mesh.boundaries)
    has_lines = has_lines || (boundary.inner_line && !boundary.edges.empty());
  if (comm.any(has_lines)) return false;
  std::vector<GlobalNodeId> left, reached;
  std::vector<std::pair<Point, GlobalNodeId>> places;
  for (const OutlineEdge& edge : all_edges(comm, mesh, false, {})) {
    left.push_back(edge.from);
    reached.push_back(edge.to);
    places.emplace_back(edge.place, edge.from);
  }
  std::ranges::sort(left);
  std::ranges::sort(reached);
  std::ranges::sort(places);
  const auto is_twice = [](const auto& a, const auto& b) {
    return a.first == b.first && a.second != b.second;
  };
  return left == reached && std::ranges::adjacent_find(places, is_twice) == places.end();
}

}  // namespace quadloop::adapt
