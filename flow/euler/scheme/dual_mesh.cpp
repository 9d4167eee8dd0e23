#include "flow/euler/scheme/dual_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "flow/euler/scheme/skewness.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/turn.hpp"

namespace quadloop::flow::euler {

namespace {

/// Order of the nodes: by number, images after their original.
using NodeKey = std::pair<GlobalNodeId, GlobalNodeId>;
NodeKey key_of_node(const HaloMesh& mesh, NodeId node) { return {mesh.global(node), mesh.image(node)}; }

/// Contribution of one cell to the dual face of an edge.
struct Facet {
  NodeKey low_key, high_key;
  NodeId low, high;
  Point normal;                        ///< its length is that of the facet
  Skewness of_middle, left_over, sum;  ///< as in SkewFace
};

template <class Nodes>
Point centre_of(const HaloMesh& mesh, const Nodes& nodes) {
  Point sum = mesh.point(nodes[0]);
  for (std::size_t k = 1; k < nodes.size(); ++k) sum = sum + mesh.point(nodes[k]);
  return (1.0 / size32(nodes)) * sum;
}

Point middle(Point a, Point b) { return 0.5 * (a + b); }

/// Rotates by 90 degrees clockwise.
Point turned(Point v) { return {v.y, -v.x}; }

/// Returns the facet of the edge from node a to node b of a counter-clockwise cell.
Facet facet_of(const HaloMesh& mesh, NodeId a, NodeId b, Point centre, bool is_quad) {
  const NodeKey key_a = key_of_node(mesh, a), key_b = key_of_node(mesh, b);
  const double side = key_a < key_b ? 1 : -1;
  const Point along = mesh.point(b) - mesh.point(a), across = centre - middle(mesh.point(a), mesh.point(b)),
              normal = side * turned(across);
  Facet facet{key_a, key_b, a, b, normal, {}, {}, {}};
  // half by the facet's own midpoint; the rest is what each triangle passes on from one edge to the next
  if (is_quad) {
    facet.of_middle = {0.5 * across.x * normal, 0.5 * across.y * normal};
    facet.left_over = {side * along.x / 24 * turned(along), side * along.y / 24 * turned(along)};
    facet.sum = facet.of_middle + facet.left_over;
  }
  if (side < 0) {
    std::swap(facet.low_key, facet.high_key);
    std::swap(facet.low, facet.high);
  }
  return facet;
}

/// Adds up the facets of an edge.
void add(const Facet& facet, Facet& sum) {
  sum.normal = sum.normal + facet.normal;
  sum.of_middle = sum.of_middle + facet.of_middle;
  sum.left_over = sum.left_over + facet.left_over;
  sum.sum = sum.sum + facet.sum;
}

/// Relative to the squared edge length; less is rounding.
constexpr double least_skew = 1e-10;

/// Returns twice the area of a quadrilateral.
double twice_area(const std::array<Point, 4>& p) { return cross(p[2] - p[0], p[3] - p[1]); }

[[noreturn]] void refuse_edge(const char* what, Point a, Point b, const char* fault) {
  const Point at = middle(a, b);
  throw InputError(fmt::format("the mesh's {} at ({:.6g}, {:.6g}) {}", what, at.x, at.y, fault));
}

}  // namespace

DualMesh::DualMesh(const Communicator& comm, const Mesh& mesh)
    : DualMesh(comm, HaloMesh(comm, mesh), mesh.first_node, nullptr) {}

DualMesh::DualMesh(const Communicator& comm, const PeriodicMesh& joined)
    : DualMesh(comm, HaloMesh(comm, joined), joined.mesh.first_node, &joined.maps) {}

DualMesh::DualMesh(const Communicator& comm, HaloMesh halo, std::int64_t first_node, const PeriodicMaps* maps)
    : halo_{std::move(halo)}, first_node_{first_node} {
  if (maps != nullptr) {
    for (const NodeId node : ids()) {
      const double degrees = maps->degrees(shift_of(halo_.image(node)));
      if (degrees != 0) turned_.push_back({node, unit_vector(degrees)});
    }
  }
  add_areas();
  collect_edges();
  comm.together([&] { collect_faces(); });
  open_ = {};
}

void DualMesh::add_areas() {
  areas_.resize(owned_nodes(), 0);
  halo_.for_each_cell([&](const auto& nodes) {
    const Point centre = centre_of(halo_, nodes);
    const std::size_t n = nodes.size();
    for (std::size_t k = 0; k < n; ++k) {
      const NodeId node = nodes[k];
      if (!halo_.owns(node)) continue;
      const Point p = halo_.point(node), before = halo_.point(nodes[(k + n - 1) % n]),
                  after = halo_.point(nodes[(k + 1) % n]);
      areas_[node] += 0.5 * twice_area({p, middle(p, after), centre, middle(before, p)});
    }
  });
}

void DualMesh::collect_edges() {
  std::vector<Facet> facets;
  halo_.for_each_cell([&](const auto& nodes) {
    const Point centre = centre_of(halo_, nodes);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const NodeId a = nodes[k], b = nodes[(k + 1) % nodes.size()];
      if (halo_.owns(a) || halo_.owns(b)) facets.push_back(facet_of(halo_, a, b, centre, nodes.size() == 4));
    }
  });
  std::stable_sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) {
    return std::tie(a.low_key, a.high_key) < std::tie(b.low_key, b.high_key);
  });
  std::vector<SkewFace> skew;
  for (std::size_t i = 0; i < facets.size();) {
    Facet sum = facets[i];
    std::size_t end = i + 1;
    for (; end < facets.size() && facets[end].low == sum.low && facets[end].high == sum.high; ++end)
      add(facets[end], sum);
    const double size = length(sum.normal);
    const Point edge = halo_.point(sum.high) - halo_.point(sum.low),
                normal = size > 0 ? (1 / size) * sum.normal : Point{};
    edges_.push_back({sum.low, sum.high, normal, size, 0.5 * edge});
    skew.push_back({edge, size, normal, sum.of_middle, sum.left_over, sum.sum});
    open_.push_back(end == i + 1 ? 1 : 0);
    i = end;
  }
  collect_skew_edges(skew);
}

