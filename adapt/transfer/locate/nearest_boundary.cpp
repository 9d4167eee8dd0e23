#include "adapt/transfer/locate/nearest_boundary.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop::adapt {

namespace {

struct Edge {
  std::int64_t number = 0;
  Point from, to;
  std::int32_t rank = 0, index = 0;
};

/// All ranks' edges in the order of their numbers.
std::vector<Edge> gather_edges(const Communicator& comm, const Mesh& mesh) {
  std::vector<Edge> own;
  std::int64_t before = 0;
  std::int32_t index = 0;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    const auto count = std::ssize(boundary.edges);
    std::int64_t number = before + comm.exclusive_sum(count);
    for (const auto& [from, to] : boundary.edges) {
      if (!boundary.inner_line) own.push_back({number, mesh.point(from), mesh.point(to), comm.rank(), index});
      ++number;
      ++index;
    }
    before += comm.sum(count);
  }
  std::vector<Edge> all = comm.all_gather_values(std::span<const Edge>(own));
  std::sort(all.begin(), all.end(), [](const Edge& a, const Edge& b) { return a.number < b.number; });
  return all;
}

BoxTree tree_of(const std::vector<Edge>& edges) {
  std::vector<Box> boxes;
  boxes.reserve(edges.size());
  for (const Edge& edge : edges) boxes.push_back(box_of(edge.from, edge.to));
  return BoxTree(boxes);
}

}  // namespace

struct NearestBoundary::Tree {
  std::vector<Edge> edges;
  BoxTree boxes;
};

NearestBoundary::NearestBoundary(const Communicator& comm, const Mesh& mesh)
    : tree_{std::make_unique<Tree>()} {
  tree_->edges = gather_edges(comm, mesh);
  tree_->boxes = tree_of(tree_->edges);
  QUADLOOP_REQUIRE(!tree_->edges.empty(),
                   "a mesh without boundary edges has no values for points outside it");
}

NearestBoundary::~NearestBoundary() = default;

BoundaryPlace NearestBoundary::nearest(Point p) const {
  const auto place_on = [&](std::int32_t number) {
    const Edge& edge = tree_->edges[number];
    return place_on_segment(p, edge.from, edge.to);
  };
  const std::int32_t nearest =
      tree_->boxes.nearest(p, [&](std::int32_t number) { return place_on(number).squared_distance; });
  const Edge& edge = tree_->edges[nearest];
  return {edge.rank, edge.index, place_on(nearest).parameter};
}

std::vector<std::array<NodeId, 2>> boundary_edges_of(const Mesh& mesh) {
  std::vector<std::array<NodeId, 2>> edges;
  for (const BoundaryEdges& boundary : mesh.boundaries)
    edges.insert(edges.end(), boundary.edges.begin(), boundary.edges.end());
  return edges;
}

}  // namespace quadloop::adapt
