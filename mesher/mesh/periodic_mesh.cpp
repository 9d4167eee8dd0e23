#include "mesher/mesh/periodic_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/mesh/node_table.hpp"
#include "mesher/mesh/paired_nodes.hpp"

namespace quadloop {

namespace {

/// What a node of a pair becomes: an image of one of the nodes that belong together.
struct NodeImage {
  GlobalNodeId original;  ///< as numbered in the given mesh
  Point place;            ///< of the original
  PeriodicShift shift = 0;
};

/// The nodes of all pairs; the same on every rank.
class NodesOfPairs {
 public:
  NodesOfPairs(const Communicator& comm, const Mesh& mesh, const PeriodicMaps& maps) {
    for (std::size_t p = 0; p < mesh.pairs.size(); ++p) {
      const PairedNodes nodes = paired_nodes(comm, mesh, mesh.pairs[p]);
      for (std::size_t i = 0; i < nodes.from.nodes.size(); ++i) {
        link(nodes.from.nodes[i], nodes.from.points[i], nodes.to.nodes[i], maps.of_pair(p));
        link(nodes.to.nodes[i], nodes.to.points[i], nodes.from.nodes[i], -maps.of_pair(p));
        nodes_[nodes.to.nodes[i]].is_target = true;
      }
    }
    for (const auto& [node, links] : nodes_) {
      if (!links.is_target) find_images_of(node);
    }
    for (const auto& [node, links] : nodes_) find_images_of(node);
    for (const auto& [node, image] : images_) {
      if (image.original != node) removed_.push_back(node);
    }
  }

  bool is_removed(GlobalNodeId node) const {
    const auto found = images_.find(node);
    return found != images_.end() && found->second.original != node;
  }
  const NodeImage& image(GlobalNodeId removed) const { return images_.at(removed); }
  /// Number of a remaining node among the remaining nodes.
  GlobalNodeId number(GlobalNodeId node) const {
    return GlobalNodeId{node.value() - (std::ranges::lower_bound(removed_, node) - removed_.begin())};
  }

 private:
  struct Links {
    Point place;
    bool is_target = false;  ///< on the side `to` of a pair
    std::vector<std::pair<GlobalNodeId, PeriodicShift>> partners;
  };

  void link(GlobalNodeId node, Point place, GlobalNodeId partner, PeriodicShift shift) {
    Links& links = nodes_[node];
    links.place = place;
    links.partners.emplace_back(partner, shift);
  }

  /// Makes all nodes linked with this one images of it, unless they are images of an earlier one.
  void find_images_of(GlobalNodeId first) {
    if (!images_.try_emplace(first, NodeImage{first, nodes_[first].place}).second) return;
    std::vector<GlobalNodeId> open{first};
    while (!open.empty()) {
      const GlobalNodeId node = open.back();
      open.pop_back();
      for (const auto& [partner, by] : nodes_[node].partners) {
        const PeriodicShift shift = images_[node].shift + by;
        const auto [at, is_new] = images_.try_emplace(partner, NodeImage{first, nodes_[first].place, shift});
        if (is_new) open.push_back(partner);
        if (at->second.shift != shift) refuse(nodes_[partner].place);
      }
    }
  }

  [[noreturn]] static void refuse(Point place) {
    throw InputError(
        fmt::format("the periodic pairs that meet at ({:.6g}, {:.6g}) map this node to itself or to another "
                    "node in two ways; let the pairs end elsewhere",
                    place.x, place.y));
  }

  std::map<GlobalNodeId, Links> nodes_;
  std::map<GlobalNodeId, NodeImage> images_;
  std::vector<GlobalNodeId> removed_;  ///< ascending
};

/// Fills in the nodes. Returns the new local number of each node of the given mesh.
IdVector<NodeId, NodeId> join_nodes(const Mesh& given, const NodesOfPairs& nodes, PeriodicMesh& joined) {
  Mesh& mesh = joined.mesh;
  IdVector<NodeId, NodeId> news(given.points.size());
  mesh.first_node = nodes.number(GlobalNodeId{given.first_node}).value();
  for (const NodeId node : news.ids()) {
    if (!given.owns(node) || nodes.is_removed(given.global(node))) continue;
    news[node] = NodeId{mesh.owned_nodes++};
    mesh.points.push_back(given.point(node));
  }
  joined.originals = mesh.points;
  NodeTable table(mesh);
  for (const NodeId node : news.ids()) {
    if (news[node].valid()) continue;
    const GlobalNodeId global = given.global(node);
    Point original = given.point(node), place = original;
    GlobalNodeId number;
    if (nodes.is_removed(global)) {
      const NodeImage& image = nodes.image(global);
      original = image.place;
      place = joined.maps.image(image.shift, original);
      number = image_number(nodes.number(image.original), image.shift);
    } else {
      number = nodes.number(global);
    }
    news[node] = table.local(number, place);
    if (mesh.points.size() > joined.originals.size()) joined.originals.push_back(original);
  }
  return news;
}

std::vector<OppositeSide> opposite_sides(const Mesh& mesh, const PeriodicMaps& maps) {
  std::vector<OppositeSide> opposite(mesh.boundaries.size());
  const auto of_name = [&](const std::string& name) {
    return static_cast<std::int32_t>(std::ranges::find(mesh.boundaries, name, &BoundaryEdges::name) -
                                     mesh.boundaries.begin());
  };
  for (std::size_t p = 0; p < mesh.pairs.size(); ++p) {
    const std::int32_t from = of_name(mesh.pairs[p].from), to = of_name(mesh.pairs[p].to);
    opposite[from] = {to, maps.of_pair(p)};
    opposite[to] = {from, -maps.of_pair(p)};
  }
  return opposite;
}

template <class Cells>
Cells renumbered(Cells cells, const IdVector<NodeId, NodeId>& news) {
  for (auto& nodes : cells) {
    for (NodeId& node : nodes) node = news[node];
  }
  return cells;
}

}  // namespace

PeriodicMesh join_pairs(const Communicator& comm, const Mesh& mesh, SideEdges edges) {
  PeriodicMesh joined;
  joined.maps = PeriodicMaps(mesh.pairs);
  const NodesOfPairs nodes(comm, mesh, joined.maps);
  const IdVector<NodeId, NodeId> news = join_nodes(mesh, nodes, joined);
  joined.opposite = opposite_sides(mesh, joined.maps);
  joined.mesh.triangles = renumbered(mesh.triangles, news);
  joined.mesh.quads = renumbered(mesh.quads, news);
  for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
    BoundaryEdges& copy = joined.mesh.boundaries.emplace_back(mesh.boundaries[b]);
    if (joined.opposite[b].exists() && edges == SideEdges::left_out)
      copy.edges.clear();
    else
      copy.edges = renumbered(std::move(copy.edges), news);
  }
  joined.mesh.blocks = mesh.blocks;
  joined.node_of = news;
  joined.node_of.resize(mesh.owned_nodes);
  return joined;
}

std::optional<PeriodicMesh> join_pairs_if_possible(const Communicator& comm, const Mesh& mesh,
                                                   SideEdges edges) {
  if (mesh.pairs.empty()) return {};
  try {
    return join_pairs(comm, mesh, edges);
  } catch (const InputError&) {  // the same on all ranks
    return {};
  }
}

}  // namespace quadloop
