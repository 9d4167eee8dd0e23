#pragma once

#include <optional>
#include <vector>

#include "flow/euler/implicit/line_finder.hpp"
#include "flow/euler/model/flux_jacobian.hpp"

namespace quadloop::euler {

/// The part of an implicit system that couples the nodes of each line (find_lines), solved exactly: a block
/// tridiagonal system for each of them. A line that several ranks share is solved by all of them, each with
/// the same bits: they are sent the rows that they do not own.
class LineSystem {
 public:
  /// `mesh` must outlive it. *Collective.*
  LineSystem(const Communicator& comm, const DualMesh& mesh, const Colouring& colours);

  /// On any rank.
  bool empty() const { return !exchange_.has_value(); }
  /// Neighbours of a node along its line, or -1; nodes that are not owned have none.
  struct Links {
    std::int32_t before = -1, after = -1;
    bool any() const { return before >= 0 || after >= 0; }
    bool is_end() const { return any() && (before < 0 || after < 0); }
    bool contains(std::int32_t node) const { return node >= 0 && (before == node || after == node); }
  };
  const Links& links(std::int32_t node) const { return links_[node]; }
  /// In whose turn the owned node is changed; -1 where it is in no line.
  std::int8_t colour(std::int32_t node) const { return node_colours_[node]; }

  using Row = std::array<double, 4>;

  /// How an owned node's row answers to the node before or after it.
  void set_block(std::int32_t node, std::int32_t neighbour, const Matrix4& block);
  /// From these diagonal blocks of owned nodes. *Collective.*
  void factor(const std::vector<Matrix4>& diagonal);

  /// Solves the lines of one colour. `rows` has an entry for each owned node, at first the right sides, and
  /// more behind them. *Collective.*
  void solve(int colour, std::vector<Row>& rows) const;
  std::size_t rows() const { return blocks_.size(); }

 private:
  struct Blocks {
    Matrix4 before, after, inverse;  ///< the last of the eliminated diagonal block
  };
  struct Line {
    std::vector<std::int32_t> rows;
    std::int8_t colour;
  };
  const DualMesh& mesh_;
  std::vector<Line> lines_;
  std::vector<Links> links_;  ///< of each node
  std::vector<std::int8_t> node_colours_;
  std::optional<NodeExchange> exchange_;  ///< rows: owned nodes, then other ranks' nodes in shared lines
  std::vector<Blocks> blocks_;            ///< of each row; none without lines
};

}  // namespace quadloop::euler
