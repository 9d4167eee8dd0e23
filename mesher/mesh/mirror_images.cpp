#include "mesher/mesh/mirror_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "mesher/base/error.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

std::array<std::uint64_t, 2> key_of(Point p) {
  return {std::bit_cast<std::uint64_t>(p.x + 0.0), std::bit_cast<std::uint64_t>(p.y + 0.0)};  // -0 becomes 0
}

/// Throws the same error on every rank if any rank has a point `lacking` an image, naming the first of all.
/// *Collective.*
void refuse_lacking(const Communicator& comm, MirrorAxis axis, const char* what, Point lacking) {
  Point first{nowhere, nowhere};
  for (const Point p : comm.all_gather(lacking)) first = std::min(first, p);
  if (first.x != nowhere) refuse_without_image(axis, what, first);
}

/// Sorted, so that the key does not depend on the cell's first node or orientation.
template <std::size_t width>
PairKey<width> key_of(const Mesh& mesh, const NodeImages& images, const std::array<NodeId, width>& cell) {
  PairKey<width> key;
  for (std::size_t k = 0; k < width; ++k) {
    key.own[k] = static_cast<std::uint64_t>(mesh.global(cell[k]).value());
    key.partner[k] = static_cast<std::uint64_t>(images[cell[k]].value());
  }
  std::ranges::sort(key.own);
  std::ranges::sort(key.partner);
  return key;
}

template <std::size_t width>
std::vector<Partner> find_cell_images(const Communicator& comm, const Mesh& mesh, const NodeImages& images,
                                      MirrorAxis axis, const std::vector<std::array<NodeId, width>>& cells) {
  std::vector<PairKey<width>> keys;
  keys.reserve(cells.size());
  for (const auto& cell : cells) keys.push_back(key_of(mesh, images, cell));
  std::vector<Partner> partners = find_partners<width>(comm, keys);
  Point lacking{nowhere, nowhere};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (partners[i].found()) continue;
    for (const NodeId node : cells[i]) lacking = std::min(lacking, mesh.point(node));
  }
  refuse_lacking(comm, axis, "cell", lacking);
  return partners;
}

}  // namespace

void refuse_without_image(MirrorAxis axis, const char* what, Point place) {
  throw InputError(
      fmt::format("mesh.mirror: the {} at ({}, {}) has no mirror image about the {}-axis: a [[source]] or "
                  "mesh.root is not symmetric, or the geometry passes a grid vertex at two equal distances; "
                  "make them symmetric, change mesh.snap slightly, or remove mesh.mirror",
                  what, place.x, place.y, name_of(axis)));
}

NodeImages node_images(const Communicator& comm, std::int64_t first_node, std::span<const Point> owned,
                       MirrorAxis axis) {
  std::vector<PairKey<2>> keys;
  keys.reserve(owned.size());
  for (const Point p : owned) keys.push_back({key_of(p), key_of(image_of(axis, p))});
  const RankRanges nodes(comm, first_node);
  NodeImages images;
  images.reserve(owned.size());
  for (const Partner& partner : find_partners<2>(comm, keys))
    images.push_back(partner.found() ? GlobalNodeId{nodes.begin(partner.rank) + partner.item}
                                     : GlobalNodeId{});
  return images;
}

NodeImages find_node_images(const Communicator& comm, const Mesh& mesh, MirrorAxis axis) {
  NodeImages images =
      node_images(comm, mesh.first_node, std::span(mesh.points).first(mesh.owned_nodes), axis);
  Point lacking{nowhere, nowhere};
  for (const NodeId node : images.ids()) {
    if (!images[node].valid()) lacking = std::min(lacking, mesh.point(node));
  }
  refuse_lacking(comm, axis, "node", lacking);
  images.resize(mesh.points.size());
  NodeExchange(comm, NodeOwners(comm, mesh.first_node), mesh.owned_nodes, mesh.ghosts).update(images);
  return images;
}

std::vector<Partner> find_triangle_images(const Communicator& comm, const Mesh& mesh,
                                          const NodeImages& images, MirrorAxis axis) {
  return find_cell_images(comm, mesh, images, axis, mesh.triangles);
}

void require_mirror_images(const Communicator& comm, const Mesh& mesh, MirrorAxis axis) {
  const NodeImages images = find_node_images(comm, mesh, axis);
  find_cell_images(comm, mesh, images, axis, mesh.triangles);
  find_cell_images(comm, mesh, images, axis, mesh.quads);
}

}  // namespace quadloop