void DualMesh::collect_skew_edges(const std::vector<SkewFace>& faces) {
  IdVector<NodeId, Nearness> nearness(nodes());
  for (const DualEdge& edge : edges_) {
    nearness[edge.low].add(2.0 * edge.half);
    nearness[edge.high].add(2.0 * edge.half);
  }
  update(nearness);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const DualEdge& edge = edges_[e];
    const auto [with_x, with_y] = bearable(faces[e], nearness[edge.low], nearness[edge.high]);
    const double skew = std::max(length(with_x), length(with_y));
    if (skew > least_skew * dot(edge.half, edge.half)) skew_edges_.push_back({e, with_x, with_y});
  }
}

void DualMesh::collect_faces() {
  std::vector<HaloEdge> outline = halo_.boundary_edges();
  std::erase_if(outline, [&](const HaloEdge& e) { return !halo_.owns(e.from) && !halo_.owns(e.to); });
  const auto key = [&](NodeId a, NodeId b) {
    return std::minmax({key_of_node(halo_, a), key_of_node(halo_, b)});
  };
  const auto key_of = [&](const DualEdge& edge) { return key(edge.low, edge.high); };
  std::sort(outline.begin(), outline.end(),
            [&](const HaloEdge& a, const HaloEdge& b) { return key(a.from, a.to) < key(b.from, b.to); });
  for (const HaloEdge& e : outline) {
    const auto wanted = key(e.from, e.to);
    const auto found =
        std::lower_bound(edges_.begin(), edges_.end(), wanted,
                         [&](const DualEdge& edge, const auto& at) { return key_of(edge) < at; });
    const Point from = halo_.point(e.from), to = halo_.point(e.to);
    if (found == edges_.end() || key_of(*found) != wanted)
      refuse_edge("boundary edge", from, to, "belongs to no cell; generate the mesh again");
    char& open = open_[found - edges_.begin()];
    if (open == 0) {
      refuse_edge("boundary edge", from, to,
                  "has cells on both sides or occurs twice, but the flow solver requires a single domain; "
                  "mesh without it");
    }
    const Point outward = turned(to - from);
    const double size = length(outward);
    faces_.push_back(
        {e.from, e.to, e.boundary, (1 / size) * outward, 0.5 * size, share_left_over(size, found->size)});
    open = 0;
  }
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (open_[i] != 0) {
      refuse_edge("edge", point(edges_[i].low), point(edges_[i].high),
                  "has a cell on one side only but is on no boundary; add a boundary there");
    }
  }
}

}  // namespace quadloop::flow::euler
