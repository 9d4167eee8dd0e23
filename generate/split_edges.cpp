#include "generate/split_edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <span>

#include "mesher/base/error.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/layers/grown_mesh.hpp"

namespace quadloop {

namespace {

/// The sine of the smallest angle of a counter-clockwise triangle; 0 or less if it has no positive area.
double smallest_sine_of(Point a, Point b, Point c) {
  if (orientation(a, b, c) <= 0) return 0;
  const double area = cross(b - a, c - a), ab = length(b - a), bc = length(c - b), ca = length(a - c);
  return area / std::max({ab * bc, bc * ca, ca * ab});
}

/// The sine from which a triangle is more than a line with rounding errors.
constexpr double least_sine = 1e-6;

/// The triangles of a polygon some of whose nodes are on its sides, up to rounding: the best ear is cut off
/// first. Empty if no ear is left.
std::vector<std::array<GrownNode, 3>> triangles_in(std::vector<GrownNode> polygon) {
  std::vector<std::array<GrownNode, 3>> triangles;
  while (polygon.size() >= 3) {
    const std::size_t size = polygon.size();
    double best = least_sine;
    std::size_t ear = size;
    for (std::size_t i = 0; i < size; ++i) {
      const Point before = polygon[(i + size - 1) % size].point, after = polygon[(i + 1) % size].point;
      bool is_free = true;
      for (std::size_t k = 2; k + 1 < size && is_free; ++k)
        is_free = smallest_sine_of(before, after, polygon[(i + k) % size].point) > least_sine;
      const double sine = is_free ? smallest_sine_of(before, polygon[i].point, after) : 0;
      if (sine > best) best = sine, ear = i;
    }
    if (ear == size) return {};
    triangles.push_back({polygon[(ear + size - 1) % size], polygon[ear], polygon[(ear + 1) % size]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

class EdgeSplitter {
 public:
  EdgeSplitter(const Communicator& comm, std::vector<EdgeSplit> splits, MeshResult& result)
      : comm_{comm}, result_{result}, mesh_{result.mesh}, splits_{std::move(splits)} {
    std::ranges::sort(splits_, {}, [](const EdgeSplit& s) { return std::pair(s.from, s.to); });
    for (std::int32_t s = 0; s < size32(splits_); ++s) {
      const EdgeSplit& split = splits_[s];
      std::int32_t& added = added_after_[split.from];
      split_at_.emplace(std::pair(split.from, split.to), Split{s, added});
      added += size32(split.places);
    }
    for (const NodeId node : ids_below(NodeId{mesh_.owned_nodes})) added_.push_back(added_behind(node));
    grown_.emplace(comm, added_, divide_, mesh_, result.tree.leaves);
  }

  void split() {
    comm_.together([&] {
      std::int32_t triangle = 0, quad = 0, leaf = 0;
      for (const LeafRecord& record : result_.tree.leaves) {
        for (const std::int32_t end = triangle + record.triangles; triangle < end; ++triangle) {
          if (divide(mesh_.triangles[triangle], leaf)) grown_->drop_triangle(triangle);
        }
        for (const std::int32_t end = quad + record.quads; quad < end; ++quad) {
          if (divide(mesh_.quads[quad], leaf)) grown_->drop_quad(quad);
        }
        ++leaf;
      }
    });
    add_edges();
    grown_->put_together([&](NodeId node, std::vector<Point>& points) { append_behind(node, points); });
    result_.edge_leaves = grown_->edge_leaves();
    count_entries(comm_, result_);
  }

 private:
  struct Split {
    std::int32_t number = 0;
    std::int32_t first = 0;  ///< its first node among those added after the node
  };

  std::int32_t added_behind(NodeId node) const {
    const auto at = added_after_.find(mesh_.global(node));
    return at == added_after_.end() ? 0 : at->second;
  }

  void append_behind(NodeId node, std::vector<Point>& points) const {
    for (const EdgeSplit& split : std::ranges::equal_range(splits_, mesh_.global(node), {}, &EdgeSplit::from))
      points.insert(points.end(), split.places.begin(), split.places.end());
  }

  /// Appends the start of an edge and its new nodes; returns whether it has any.
  bool append_edge(NodeId from, NodeId to, std::vector<GrownNode>& nodes) const {
    nodes.push_back(grown_->node(from));
    const auto at = split_at_.find({mesh_.global(from), mesh_.global(to)});
    if (at == split_at_.end()) return false;
    std::int64_t next = nodes.back().id.value() + 1 + at->second.first;
    for (const Point place : splits_[at->second.number].places)
      nodes.push_back({GlobalNodeId{next++}, place});
    return true;
  }

  template <std::size_t width>
  bool divide(const std::array<NodeId, width>& cell, std::int32_t leaf) {
    if (std::ranges::none_of(cell, [&](NodeId n) { return added_after_.contains(mesh_.global(n)); }))
      return false;
    std::vector<GrownNode> polygon;
    bool has_new = false;
    for (std::size_t k = 0; k < width; ++k)
      has_new = append_edge(cell[k], cell[(k + 1) % width], polygon) || has_new;
    if (!has_new) return false;
    const Point place = polygon[1].point;
    const auto triangles = triangles_in(std::move(polygon));
    if (triangles.empty())
      throw InputError(
          fmt::format("near ({:.6g}, {:.6g}): a cell at a [[pair]] or a baffle cannot be divided; use a "
                      "smaller spacing there",
                      place.x, place.y));
    for (const auto& triangle : triangles) grown_->add_cell(leaf, triangle);
    return true;
  }

  void add_edges() {
    std::vector<GrownNode> nodes;
    for (std::size_t b = 0; b < mesh_.boundaries.size(); ++b) {
      for (std::size_t e = 0; e < mesh_.boundaries[b].edges.size(); ++e) {
        const auto& edge = mesh_.boundaries[b].edges[e];
        const std::int32_t leaf = result_.edge_leaves[b][e];
        nodes.clear();
        if (!append_edge(edge[0], edge[1], nodes)) {
          grown_->keep_edge(b, leaf, edge);
          continue;
        }
        nodes.push_back(grown_->node(edge[1]));
        for (std::size_t k = 1; k < nodes.size(); ++k) grown_->add_edge(b, leaf, nodes[k - 1], nodes[k]);
      }
    }
  }

  const Communicator& comm_;
  MeshResult& result_;
  Mesh& mesh_;
  std::vector<EdgeSplit> splits_;
  std::map<GlobalNodeId, std::int32_t> added_after_;
  std::map<std::pair<GlobalNodeId, GlobalNodeId>, Split> split_at_;
  std::vector<std::int32_t> added_;
  DivideBy divide_;
  std::optional<GrownMesh> grown_;
};

}  // namespace

void split_edges(const Communicator& comm, std::vector<EdgeSplit> splits, MeshResult& result) {
  if (!splits.empty()) EdgeSplitter(comm, std::move(splits), result).split();
}

}  // namespace quadloop
