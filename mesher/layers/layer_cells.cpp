#include "mesher/layers/layer_cells.hpp"

#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

class CellMaker {
 public:
  CellMaker(const FrontColumns& columns, const Mesh& outside, const std::function<TieRank(Point)>& divide)
      : columns_{columns}, line_{columns.line()}, outside_{outside}, divide_{divide} {
    made_.edges.resize(outside.boundaries.size());
  }

  void add_edge(std::size_t boundary, const std::array<NodeId, 2>& edge, std::int32_t leaf);
  LayerCells made() && { return std::move(made_); }

 private:
  void add_strip(NodeId from, NodeId to, std::int32_t leaf);
  void add_ends(NodeId node, bool first, std::int32_t leaf);
  void add_cell(const std::vector<LayerNode>& corners, Point of_front, std::int32_t leaf);
  void add_divided(const std::vector<LayerNode>& corners, std::int32_t leaf);
  void use(const LayerNode& node) {
    if (!columns_.owns(node.id)) made_.foreign.emplace(node.id, node.point);
  }

  const FrontColumns& columns_;
  const WallLine& line_;
  const Mesh& outside_;
  const std::function<TieRank(Point)>& divide_;
  LayerCells made_;
};

void CellMaker::add_edge(std::size_t boundary, const std::array<NodeId, 2>& edge, std::int32_t leaf) {
  const auto [from, to] = edge;
  if (!columns_.is_front(edge)) {
    made_.edges[boundary].push_back({leaf, {columns_.numbered(from), columns_.numbered(to)}});
    return;
  }
  const std::int32_t fan = columns_.fan_of(from);
  if (fan != WallLine::none && fan == columns_.fan_of(to)) {
    for (const auto& corners : columns_.cells_of_sector(from)) add_cell(corners, outside_.point(from), leaf);
    return;
  }
  add_strip(from, to, leaf);
  made_.edges[boundary].push_back({leaf, {columns_.column(from).front().id, columns_.column(to).front().id}});
  const FrontPlace &first = columns_.place(from), &last = columns_.place(to);
  if (line_.previous(first.station) == WallLine::none && first.at_station()) add_ends(from, true, leaf);
  if (line_.next(last.station) == WallLine::none) add_ends(to, false, leaf);
}

/// The cells between two columns.
void CellMaker::add_strip(NodeId from, NodeId to, std::int32_t leaf) {
  const std::vector<LayerNode>&a = columns_.column(from), &b = columns_.column(to);
  for (std::size_t ring = 1; ring < a.size(); ++ring)
    add_cell({a[ring - 1], b[ring - 1], b[ring], a[ring]}, outside_.point(from), leaf);
}

/// The edges of the boundary on which the last column of a run lies.
void CellMaker::add_ends(NodeId node, bool first, std::int32_t leaf) {
  const Geometry& g = line_.geometry();
  const std::int32_t s = line_[columns_.place(node).station].segment;
  const BoundaryId boundary = g.boundary_of(first ? g.previous(s) : g.next(s));
  const std::vector<LayerNode>& nodes = columns_.column(node);
  for (std::size_t ring = 1; ring < nodes.size(); ++ring) {
    const std::size_t k = first ? nodes.size() - ring : ring;
    const GlobalNodeId low = nodes[k - 1].id, high = nodes[k].id;
    made_.edges[boundary.value()].push_back({leaf, first ? std::array{high, low} : std::array{low, high}});
  }
}

void CellMaker::add_cell(const std::vector<LayerNode>& corners, Point of_front, std::int32_t leaf) {
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    use(corners[k]);
    const Point a = corners[k].point, b = corners[(k + 1) % n].point, c = corners[(k + 2) % n].point;
    if (orientation(a, b, c) <= 0 && !made_.bad) made_.bad = of_front;
  }
  const auto id = [&](std::size_t k) { return corners[k].id; };
  if (n == 3)
    made_.triangles.push_back({leaf, {id(0), id(1), id(2)}});
  else if (divide_)
    add_divided(corners, leaf);
  else
    made_.quads.push_back({leaf, {id(0), id(1), id(2), id(3)}});
}

/// Two triangles; the third corner and the fourth one lie towards the front.
void CellMaker::add_divided(const std::vector<LayerNode>& corners, std::int32_t leaf) {
  const auto id = [&](std::size_t k) { return corners[k].id; };
  const Point one = corners[2].point - corners[0].point, other = corners[3].point - corners[1].point;
  const double first = dot(one, one), second = dot(other, other);
  const bool takes_first =
      first != second ? first < second : divide_(corners[2].point) > divide_(corners[3].point);
  if (takes_first) {
    made_.triangles.push_back({leaf, {id(0), id(1), id(2)}});
    made_.triangles.push_back({leaf, {id(0), id(2), id(3)}});
  } else {
    made_.triangles.push_back({leaf, {id(0), id(1), id(3)}});
    made_.triangles.push_back({leaf, {id(1), id(2), id(3)}});
  }
}

}  // namespace

LayerCells layer_cells(const FrontColumns& columns, const Mesh& outside,
                       const std::vector<std::vector<std::int32_t>>& edge_leaves,
                       const std::function<TieRank(Point)>& divide) {
  CellMaker maker(columns, outside, divide);
  for (std::size_t b = 0; b < outside.boundaries.size(); ++b) {
    const auto& edges = outside.boundaries[b].edges;
    for (std::size_t e = 0; e < edges.size(); ++e) maker.add_edge(b, edges[e], edge_leaves[b][e]);
  }
  return std::move(maker).made();
}

}  // namespace quadloop
