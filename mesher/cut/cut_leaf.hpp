#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesher/geometry/interior.hpp"
#include "mesher/snap/leaf_trace.hpp"
#include "mesher/snap/snap.hpp"

namespace quadloop {

/// The part of a leaf inside the domain: closed loops of nodes on its sides and in its interior.
struct CutLeaf {
  struct Node {
    Point position;
    Site site = Site::inside;  ///< grid site before any snap
  };
  /// A directed edge with the domain to its left.
  struct Edge {
    std::int32_t from = 0, to = 0;
    /// Segment of the geometry that the edge represents; -1: part of a side of the leaf.
    std::int32_t segment = -1;
    std::int32_t block = 0;  ///< block to its left
  };

  /// First along the sides, counter-clockwise from the lower left corner; then those inside, by position.
  std::vector<Node> nodes;
  /// The chords that represent the boundary, including those that only bound a neighbour's cells. Between two
  /// blocks, and along inner lines, there are two in opposite directions; those along a side may be in two
  /// leaves.
  std::vector<Edge> outline;
  /// Concatenated loops; those of two nodes are parts of inner lines with the same region on both sides,
  /// those of one node are nodes that the cells must have.
  std::vector<std::int32_t> loop_nodes;
  std::vector<std::int32_t> loop_starts;  ///< one more entry than there are loops
  std::vector<std::int32_t> loop_blocks;  ///< of each loop
  std::int32_t side_nodes = 0;            ///< number of nodes on the sides
  /// The sides whose first half, counter-clockwise, lies in the domain without a crossing, and the same for
  /// the second half.
  struct InsideHalves {
    SideSet first, second;
    bool any() const { return !first.empty() || !second.empty(); }
  };
  InsideHalves inside_halves;
  /// Points other than feature points were kept, to follow the geometry closely enough.
  bool refined = false;

  std::size_t loop_count() const { return loop_starts.size() - 1; }
  std::span<const std::int32_t> loop(std::size_t i) const {
    return std::span(loop_nodes).subspan(loop_starts[i], loop_starts[i + 1] - loop_starts[i]);
  }
};

/// How closely chords follow the boundary inside a leaf.
enum class Detail {
  merged,  ///< feature points, and points without which a chord would deviate too far (thesis Fig. 3.12)
  full,    ///< every point where the boundary turns
  exact    ///< every point of the geometry
};

/// Cuts leaves; reuses the memory of the result.
class LeafCutter {
 public:
  LeafCutter(const ShiftedOutline& outline, const Interior& inside) : outline_{&outline}, inside_{&inside} {}

  /// Input for one leaf.
  struct Input {
    LeafTrace trace;
    Point centre;                     ///< position of hanging nodes along the sides
    SideSet hanging;                  ///< sides with a hanging node
    std::span<const LeafSnap> snaps;  ///< of this leaf
    std::optional<bool> inside;       ///< if the leaf contains no geometry: whether it lies in the domain
    std::int32_t block = 0;           ///< then the block in which it lies
  };

  /// Cuts a leaf. Returns whether the loops are valid: simple, nested as outer loops and holes, without
  /// overlap (guaranteed for exact detail and no snaps, unless double precision cannot separate boundaries).
  /// The result is valid until the next call.
  bool cut(const Input& input, Detail detail);

  const CutLeaf& result() const { return leaf_; }

 private:
  const ShiftedOutline* outline_;
  const Interior* inside_;
  CutLeaf leaf_;
};

/// Connects the edges to loops, each split where it touches itself. Returns false if they are not closed.
bool trace_loops(std::span<const CutLeaf::Edge> edges, CutLeaf& leaf);

/// Whether edges meet only at their ends and the loops of each block are nested as outer loops
/// (counter-clockwise) and holes in them. Exact.
bool loops_are_sound(std::span<const CutLeaf::Edge> edges, const CutLeaf& leaf);

/// Whether the sides of a leaf, after snaps, still form a simple counter-clockwise loop that no chord
/// crosses: then the leaf does not overlap its neighbours, even if it lies outside the domain. Exact.
bool sides_are_sound(std::span<const CutLeaf::Edge> edges, std::span<const CutLeaf::Edge> bare_sides,
                     const CutLeaf& leaf);

/// Returns +1 for a counter-clockwise simple loop, -1 for a clockwise one. Exact.
int winding_of(const CutLeaf& leaf, std::span<const std::int32_t> loop);

}  // namespace quadloop
