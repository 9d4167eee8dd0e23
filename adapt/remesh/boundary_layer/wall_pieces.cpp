#include "adapt/remesh/boundary_layer/wall_pieces.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace quadloop::adapt {

namespace {

constexpr double cosine_of_corner = 0.866;  // 30 degrees

/// A wall edge, known to all ranks.
struct EdgeOfWall {
  std::array<GlobalNodeId, 2> nodes;
  std::array<Point, 2> points;
  std::size_t wall = 0;
};

/// *Collective.*
std::vector<EdgeOfWall> edges_of(const Communicator& comm, const Mesh& mesh,
                                 std::span<const std::string> names) {
  std::vector<EdgeOfWall> own;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    const auto found = std::ranges::find(names, boundary.name);
    if (found == names.end()) continue;
    const auto wall = static_cast<std::size_t>(found - names.begin());
    for (const auto& [from, to] : boundary.edges)
      own.push_back({{mesh.global(from), mesh.global(to)}, {mesh.point(from), mesh.point(to)}, wall});
  }
  std::vector<EdgeOfWall> edges = comm.all_gather_values(std::span<const EdgeOfWall>(own));
  std::ranges::sort(edges, {}, &EdgeOfWall::nodes);
  return edges;
}

Point direction_of_edge(Point from, Point to) { return (1 / length(to - from)) * (to - from); }

/// For each edge the one that continues it on the same wall, unless there is a corner between them.
std::vector<std::optional<std::size_t>> continuations(const std::vector<EdgeOfWall>& edges) {
  std::map<GlobalNodeId, std::size_t> edge_from;
  for (std::size_t k = 0; k < edges.size(); ++k) edge_from.emplace(edges[k].nodes[0], k);
  std::vector<std::optional<std::size_t>> next(edges.size());
  std::vector<char> is_continued(edges.size(), 0);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const auto found = edge_from.find(edges[k].nodes[1]);
    if (found == edge_from.end() || is_continued[found->second]) continue;
    const EdgeOfWall& after = edges[found->second];
    const Point a = direction_of_edge(edges[k].points[0], edges[k].points[1]),
                b = direction_of_edge(after.points[0], after.points[1]);
    if (after.wall != edges[k].wall || dot(a, b) < cosine_of_corner) continue;
    next[k] = found->second;
    is_continued[found->second] = 1;
  }
  return next;
}

/// The median of the known ones among some values; 0 if most are unknown.
double median_of_known(std::vector<double> values) {
  const std::size_t all = values.size();
  std::erase(values, 0.0);
  if (2 * values.size() <= all) return 0;
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace

Point WallPiece::normal(std::size_t k) const {
  Point along;
  if (closed || k > 0) along = along + direction_of_edge(points[previous(k)], points[k]);
  if (closed || k + 1 < points.size()) along = along + direction_of_edge(points[k], points[next(k)]);
  return (1 / length(along)) * Point{-along.y, along.x};
}

std::vector<WallPiece> wall_pieces(const Communicator& comm, const Mesh& mesh,
                                   std::span<const std::string> names) {
  const std::vector<EdgeOfWall> edges = edges_of(comm, mesh, names);
  const auto next = continuations(edges);
  std::vector<char> continues(edges.size(), 0), is_taken(edges.size(), 0);
  for (const auto& after : next) {
    if (after) continues[*after] = 1;
  }
  std::vector<WallPiece> pieces;
  const auto add = [&](std::size_t first) {
    WallPiece piece{edges[first].wall, {edges[first].points[0]}, true};
    std::optional<std::size_t> edge = first;
    for (; edge && !is_taken[*edge]; edge = next[*edge]) {
      is_taken[*edge] = 1;
      piece.points.push_back(edges[*edge].points[1]);
    }
    piece.closed = edge.has_value();
    if (piece.closed) piece.points.pop_back();
    pieces.push_back(std::move(piece));
  };
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (!continues[k]) add(k);
  }
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (!is_taken[k]) add(k);
  }
  return pieces;
}

std::vector<double> smoothed(const WallPiece& piece, std::vector<double> values) {
  constexpr std::ptrdiff_t reach = 2;
  const std::ptrdiff_t size = std::ssize(values);
  const auto value_at = [&](const std::vector<double>& among, std::ptrdiff_t k) -> std::optional<double> {
    if (piece.closed) return among[(k + size) % size];
    if (k < 0 || k >= size) return {};
    return among[k];
  };
  std::vector<double> medians;
  for (std::ptrdiff_t k = 0; k < size; ++k) {
    std::vector<double> around;
    for (std::ptrdiff_t j = k - reach; j <= k + reach; ++j) {
      if (const auto value = value_at(values, j)) around.push_back(*value);
    }
    medians.push_back(median_of_known(std::move(around)));
  }
  for (int round = 0; round < 2; ++round) {
    values = medians;
    for (std::ptrdiff_t k = 0; k < size; ++k) {
      const auto or_own = [&](std::ptrdiff_t j) {
        const double value = value_at(values, j).value_or(0);
        return value > 0 ? value : values[k];
      };
      if (values[k] > 0) medians[k] = 0.25 * (or_own(k - 1) + or_own(k + 1)) + 0.5 * values[k];
    }
  }
  return medians;
}

}  // namespace quadloop::adapt
