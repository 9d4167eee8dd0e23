#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate_rules.hpp"

namespace quadloop {

namespace {

constexpr double turn_tolerance = 1e-4;  // degrees
constexpr double full_turn = 360;
using Segment = BoundarySegment;

/// Whether two boundary edges meet other than at a common end or as the two sides of a crack.
bool meet_wrongly(const Segment& s, const Segment& t) {
  const bool common_from = s.from == t.from || s.from == t.to, common_to = s.to == t.from || s.to == t.to;
  if (!common_from && !common_to) return segments_meet(s.from, s.to, t.from, t.to);
  if (common_from && common_to) return s.from == t.from;  // opposite directions: the sides of a crack
  const Point common = common_from ? s.from : s.to, s_end = common_from ? s.to : s.from;
  const Point t_end = common == t.from ? t.to : t.from;
  return on_segment(s_end, common, t_end) || on_segment(t_end, common, s_end);
}

/// Returns a point inside one cell of each connected component of the mesh.
std::vector<Point> piece_seeds(const Mesh& mesh) {
  IdVector<NodeId, NodeId> parent(mesh.points.size());
  std::ranges::copy(parent.ids(), parent.begin());
  const auto root = [&](NodeId node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  const auto join = [&](NodeId a, NodeId b) {
    const NodeId of_a = root(a), of_b = root(b);
    parent[std::max(of_a, of_b)] = std::min(of_a, of_b);
  };
  const auto join_nodes = [&](const auto& cells) {
    for (const auto& cell : cells) {
      for (std::size_t k = 1; k < cell.size(); ++k) join(cell[k - 1], cell[k]);
    }
  };
  join_nodes(mesh.triangles);
  join_nodes(mesh.quads);
  NodeFlags seen(mesh.points.size(), 0);
  std::vector<Point> seeds;
  const auto visit = [&](const auto& cells) {
    for (const auto& cell : cells) {
      char& known = seen[root(cell[0])];
      if (known == 0)
        seeds.push_back(1.0 / 3.0 * (mesh.point(cell[0]) + mesh.point(cell[1]) + mesh.point(cell[2])));
      known = 1;
    }
  };
  visit(mesh.triangles);
  visit(mesh.quads);
  return seeds;
}

/// Turns of the cells of positive corners around each node.
struct TurnsAround {
  /// Corners that contain the direction of x, including their first side.
  IdVector<NodeId, std::int32_t> crossings;
  IdVector<NodeId, double> degrees;  ///< at boundary nodes only

  TurnsAround(const Mesh& mesh, const NodeFlags& measured)
      : crossings(mesh.points.size(), 0), degrees(mesh.points.size(), 0) {
    add(mesh, measured, mesh.triangles);
    add(mesh, measured, mesh.quads);
  }

 private:
  template <class Cells>
  void add(const Mesh& mesh, const NodeFlags& measured, const Cells& cells) {
    for (const auto& cell : cells) {
      const std::size_t width = cell.size();
      for (std::size_t k = 0; k < width; ++k) {
        const Point previous = mesh.point(cell[(k + width - 1) % width]), p = mesh.point(cell[k]),
                    next = mesh.point(cell[(k + 1) % width]);
        crossings[cell[k]] += next.y <= p.y && previous.y > p.y ? 1 : 0;
        if (measured[cell[k]] != 0) degrees[cell[k]] += corner_degrees(previous, p, next);
      }
    }
  }
};

/// Around an inner node, cells of positive corners form a ring: they wind around it as often as they contain
/// any one direction, exactly. On the boundary only the angle can be checked.
void check_turns(const Mesh& mesh, const NodeFlags& on_boundary, Faults& faults) {
  const TurnsAround turns(mesh, on_boundary);
  for (const NodeId node : on_boundary.ids()) {
    const bool wrong =
        on_boundary[node] == 0 ? turns.crossings[node] > 1 : turns.degrees[node] > full_turn + turn_tolerance;
    if (wrong)
      faults.push_back(
          {MeshRule::overlap, "the cells around a node do not go round it once", mesh.point(node)});
  }
}

}  // namespace

void check_boundary_crossings(const std::vector<Segment>& segments, Faults& faults) {
  std::vector<Box> boxes;
  for (const Segment& s : segments) boxes.push_back(box_of(s.from, s.to));
  const BoxTree tree(boxes);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    tree.for_each_meeting(boxes[i], [&](std::int32_t number) {
      const std::size_t j = number;
      if (j <= i || !meet_wrongly(segments[i], segments[j])) return;
      faults.push_back({MeshRule::overlap, "two boundary edges meet", segments[i].from});
    });
  }
}

std::int32_t winding(const std::vector<Segment>& segments, Point p) {
  std::int32_t turns = 0;
  for (const Segment& s : segments) {
    const bool upward = s.from.y <= p.y && p.y < s.to.y, downward = s.to.y <= p.y && p.y < s.from.y;
    if (upward && orientation(s.from, s.to, p) > 0) ++turns;
    if (downward && orientation(s.from, s.to, p) < 0) --turns;
  }
  return turns;
}

void check_area(const Mesh& mesh, const MeshTopology& topology, Faults& faults) {
  Box box;
  for (const Point p : mesh.points) box.include(p);
  const Point origin = box.centre();
  long double cells = 0, enclosed = 0;
  const auto at = [&](NodeId node) { return mesh.point(node); };
  for (const auto& t : mesh.triangles) cells += cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])) / 2;
  for (const auto& q : mesh.quads) cells += cross(at(q[2]) - at(q[0]), at(q[3]) - at(q[1])) / 2;
  for (const auto& edge : topology.outer_edges())
    enclosed += cross(at(edge.from) - origin, at(edge.to) - origin) / 2;
  if (std::abs(cells - enclosed) <= area_tolerance * std::abs(enclosed)) return;
  faults.push_back({MeshRule::area,
                    "the cells cover " + std::to_string(static_cast<double>(cells)) +
                        ", the boundary encloses " + std::to_string(static_cast<double>(enclosed)),
                    origin});
}

void check_overlap(const Mesh& mesh, const MeshTopology& topology, Faults& faults) {
  NodeFlags at_edge(mesh.points.size(), 0);
  std::vector<Segment> segments;
  for (const auto& edge : topology.outer_edges()) {
    at_edge[edge.from] = 1;
    segments.push_back({mesh.point(edge.from), mesh.point(edge.to)});
  }
  const bool inverted = std::any_of(faults.begin(), faults.end(),
                                    [](const MeshFault& f) { return f.rule == MeshRule::positive; });
  if (!inverted) check_turns(mesh, at_edge, faults);  // around an inverted cell turns are meaningless
  check_boundary_crossings(segments, faults);
  const std::vector<Point> seeds = piece_seeds(mesh);
  for (const Point seed : seeds.size() < most_components ? seeds : std::vector<Point>{}) {
    const std::int32_t times = winding(segments, seed);
    if (times != 1)
      faults.push_back(
          {MeshRule::overlap, "the boundary goes " + std::to_string(times) + " times round a cell", seed});
  }
}

}  // namespace quadloop
