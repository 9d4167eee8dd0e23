#include "adapt/metric/tile/tile_mesh.hpp"

#include <algorithm>
#include <limits>

#include "mesher/base/error.hpp"

namespace quadloop::adapt {

TileMesh::TileMesh(const std::vector<TileNode>& nodes, std::vector<TileTriangle> triangles,
                   const Walls& walls)
    : walls_{walls},
      nodes_{nodes},
      freedom_(nodes.size(), Freedom::free),
      boundaries_(nodes.size(), -1),
      stars_(nodes.size()),
      triangles_{std::move(triangles)},
      standing_(triangles_.size(), 1) {
  metrics_.reserve(nodes_.size());
  for (const TileNode& node : nodes_) metrics_.push_back(exp_of(node.metric));
  for (std::int32_t t = 0; t < this->triangles(); ++t) {
    for (const std::int32_t n : triangles_[t].nodes) stars_[n].push_back(t);
  }
  lock_rim();
  lock_walls();
  for (std::int32_t n = 0; n < this->nodes(); ++n) set_freedom(n);
}

int TileMesh::corner(std::int32_t t, std::int32_t n) const {
  const auto& nodes = triangles_[t].nodes;
  return nodes[0] == n ? 0 : nodes[1] == n ? 1 : nodes[2] == n ? 2 : -1;
}

/// Locks edges with one triangle that are on no boundary.
void TileMesh::lock_rim() {
  for (TileTriangle& t : triangles_) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (t.sides[k].boundary < 0 && edge(t.nodes[k], t.nodes[(k + 1) % 3])->right < 0)
        t.sides[k].locked = true;
    }
  }
}

void TileMesh::lock_walls() {
  for (TileTriangle& t : triangles_) {
    for (std::size_t k = 0; k < 3; ++k) {
      TileSide& side = t.sides[k];
      if (side.boundary >= 0 && !walls_.may_change(chord(t.nodes[k], t.nodes[(k + 1) % 3], side.boundary)))
        side.locked = true;
    }
  }
}

/// A node is free if no edge at it is locked or on a boundary. It slides if it has exactly two boundary
/// edges, of the same boundary and not locked, and is no kept point. Otherwise it is fixed.
void TileMesh::set_freedom(std::int32_t n) {
  int on_wall = 0;
  std::int32_t boundary = -1;
  bool fixed = false;
  for (const std::int32_t t : stars_[n]) {
    const auto k = static_cast<std::size_t>(corner(t, n));
    for (const std::size_t at : {k, (k + 2) % 3}) {
      const TileSide& side = triangles_[t].sides[at];
      fixed = fixed || side.locked;
      if (side.boundary < 0) continue;
      fixed = fixed || (on_wall > 0 && boundary != side.boundary);
      boundary = side.boundary;
      ++on_wall;
    }
  }
  if (fixed || (on_wall != 0 && (on_wall != 2 || walls_.is_kept(point(n), boundary)))) {
    freedom_[n] = Freedom::fixed;
  } else if (on_wall == 2) {
    freedom_[n] = Freedom::slides;
    boundaries_[n] = boundary;
  }
}

double TileMesh::quality(const std::array<std::int32_t, 3>& n, const std::array<Point, 3>& at) const {
  const Symmetric mean = 1.0 / 3 * (metrics_[n[0]] + metrics_[n[1]] + metrics_[n[2]]);
  return quality_in(mean, at[0], at[1], at[2]);
}

double TileMesh::worst_round(std::int32_t n) const {
  double worst = 1;
  for (const std::int32_t t : stars_[n]) worst = std::min(worst, quality(t));
  return worst;
}

std::optional<TileMesh::Edge> TileMesh::edge(std::int32_t a, std::int32_t b) const {
  Edge found{a, b, -1, -1, {}};
  for (const std::int32_t t : stars_[a]) {
    const int k = corner(t, a), l = corner(t, b);
    if (l < 0) continue;
    const bool forward = (k + 1) % 3 == l;
    (forward ? found.left : found.right) = t;
    found.side = triangles_[t].sides[forward ? k : l];
  }
  if (found.left < 0 && found.right < 0) return {};
  if (found.left < 0) {
    std::swap(found.a, found.b);
    std::swap(found.left, found.right);
  }
  return found;
}

std::vector<std::array<std::int32_t, 2>> TileMesh::edges() const {
  std::vector<std::array<std::int32_t, 2>> all;
  for (std::int32_t t = 0; t < triangles(); ++t) {
    if (!stands(t)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = triangles_[t].nodes[k], b = triangles_[t].nodes[(k + 1) % 3];
      if (a < b || edge(a, b)->right < 0) all.push_back({a, b});
    }
  }
  return all;
}

Walls::Chord TileMesh::chord(std::int32_t a, std::int32_t b, std::int32_t boundary) const {
  return {walls_.place_of(point(a), boundary), walls_.place_of(point(b), boundary), point(a), point(b)};
}

std::array<std::int32_t, 2> TileMesh::neighbours_on_wall(std::int32_t n) const {
  std::array<std::int32_t, 2> found{-1, -1};
  for (const std::int32_t t : stars_[n]) {
    const auto k = static_cast<std::size_t>(corner(t, n));
    if (triangles_[t].sides[k].boundary >= 0) found[1] = triangles_[t].nodes[(k + 1) % 3];
    if (triangles_[t].sides[(k + 2) % 3].boundary >= 0) found[0] = triangles_[t].nodes[(k + 2) % 3];
  }
  return found;
}

std::vector<std::int32_t> TileMesh::neighbours(std::int32_t n) const {
  std::vector<std::int32_t> found;
  for (const std::int32_t t : stars_[n]) {
    for (const std::int32_t other : triangles_[t].nodes) {
      if (other != n) found.push_back(other);
    }
  }
  std::ranges::sort(found);
  found.erase(std::ranges::unique(found).begin(), found.end());
  return found;
}

std::int32_t TileMesh::add_node(Point p, const LogMetric& metric, Freedom freedom, std::int32_t boundary) {
  nodes_.push_back({-1, p, metric});
  metrics_.push_back(exp_of(metric));
  freedom_.push_back(freedom);
  boundaries_.push_back(boundary);
  stars_.emplace_back();
  return nodes() - 1;
}

void TileMesh::move_node(std::int32_t n, Point p, const LogMetric& metric) {
  nodes_[n].point = p;
  nodes_[n].metric = metric;
  metrics_[n] = exp_of(metric);
}

void TileMesh::add_triangle(const TileTriangle& triangle) {
  for (const std::int32_t n : triangle.nodes) stars_[n].push_back(triangles());
  triangles_.push_back(triangle);
  standing_.push_back(1);
}

void TileMesh::remove_triangle(std::int32_t t) {
  for (const std::int32_t n : triangles_[t].nodes) std::erase(stars_[n], t);
  standing_[t] = 0;
}

void TileMesh::replace_node(std::int32_t t, std::int32_t from, std::int32_t to) {
  triangles_[t].nodes[static_cast<std::size_t>(corner(t, from))] = to;
  std::erase(stars_[from], t);
  stars_[to].push_back(t);
}

void TileMesh::set_side(std::int32_t a, std::int32_t b, const TileSide& side) {
  const auto found = edge(a, b);
  for (const std::int32_t t : {found->left, found->right}) {
    if (t < 0) continue;
    const auto k = static_cast<std::size_t>(corner(t, t == found->left ? found->a : found->b));
    triangles_[t].sides[k] = side;
  }
}

}  // namespace quadloop::adapt
