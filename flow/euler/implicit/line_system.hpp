#pragma once

#include <optional>
#include <vector>

#include "flow/euler/implicit/line_finder.hpp"
#include "flow/euler/model/flux_jacobian.hpp"

namespace quadloop::flow::euler {

/// The part of an implicit system that couples the nodes of each line (find_lines), solved exactly as a block
/// tridiagonal system. A line shared by several ranks is solved on all of them, bitwise identically, after
/// they have received the rows that they do not own.
class LineSystem {
 public:
  /// `mesh` must outlive it. *Collective.*
  LineSystem(const Communicator& comm, const DualMesh& mesh, const Colouring& colours);

  /// Whether there are no lines on any rank.
  bool empty() const { return !exchange_.has_value(); }
  /// Neighbours of a node along its line, or invalid; nodes that are not owned have none.
  struct Links {
    NodeId before, after;
    bool any() const { return before.valid() || after.valid(); }
    bool is_end() const { return any() && !(before.valid() && after.valid()); }
    bool contains(NodeId node) const { return node.valid() && (before == node || after == node); }
  };
  const Links& links(NodeId node) const { return links_[node]; }
  /// Colour in which the owned node is updated; -1 if it is in no line.
  std::int8_t colour(NodeId node) const { return node_colours_[node]; }

  using Row = std::array<double, 4>;

  /// Sets the derivative of an owned node's row with respect to the previous or next node.
  void set_block(NodeId node, NodeId neighbour, const Matrix4& block);
  /// Factorises the lines with these diagonal blocks of owned nodes. *Collective.*
  void factor(const IdVector<NodeId, Matrix4>& diagonal);

  /// Solves the lines of one colour. `rows` has an entry for each owned node, initially the right sides;
  /// further entries are ignored. *Collective.*
  void solve(int colour, std::vector<Row>& rows) const;
  std::size_t rows() const { return blocks_.size(); }

 private:
  struct Blocks {
    Matrix4 before, after, inverse;  ///< of the eliminated diagonal block
  };
  struct Line {
    std::vector<std::int32_t> rows;
    std::int8_t colour;
  };
  const DualMesh& mesh_;
  std::vector<Line> lines_;
  IdVector<NodeId, Links> links_;  ///< for each node
  IdVector<NodeId, std::int8_t> node_colours_;
  std::optional<NodeExchange> exchange_;  ///< rows: owned nodes, then other ranks' nodes of shared lines
  std::vector<Blocks> blocks_;            ///< for each row; empty without lines
};

}  // namespace quadloop::flow::euler
