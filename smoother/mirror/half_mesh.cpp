#include "smoother/mirror/half_mesh.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/node_table.hpp"

namespace quadloop::smoother {

HalfMesh::HalfMesh(const Communicator& comm, const Mesh& whole, MirrorAxis axis, const std::string& axis_name,
                   bool flips)
    : comm_{comm},
      whole_{whole},
      axis_{axis},
      flips_{flips},
      images_{find_node_images(comm, whole, axis)},
      in_half_(whole.points.size()) {
  if (flips) triangle_images_ = find_triangle_images(comm, whole, images_, axis);
  take_nodes();
  for (const auto& nodes : whole.triangles) stays_.push_back(side_of_cell(nodes) == Side::across ? 1 : 0);
  take_cells(whole.triangles, half_.triangles, triangles_);
  take_cells(whole.quads, half_.quads, quads_);
  take_boundaries(axis_name);
}

/// Takes the nodes of the half, those on the axis included.
void HalfMesh::take_nodes() {
  IdVector<NodeId, GlobalNodeId> number(whole_.points.size());
  std::int64_t owned = 0;
  for (const NodeId node : ids_below(NodeId{whole_.owned_nodes}))
    owned += side_of(axis_, whole_.point(node)) >= 0 ? 1 : 0;
  half_.first_node = comm_.exclusive_sum(owned);
  for (const NodeId node : in_half_.ids()) {
    if (side_of(axis_, whole_.point(node)) < 0) continue;
    in_half_[node] = NodeId{size32(half_.points)};
    half_.points.push_back(whole_.point(node));
    if (!whole_.owns(node)) continue;
    number[node] = GlobalNodeId{half_.first_node + in_half_[node].value()};
    owned_in_whole_.push_back(node);
  }
  half_.owned_nodes = size32(owned_in_whole_);
  NodeExchange(comm_, NodeOwners(comm_, whole_.first_node), whole_.owned_nodes, whole_.ghosts).update(number);
  for (const NodeId copy : ids_between(NodeId{whole_.owned_nodes}, NodeId{size32(number)})) {
    if (number[copy].valid()) half_.ghosts.push_back(number[copy]);
  }
}

template <std::size_t width>
HalfMesh::Side HalfMesh::side_of_cell(const std::array<NodeId, width>& cell) const {
  int least = 1, most = -1;
  for (const NodeId node : cell) {
    const int side = side_of(axis_, whole_.point(node));
    least = std::min(least, side);
    most = std::max(most, side);
  }
  if (least < 0 && most > 0) return Side::across;
  return most > 0 ? Side::half : Side::image;
}

template <std::size_t width>
void HalfMesh::take_cells(const std::vector<std::array<NodeId, width>>& cells,
                          std::vector<std::array<NodeId, width>>& taken, std::vector<std::int32_t>& numbers) {
  for (std::int32_t i = 0; i < std::ssize(cells); ++i) {
    const Side side = side_of_cell(cells[i]);
    if (side == Side::across) {
      for (const NodeId node : cells[i]) across_.push_back(whole_.global(node));
    }
    if (side != Side::half) continue;
    auto& nodes = taken.emplace_back();
    for (std::size_t k = 0; k < width; ++k) nodes[k] = in_half_[cells[i][k]];
    numbers.push_back(i);
  }
}

void HalfMesh::take_boundaries(const std::string& axis_name) {
  const auto in_half = [&](const std::array<NodeId, 2>& edge) {
    return std::array{in_half_[edge[0]], in_half_[edge[1]]};
  };
  for (const BoundaryEdges& boundary : whole_.boundaries) {
    half_.boundaries.push_back({boundary.name, boundary.condition, {}, boundary.layers});
    BoundaryEdges& taken = half_.boundaries.back();
    for (const auto& edge : boundary.edges) {
      const auto nodes = in_half(edge);
      if (nodes[0].valid() && nodes[1].valid()) taken.edges.push_back(nodes);
    }
  }
  BoundaryEdges& along = half_.boundaries.emplace_back();
  along.name = axis_name;
  const auto add_sides = [&](const auto& cells) {
    for (const auto& cell : cells) {
      for (std::size_t k = 0; k < cell.size(); ++k) {
        const NodeId from = cell[k], to = cell[(k + 1) % cell.size()];
        if (side_of(axis_, half_.point(from)) == 0 && side_of(axis_, half_.point(to)) == 0)
          along.edges.push_back({from, to});
      }
    }
  };
  add_sides(half_.triangles);
  add_sides(half_.quads);
}

NodeFlags HalfMesh::pinned(const NodeFlags& of_whole) const {
  NodeFlags flags = of_whole;
  flags.resize(whole_.owned_nodes, 0);
  std::vector<GlobalNodeId> more = across_;
  for (const NodeId node : flags.ids()) {
    if (flags[node] != 0) more.push_back(images_[node]);
  }
  flag_at_owners(comm_, NodeOwners(comm_, whole_.first_node), more, flags);
  NodeFlags of_half;
  of_half.reserve(owned_in_whole_.size());
  for (const NodeId node : owned_in_whole_) of_half.push_back(flags[node]);
  return of_half;
}

std::vector<std::int32_t> HalfMesh::reflect(const std::vector<std::int32_t>& standing, Mesh& whole) const {
  reflect_positions(whole);
  return flips_ ? reflect_triangles(standing, whole) : std::vector<std::int32_t>{};
}

void HalfMesh::reflect_positions(Mesh& whole) const {
  for (const NodeId node : ids_below(NodeId{half_.owned_nodes}))
    whole.points[owned_in_whole_[node.value()].value()] = half_.point(node);
  const NodeOwners owners(comm_, whole.first_node);
  std::vector<NodeId> on_other_side;
  std::vector<int> ranks;
  std::vector<GlobalNodeId> images;
  for (const NodeId node : ids_below(NodeId{whole.owned_nodes})) {
    if (in_half_[node].valid()) continue;
    on_other_side.push_back(node);
    images.push_back(images_[node]);
    ranks.push_back(owners.rank_of(images_[node]));
  }
  const Exchange exchange(comm_, ranks);
  std::vector<Point> points;
  for (const GlobalNodeId asked : exchange.deliver(images))
    points.push_back(whole.point(owners.local(asked)));
  points = exchange.answer(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    whole.points[on_other_side[i].value()] = image_of(axis_, points[i]);
  NodeExchange(comm_, owners, whole.owned_nodes, whole.ghosts).update(whole.points);
}

HalfMesh::NodesOfHalf HalfMesh::nodes_of_half() const {
  NodesOfHalf nodes{IdVector<NodeId, GlobalNodeId>(half_.points.size()),
                    IdVector<NodeId, GlobalNodeId>(half_.points.size())};
  for (const NodeId node : ids_below(NodeId{half_.owned_nodes})) {
    const NodeId in_whole = owned_in_whole_[node.value()];
    nodes.own[node] = whole_.global(in_whole);
    nodes.image[node] = images_[in_whole];
  }
  const NodeExchange exchange(comm_, NodeOwners(comm_, half_.first_node), half_.owned_nodes, half_.ghosts);
  exchange.update(nodes.own);
  exchange.update(nodes.image);
  return nodes;
}

namespace {

/// A triangle and its slot in the whole mesh, with node numbers of the whole.
struct PlacedTriangle {
  std::int64_t slot;
  std::array<GlobalNodeId, 3> nodes;
  std::array<Point, 3> points;
};

/// Stores the triangles in their slots, in the order given. Slots without a triangle keep their content.
void put_in_slots(const std::vector<PlacedTriangle>& placed, const std::vector<std::int32_t>& standing,
                  const std::vector<char>& stays, Mesh& whole) {
  std::vector<std::int64_t> next(standing.size() + 1, 0);
  for (std::size_t i = 0; i < standing.size(); ++i) next[i + 1] = next[i] + standing[i];
  std::vector<std::array<NodeId, 3>> triangles(next.back());
  for (std::size_t i = 0; i < standing.size(); ++i) {
    if (stays[i] != 0) triangles[next[i]] = whole.triangles[i];
  }
  NodeTable table(whole);
  for (const PlacedTriangle& t : placed) {
    auto& triangle = triangles[next[t.slot]++];
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = table.local(t.nodes[k], t.points[k]);
  }
  whole.triangles = std::move(triangles);
}

}  // namespace

std::vector<std::int32_t> HalfMesh::reflect_triangles(const std::vector<std::int32_t>& standing,
                                                      Mesh& whole) const {
  const NodesOfHalf nodes = nodes_of_half();
  std::vector<PlacedTriangle> placed;
  Outbox<PlacedTriangle> reflected;
  std::size_t next = 0;
  for (std::size_t slot = 0; slot < triangles_.size(); ++slot) {
    const Partner& partner = triangle_images_[triangles_[slot]];
    const std::size_t end = next + (standing.empty() ? 1 : standing[slot]);
    for (; next < end; ++next) {
      const auto& [a, b, c] = half_.triangles[next];
      const std::array points{half_.point(a), half_.point(b), half_.point(c)};
      placed.push_back({triangles_[slot], {nodes.own[a], nodes.own[b], nodes.own[c]}, points});
      reflected.add(partner.rank,
                    {partner.item,
                     {nodes.image[a], nodes.image[c], nodes.image[b]},
                     {image_of(axis_, points[0]), image_of(axis_, points[2]), image_of(axis_, points[1])}});
    }
  }
  const std::vector<PlacedTriangle> arrived = reflected.deliver(comm_);
  placed.insert(placed.end(), arrived.begin(), arrived.end());
  std::vector<std::int32_t> standing_in_whole(stays_.begin(), stays_.end());
  for (const PlacedTriangle& t : placed) ++standing_in_whole[t.slot];
  put_in_slots(placed, standing_in_whole, stays_, whole);
  return standing_in_whole;
}

}  // namespace quadloop::smoother
