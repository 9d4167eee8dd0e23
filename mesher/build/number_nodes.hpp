#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/cut/cut_forest.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Numbers the nodes of the cells that a cut forest holds, along the space-filling curve: a node belongs to
/// the first leaf along the curve that touches it, and a leaf's nodes follow each other in a fixed order; so
/// the numbers do not depend on the number of ranks.
class NodeNumbering {
 public:
  /// *Collective.*
  NodeNumbering(const Communicator& comm, const Lattice& lattice, const LeafGraph& graph,
                const CutForest& cut);

  /// How many nodes this rank owns.
  std::int32_t owned() const { return owned_; }
  /// How many nodes this rank's cells have, others' too.
  std::size_t size() const { return points_.size(); }
  /// The nodes at the lattice sites of an inside leaf, none in the middle of a side where nothing hangs.
  using SiteNodes = std::array<NodeId, lattice_sites.size()>;
  SiteNodes of_leaf(LeafId leaf) const;
  /// A node of a cut leaf, from its number in CutForest::nodes.
  NodeId of_cut(LeafId leaf, std::int32_t node) const;

  /// Hands points, owners and global numbers over to the mesh.
  void fill(Mesh& mesh) &&;

 private:
  /// The leaf that owns a node, and where it has it: at one of its corners, in the middle of its right or top
  /// side, or inside: in its list of cut nodes, where its position names it. Corners other than the upper
  /// right one only on the root's lower and left side, where there is no leaf before it.
  struct Home {
    LeafId leaf;
    Site site = Site::north_east;
  };
  struct Request {
    int rank = 0;
    std::int32_t leaf = 0;  ///< its local index there
    Site site = Site::north_east;
    Point position;  ///< of a listed node
    friend auto operator<=>(const Request&, const Request&) = default;
  };

  Home home_of_site(LeafId leaf, Site site) const;
  Home home_of_cut_node(LeafId leaf, const CutLeaf::Node& node) const;
  Home corner_home(LeafId owner, LatticePoint p) const;
  Home home_of(const Request& asked) const { return {graph_->from_local(asked.leaf), asked.site}; }
  void sort_listed();
  std::int32_t listed_node(LeafId leaf, Point position) const;
  std::int32_t number_at(Home home, Point position) const;
  std::int32_t number_at_site(Home home) const;
  NodeId find(Home home, Point position = {}) const;

  /// Whether it is a local leaf with one node beside its listed ones, as most are: that need not be told from
  /// others.
  bool owns_one(LeafId leaf) const;

  void use(Home home, Point position = {});
  void use_local(Home home, Point position);
  void use_cut(LeafId leaf, std::int32_t node);
  void use_nodes_of_cells();
  void use_nodes_of_inside(LeafId leaf);
  bool uses_its_own(LeafId leaf) const;
  std::vector<int> ranks_wanted();
  void number_owned();
  void place_moved();
  void fetch_copies(const Exchange& exchange, const std::vector<Request>& asked);
  Request request_of(Home home, Point position) const {
    const LeafGraph::Owner owner = graph_->owner_of(home.leaf);
    return {owner.rank, owner.index, home.site, home.site == Site::inside ? position : Point{}};
  }

  const Lattice* lattice_;
  const LeafGraph* graph_;
  const CutForest* cut_;
  std::vector<std::uint8_t> used_sites_;   ///< of each local leaf, a bit for each node that it owns, but
                                           ///< listed ones
  std::vector<std::int32_t> first_;        ///< of each local leaf, the number of the first node that it owns
  std::vector<std::int32_t> listed_;       ///< the numbers of CutForest::nodes
  std::vector<std::int32_t> by_position_;  ///< CutForest::nodes, sorted within each leaf that has many
  std::vector<Request> wanted_;            ///< from other ranks, sorted: the copies
  std::vector<Point> points_;
  std::int64_t first_node_ = 0;
  std::int32_t owned_ = 0;
  std::vector<GlobalNodeId> copies_;
};

}  // namespace quadloop
