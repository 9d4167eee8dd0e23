#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/cut/cut_forest.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Numbers the nodes of the cells of a cut forest along the space-filling curve: a node belongs to the first
/// leaf along the curve that touches it, and the nodes of a leaf have consecutive numbers in a fixed order,
/// so the numbers do not depend on the number of ranks.
class NodeNumbering {
 public:
  /// *Collective.*
  NodeNumbering(const Communicator& comm, const TreeGrid& grid, const LeafGraph& graph, const CutForest& cut);

  /// Number of nodes that this rank owns.
  std::int32_t owned() const { return owned_; }
  /// Number of nodes of this rank's cells, including ghosts.
  std::size_t size() const { return points_.size(); }
  /// Returns the nodes at the grid sites of an inner leaf; invalid at the middle of a side without a
  /// hanging node.
  using SiteNodes = std::array<NodeId, grid_sites.size()>;
  SiteNodes of_leaf(LeafId leaf) const;
  /// Returns a node of a cut leaf from its number in CutForest::nodes.
  NodeId of_cut(LeafId leaf, std::int32_t node) const;

  /// Moves points, owners and global numbers to the mesh.
  void fill(Mesh& mesh) &&;

 private:
  /// The leaf that owns a node, and its site there: a corner, the middle of the right or top side, or inside:
  /// in its list of cut nodes, identified by position. Corners other than the upper right one occur only at
  /// the root's lower and left side, where no earlier leaf exists.
  struct Home {
    LeafId leaf;
    Site site = Site::north_east;
  };
  struct Request {
    int rank = 0;
    std::int32_t leaf = 0;  ///< local index on that rank
    Site site = Site::north_east;
    Point position;  ///< of a listed node
    friend auto operator<=>(const Request&, const Request&) = default;
  };

  Home home_of_site(LeafId leaf, Site site) const;
  Home home_of_cut_node(LeafId leaf, const CutLeaf::Node& node) const;
  Home corner_home(LeafId owner, GridPoint p) const;
  Home home_of(const Request& asked) const { return {graph_->from_local(asked.leaf), asked.site}; }
  void sort_listed();
  std::int32_t listed_node(LeafId leaf, Point position) const;
  std::int32_t number_at(Home home, Point position) const;
  std::int32_t number_at_site(Home home) const;
  NodeId find(Home home, Point position = {}) const;

  /// Whether it is a local leaf that owns a single node in addition to its listed ones; most leaves do, and
  /// it needs no distinction from others.
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
  void fetch_ghosts(const Exchange& exchange, const std::vector<Request>& asked);
  Request request_of(Home home, Point position) const {
    const LeafGraph::Owner owner = graph_->owner_of(home.leaf);
    return {owner.rank, owner.index, home.site, home.site == Site::inside ? position : Point{}};
  }

  const TreeGrid* grid_;
  const LeafGraph* graph_;
  const CutForest* cut_;
  /// For each local leaf a bit per node that it owns, except listed ones.
  std::vector<std::uint8_t> used_sites_;
  std::vector<std::int32_t> first_;        ///< for each local leaf, number of the first node that it owns
  std::vector<std::int32_t> listed_;       ///< numbers of CutForest::nodes
  std::vector<std::int32_t> by_position_;  ///< CutForest::nodes, sorted within each leaf with many nodes
  std::vector<Request> wanted_;            ///< from other ranks, sorted: the ghosts
  std::vector<Point> points_;
  std::int64_t first_node_ = 0;
  std::int32_t owned_ = 0;
  std::vector<GlobalNodeId> ghosts_;
};

}  // namespace quadloop
