#include "adapt/morph/boundary_outline.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

struct OutlineEdge {
  GlobalNodeId from, to;
  Point place;  ///< of the node `from`
  std::int32_t boundary = -1;
};

/// Of all ranks, by the node where they begin.
std::vector<OutlineEdge> all_edges(const Communicator& comm, const Mesh& mesh) {
  std::vector<OutlineEdge> own;
  for (std::int32_t b = 0; b < size32(mesh.boundaries); ++b) {
    for (const auto& [from, to] : mesh.boundaries[b].edges)
      own.push_back({mesh.global(from), mesh.global(to), mesh.point(from), b});
  }
  std::vector<OutlineEdge> edges = comm.all_gather_values(std::span<const OutlineEdge>(own));
  std::ranges::sort(edges, {}, [](const OutlineEdge& e) { return std::tuple(e.from, e.boundary, e.to); });
  return edges;
}

/// Edges joined to loops.
class Loops {
 public:
  explicit Loops(std::vector<OutlineEdge> edges) : edges_{std::move(edges)}, taken_(edges_.size(), 0) {
    for (std::size_t first = 0; first < edges_.size(); ++first) {
      if (taken_[first] == 0) walk(first);
    }
  }
  BoundaryOutline outline(const std::vector<Boundary>& boundaries) && {
    return {Geometry(boundaries, std::move(points_), std::move(starts_), std::move(segment_boundary_)),
            std::move(nodes_)};
  }

 private:
  void walk(std::size_t first) {
    for (std::size_t at = first; taken_[at] == 0; at = after(edges_[at])) {
      taken_[at] = 1;
      points_.push_back(edges_[at].place);
      nodes_.push_back(edges_[at].from);
      segment_boundary_.push_back(BoundaryId{edges_[at].boundary});
    }
    starts_.push_back(size32(points_));
  }
  /// Where the boundary passes a node more than once, on along an edge that none has taken, of the same
  /// boundary if there is one.
  std::size_t after(const OutlineEdge& edge) const {
    const auto leaving = std::ranges::equal_range(edges_, edge.to, {}, &OutlineEdge::from);
    QUADLOOP_REQUIRE(!leaving.empty(), "the boundary of a mesh is closed");
    auto best = leaving.begin();
    const auto worth = [&](auto e) {
      return std::pair(taken_[e - edges_.begin()] == 0, e->boundary == edge.boundary);
    };
    for (auto e = leaving.begin(); e != leaving.end(); ++e) {
      if (worth(e) > worth(best)) best = e;
    }
    return best - edges_.begin();
  }

  std::vector<OutlineEdge> edges_;
  std::vector<char> taken_;
  std::vector<Point> points_;
  std::vector<GlobalNodeId> nodes_;
  std::vector<std::int32_t> starts_{0};
  std::vector<BoundaryId> segment_boundary_;
};

}  // namespace

BoundaryOutline outline_of(const Communicator& comm, const Mesh& mesh) {
  std::vector<Boundary> boundaries;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    boundaries.emplace_back();
    boundaries.back().name = boundary.name;
  }
  return Loops(all_edges(comm, mesh)).outline(boundaries);
}

}  // namespace quadloop
