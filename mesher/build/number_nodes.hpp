#pragma once

#include "mesher/base/exchange.hpp"
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

  /// The node at a place (0 to 7, as CutLeaf::Node::place) of an inside leaf.
  NodeId of_leaf(std::int32_t leaf, int place) const;
  /// A node of a cut leaf, from its number in CutForest::nodes.
  NodeId of_cut(std::int32_t leaf, std::int32_t node) const;

  /// Hands points, owners and global numbers over to the mesh.
  void fill(Mesh& mesh) &&;

 private:
  /// Where a leaf keeps a node that it owns: at one of its corners, in the middle of its right or top side,
  /// or in its list of cut nodes. Corners other than the upper right one only on the root's lower and left
  /// side, where there is no leaf before it.
  enum Slot : std::int32_t {
    south_west,
    south_east,
    north_west,
    north_east,
    right_middle,
    top_middle,
    listed,
    slot_count
  };
  struct Home {
    std::int32_t leaf = -1;
    Slot slot = north_east;
    Point position;  ///< names a listed node
  };
  struct Request {
    int rank = 0;
    std::int32_t leaf = 0;  ///< counted from the owner's first leaf
    std::int32_t slot = 0;
    Point position;
    friend auto operator<=>(const Request&, const Request&) = default;
  };

  Home home_of_place(std::int32_t leaf, int place) const;
  Home home_of_cut_node(std::int32_t leaf, const CutLeaf::Node& node) const;
  Home corner_home(std::int32_t owner, std::int64_t x, std::int64_t y) const;
  std::int32_t* local_slot(const Home& home);
  const std::int32_t* local_slot(const Home& home) const {
    return const_cast<NodeNumbering*>(this)->local_slot(home);
  }
  std::int32_t listed_node(std::int32_t leaf, Point position) const;
  NodeId find(const Home& home) const;

  void mark(const Home& home);
  void mark_used();
  void mark_inside(std::int32_t leaf);
  bool marks_its_own(std::int32_t leaf) const;
  std::vector<int> ranks_wanted();
  std::int32_t& slot_of(const Request& asked) {
    return *local_slot({graph_->from_local(asked.leaf), static_cast<Slot>(asked.slot), asked.position});
  }
  void number_owned();
  void place_moved();
  void number_slot(std::int32_t& slot, Point position);
  void fetch_copies(const Exchange& exchange, const std::vector<Request>& asked);
  Request request_of(const Home& home) const {
    const LeafGraph::Place place = graph_->place_of(home.leaf);
    return {place.rank, place.index, home.slot, home.slot == listed ? home.position : Point{}};
  }

  const Lattice* lattice_;
  const LeafGraph* graph_;
  const CutForest* cut_;
  std::vector<std::array<std::int32_t, 3>>
      inner_slots_;  ///< of each local leaf: north east, right middle, top middle
  std::vector<std::pair<std::int32_t, std::array<std::int32_t, 3>>>
      border_slots_;                        ///< of leaves on the root's lower or left side, by leaf
  std::vector<std::int32_t> listed_slots_;  ///< of each of CutForest::nodes
  std::vector<Request> wanted_;             ///< from other ranks, sorted: the copies
  std::vector<Point> points_;
  std::int64_t first_node_ = 0;
  std::int32_t owned_ = 0;
  std::vector<GlobalNodeId> copies_;
};

}  // namespace quadloop
