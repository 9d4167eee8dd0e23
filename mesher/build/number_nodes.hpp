#pragma once

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
  /// The node at a lattice site of an inside leaf.
  NodeId of_leaf(LeafId leaf, Site site) const;
  /// A node of a cut leaf, from its number in CutForest::nodes.
  NodeId of_cut(LeafId leaf, std::int32_t node) const;

  /// Hands points, owners and global numbers over to the mesh.
  void fill(Mesh& mesh) &&;

 private:
  /// The leaf that owns a node, and where it has it: at one of its corners, in the middle of its right or top
  /// side, or inside: in its list of cut nodes. Corners other than the upper right one only on the root's
  /// lower and left side, where there is no leaf before it.
  struct Home {
    LeafId leaf;
    Site site = Site::north_east;
    Point position;  ///< names a listed node
  };
  struct Request {
    int rank = 0;
    std::int32_t leaf = 0;  ///< its local index there
    Site site = Site::north_east;
    Point position;
    friend auto operator<=>(const Request&, const Request&) = default;
  };

  Home home_of_site(LeafId leaf, Site site) const;
  Home home_of_cut_node(LeafId leaf, const CutLeaf::Node& node) const;
  Home corner_home(LeafId owner, LatticePoint p) const;
  std::size_t slot_of(const Home& home) const;
  std::size_t border_slot(std::size_t border_leaf) const { return 3 * (cut_->states.size() + border_leaf); }
  std::size_t listed_slot(std::int32_t node) const;
  /// The slot of a local node.
  std::int32_t& slot_at(const Home& home) { return slots_[slot_of(home)]; }
  std::int32_t listed_node(LeafId leaf, Point position) const;
  NodeId find(const Home& home) const;

  void use(const Home& home);
  void use_nodes_of_cells();
  void use_nodes_of_inside(LeafId leaf);
  bool uses_its_own(LeafId leaf) const;
  std::vector<int> ranks_wanted();
  Home home_of(const Request& asked) const {
    return {graph_->from_local(asked.leaf), asked.site, asked.position};
  }
  void number_owned();
  void place_moved();
  void number_slot(std::size_t slot, Point position);
  void fetch_copies(const Exchange& exchange, const std::vector<Request>& asked);
  Request request_of(const Home& home) const {
    const LeafGraph::Owner owner = graph_->owner_of(home.leaf);
    return {owner.rank, owner.index, home.site, home.site == Site::inside ? home.position : Point{}};
  }

  const Lattice* lattice_;
  const LeafGraph* graph_;
  const CutForest* cut_;
  std::vector<LeafId> border_leaves_;  ///< on the root's lower or left side, in ascending order
  /// The nodes' numbers: three slots for each local leaf, three for each border leaf, one for each of
  /// CutForest::nodes.
  std::vector<std::int32_t> slots_;
  std::vector<Request> wanted_;  ///< from other ranks, sorted: the copies
  std::vector<Point> points_;
  std::int64_t first_node_ = 0;
  std::int32_t owned_ = 0;
  std::vector<GlobalNodeId> copies_;
};

}  // namespace quadloop
