#include "adapt/transfer/nearest_boundary.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>

#include "adapt/transfer/linear_values.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

namespace geometry = boost::geometry;
using TreePoint = geometry::model::d2::point_xy<double>;
using TreeBox = geometry::model::box<TreePoint>;
using TreeItem = std::pair<TreeBox, std::int32_t>;
using EdgeTree = geometry::index::rtree<TreeItem, geometry::index::quadratic<16>>;

constexpr double slack =
    1 + 1e-12;  ///< a box's distance is rounded too: boxes this much farther are still looked into

struct Edge {
  std::int64_t number = 0;
  Point from, to;
  std::int32_t rank = 0, index = 0;
};

/// All ranks' edges in the order of their numbers.
std::vector<Edge> gather_edges(const Communicator& comm, const Mesh& mesh) {
  std::vector<Edge> own;
  std::int64_t before = 0;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    const auto count = static_cast<std::int64_t>(boundary.edges.size());
    std::int64_t number = before + comm.exclusive_sum(count);
    for (const auto& [from, to] : boundary.edges) {
      own.push_back(
          {number++, mesh.point(from), mesh.point(to), comm.rank(), static_cast<std::int32_t>(own.size())});
    }
    before += comm.sum(count);
  }
  std::vector<Edge> all = comm.all_gather_values(std::span<const Edge>(own));
  std::sort(all.begin(), all.end(), [](const Edge& a, const Edge& b) { return a.number < b.number; });
  return all;
}

std::vector<TreeItem> items_of(const std::vector<Edge>& edges) {
  std::vector<TreeItem> items;
  items.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    Box box;
    box.include(edges[i].from);
    box.include(edges[i].to);
    items.emplace_back(TreeBox{{box.low.x, box.low.y}, {box.high.x, box.high.y}},
                       static_cast<std::int32_t>(i));
  }
  return items;
}

}  // namespace

struct NearestBoundary::Tree {
  std::vector<Edge> edges;
  EdgeTree boxes;
};

NearestBoundary::NearestBoundary(const Communicator& comm, const Mesh& mesh)
    : tree_{std::make_unique<Tree>()} {
  tree_->edges = gather_edges(comm, mesh);
  tree_->boxes = EdgeTree(items_of(tree_->edges));
  QUADLOOP_REQUIRE(!tree_->edges.empty(),
                   "a mesh without boundary edges has no values for points outside it");
}

NearestBoundary::~NearestBoundary() = default;

BoundaryPlace NearestBoundary::nearest(Point p) const {
  const TreePoint at(p.x, p.y);
  std::int32_t best = -1;
  NearestOnSegment place;
  for (auto item =
           tree_->boxes.qbegin(geometry::index::nearest(at, static_cast<unsigned>(tree_->edges.size())));
       item != tree_->boxes.qend(); ++item) {
    if (best >= 0 && geometry::comparable_distance(at, item->first) > slack * place.squared_distance) break;
    const Edge& edge = tree_->edges[static_cast<std::size_t>(item->second)];
    const NearestOnSegment other = nearest_along_segment(edge.from, edge.to, p);
    const bool nearer = other.squared_distance < place.squared_distance;
    if (best >= 0 && !nearer && !(other.squared_distance == place.squared_distance && item->second < best))
      continue;
    best = item->second;
    place = other;
  }
  const Edge& edge = tree_->edges[static_cast<std::size_t>(best)];
  return {edge.rank, edge.index, place.parameter};
}

std::vector<std::array<NodeId, 2>> boundary_edges_of(const Mesh& mesh) {
  std::vector<std::array<NodeId, 2>> edges;
  for (const BoundaryEdges& boundary : mesh.boundaries)
    edges.insert(edges.end(), boundary.edges.begin(), boundary.edges.end());
  return edges;
}

}  // namespace quadloop
