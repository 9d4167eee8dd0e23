#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/shifted_outline.hpp"
#include "mesher/grid/tree_grid.hpp"

namespace quadloop {

/// A crossing of the boundary with a side of a leaf.
struct Crossing {
  std::int32_t segment = -1;
  Side side = Side::bottom;
  bool enters = false;  ///< the boundary enters the leaf here
  Point position;       ///< rounded once; the same for both leaves at the side
};

/// A part of the boundary in a leaf: from a crossing over vertices inside to a crossing, or a whole loop
/// (without crossings). Numbers are relative to the first of the leaf.
struct Piece {
  std::int32_t entry = -1, exit = -1;                 ///< numbers of crossings; -1 for a loop
  std::int32_t first_segment = -1;                    ///< first segment of the piece
  std::int32_t vertices_begin = 0, vertices_end = 0;  ///< its vertices inside the leaf
};

/// The boundary inside one leaf, cut at its sides (thesis Fig. 3.10, 3.11). A view of a LeafTraces.
struct LeafTrace {
  Box box;
  std::span<const Crossing> crossings;
  std::span<const Piece> pieces;
  std::span<const std::int32_t> vertices;

  const Crossing& crossing(std::int32_t c) const { return crossings[c]; }
  std::span<const std::int32_t> vertices_of(const Piece& p) const {
    return vertices.subspan(p.vertices_begin, p.vertices_end - p.vertices_begin);
  }
};

/// The boundary inside any number of leaves.
class LeafTraces {
 public:
  /// Traces the boundary through one more leaf. `segments` are those that meet its interior, ascending.
  /// Decisions are exact; positions of crossings are rounded. Time and memory depend on these segments only.
  /// Returns the number of the trace.
  std::int32_t add(const ShiftedOutline& outline, const Box& box, std::span<const std::int32_t> segments);

  LeafTrace operator[](std::int32_t trace) const;
  std::size_t size() const { return begins_.size(); }
  /// Number of crossings in all traces.
  std::size_t crossings() const { return crossings_.size(); }
  void clear();

 private:
  struct Begin {
    Box box;
    std::int32_t crossings = 0, pieces = 0, vertices = 0;
  };
  std::vector<Begin> begins_;
  std::vector<Crossing> crossings_;
  std::vector<Piece> pieces_;
  std::vector<std::int32_t> vertices_;
};

/// The boundary in this rank's leaves and in the ghost leaves.
struct TracedForest {
  LeafTraces traces;
  std::vector<LeafId> leaves;          ///< of each trace, ascending
  std::vector<std::int32_t> trace_of;  ///< of each leaf of the graph; -1 where it contains no geometry

  explicit TracedForest(std::int32_t leaf_count) : trace_of(leaf_count, -1) {}
  /// Same as LeafTraces::add, for the leaves with geometry in the order of the curve.
  void add(LeafId leaf, const ShiftedOutline& outline, const Box& box,
           std::span<const std::int32_t> segments) {
    trace_of[leaf.value()] = traces.add(outline, box, segments);
    leaves.push_back(leaf);
  }
};

}  // namespace quadloop
