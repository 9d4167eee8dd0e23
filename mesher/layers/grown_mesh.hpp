#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/delaunay/tie_order.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// A node by its global number in the grown mesh.
struct GrownNode {
  GlobalNodeId id;
  Point point;
};

/// The order of nodes by which quadrilaterals are divided into triangles; empty: not divided.
using DivideBy = std::function<TieRank(Point)>;

/// Adds nodes and cells to a mesh. New nodes follow the existing ones in an order that the caller chooses;
/// new cells belong to leaves and follow the leaf's own cells, which `leaves` count.
class GrownMesh {
 public:
  /// `added`: number of nodes added after each of this rank's nodes. All arguments must outlive it. If
  /// `divide` is set, quadrilaterals are divided by their shorter diagonal; if both are equal, by the one
  /// through the third or fourth corner, whichever has the higher rank; not at all if the ends of both
  /// diagonals have equal ranks. *Collective.*
  GrownMesh(const Communicator& comm, const std::vector<std::int32_t>& added, const DivideBy& divide,
            Mesh& mesh, std::vector<LeafRecord>& leaves);

  /// An existing node, by its former number on this rank.
  GrownNode node(NodeId before) const { return {after_[before], mesh_.point(before)}; }
  /// Existing nodes of any ranks, by their former global numbers. Each node must be in `before` at least on
  /// its owner. *Collective.*
  std::map<GlobalNodeId, GrownNode> nodes(std::span<const GlobalNodeId> before) const;

  /// Sets the beginning of the error message for bad cells, and its advice, for cells added from now on.
  void begin_cells_of(const std::string& whose, const std::string& cure) { whose_ = whose, cure_ = cure; }
  /// Sets the block of the cells added from now on.
  void begin_block(std::int32_t block) { block_ = block; }
  /// Of three corners or four, counter-clockwise. Where its diagonals are equally long, that of the higher
  /// ranked of corners `outer` and `outer + 1` divides it: those away from the wall, alike in mirror images.
  void add_cell(std::int32_t leaf, std::span<const GrownNode> corners, std::size_t outer = 2);
  /// Leaves out a cell of the mesh, by its former number on this rank.
  void drop_triangle(std::int32_t triangle) { dropped_triangles_.push_back(triangle); }
  void drop_quad(std::int32_t quad) { dropped_quads_.push_back(quad); }
  void add_edge(std::size_t boundary, std::int32_t leaf, const GrownNode& from, const GrownNode& to);
  /// Boundaries for which neither keep_edge() nor add_edge() is called have no edges in the end.
  void keep_edge(std::size_t boundary, std::int32_t leaf, const std::array<NodeId, 2>& edge);

  /// Completes the mesh. `append_behind` appends the positions of the nodes added after an owned node. Throws
  /// InputError with coordinates for a cell without positive area. *Collective.*
  void put_together(const std::function<void(NodeId, std::vector<Point>&)>& append_behind);
  /// For each boundary the leaf of each of its edges in the grown mesh.
  std::vector<std::vector<std::int32_t>> edge_leaves() const;

 private:
  template <std::size_t width>
  struct OfLeaf {
    std::int32_t leaf = 0;
    std::array<GlobalNodeId, width> nodes;
    std::int32_t block = 0;  ///< of a cell
  };

  void use(const GrownNode& node);
  bool diagonals_rank_alike(std::span<const GrownNode> corners) const;
  void add_triangle(std::int32_t leaf, const GrownNode& a, const GrownNode& b, const GrownNode& c);
  void refuse_bad_cells() const;
  void place_nodes(const std::function<void(NodeId, std::vector<Point>&)>& append_behind);
  void merge_boundaries();
  template <std::size_t width>
  void merge_cells(std::vector<std::array<NodeId, width>>& cells, std::vector<OfLeaf<width>>& added,
                   std::vector<std::int32_t>& dropped, std::int32_t LeafRecord::*count,
                   std::vector<std::int32_t>& blocks) const;
  template <std::size_t width>
  std::array<NodeId, width> numbered(const std::array<GlobalNodeId, width>& ids) const;
  bool owns(GlobalNodeId id) const {
    return first_node_ <= id.value() && id.value() < first_node_ + owned_nodes_;
  }

  const Communicator& comm_;
  const DivideBy& divide_;
  Mesh& mesh_;
  std::vector<LeafRecord>& leaves_;
  IdVector<NodeId, GlobalNodeId> after_;  ///< new numbers of the existing nodes
  std::int64_t first_node_ = 0;
  std::int32_t owned_nodes_ = 0;
  std::map<GlobalNodeId, Point> ghosts_;
  std::map<GlobalNodeId, NodeId> local_copy_;
  std::vector<OfLeaf<3>> triangles_;
  std::vector<OfLeaf<4>> quads_;
  std::vector<std::int32_t> dropped_triangles_, dropped_quads_;
  std::vector<std::vector<OfLeaf<2>>> edges_;
  struct BadCell {
    Point corner;
    std::string whose, cure;
  };
  std::int32_t block_ = 0;
  std::string whose_, cure_ = "use a smaller spacing there";
  std::optional<BadCell> bad_;
};

}  // namespace quadloop
