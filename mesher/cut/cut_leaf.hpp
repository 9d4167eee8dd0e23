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

/// What is left of a leaf inside the domain: closed loops over nodes on its sides and in its inside.
struct CutLeaf {
  struct Node {
    Point position;
    Site site = Site::inside;  ///< as the lattice has it, before any snap
  };
  /// A directed edge with the domain to its left.
  struct Edge {
    std::int32_t from = 0, to = 0;
    /// A segment of the outline that it stands for; -1: part of a side of the leaf.
    std::int32_t segment = -1;
  };

  std::vector<Node> nodes;  ///< round the sides first, counter-clockwise from the lower left corner; then
                            ///< those inside, by position
  /// The chords that stand for the outline, also those that only bound a neighbour's cells.
  std::vector<Edge> outline;
  std::vector<std::int32_t> loop_nodes;   ///< the loops one after another
  std::vector<std::int32_t> loop_starts;  ///< one more than there are loops
  std::int32_t side_nodes = 0;            ///< how many nodes lie on the sides
  /// The sides whose first half, counter-clockwise, lies in the domain, where no crossing parts it, and those
  /// whose second half does.
  struct InsideHalves {
    SideSet first, second;
    bool any() const { return !first.empty() || !second.empty(); }
  };
  InsideHalves inside_halves;
  /// More points of the geometry were kept than its corners, to follow it closely enough.
  bool refined = false;

  std::size_t loop_count() const { return loop_starts.size() - 1; }
  std::span<const std::int32_t> loop(std::size_t i) const {
    return std::span(loop_nodes).subspan(loop_starts[i], loop_starts[i + 1] - loop_starts[i]);
  }
};

/// How closely chords follow the outline inside a leaf.
enum class Detail {
  merged,  ///< kept points, and those without which a chord would stray too far (thesis Fig. 3.12)
  full,    ///< every point where the outline turns
  exact    ///< every point of the geometry
};

/// Cuts leaves; keeps the memory of the result from one to the next.
class LeafCutter {
 public:
  LeafCutter(const ShiftedOutline& outline, const Interior& inside) : outline_{&outline}, inside_{&inside} {}

  /// One leaf as the cutter needs it.
  struct Input {
    LeafTrace trace;
    Point centre;                     ///< where hanging nodes lie on the sides
    SideSet hanging;                  ///< the sides that have one
    std::span<const LeafSnap> snaps;  ///< of this leaf
    std::optional<bool> inside;       ///< where the leaf holds no geometry: whether it lies in the domain
  };

  /// Cuts a leaf. Returns whether the loops are sound: simple, nested as outlines and holes, none overlapping
  /// another (always so with exact detail and no snaps, but for boundaries that double precision cannot
  /// part). The result is valid until the next call.
  bool cut(const Input& input, Detail detail);

  const CutLeaf& result() const { return leaf_; }

 private:
  const ShiftedOutline* outline_;
  const Interior* inside_;
  CutLeaf leaf_;
};

/// Strings the edges into loops, each split where it touches itself. False where they do not close.
bool trace_loops(std::span<const CutLeaf::Edge> edges, CutLeaf& leaf);

/// Whether no two edges meet but at their ends and the loops are nested as outlines (counter-clockwise) and
/// holes in them. Exact.
bool loops_are_sound(std::span<const CutLeaf::Edge> edges, const CutLeaf& leaf);

/// Whether the sides of a leaf, after snaps, are still a simple counter-clockwise loop, which no chord
/// crosses: then the leaf keeps clear of its neighbours, also where it lies outside the domain. Exact.
bool sides_are_sound(std::span<const CutLeaf::Edge> edges, std::span<const CutLeaf::Edge> bare_sides,
                     const CutLeaf& leaf);

/// +1 for a counter-clockwise simple loop, -1 for a clockwise one. Exact.
int winding_of(const CutLeaf& leaf, std::span<const std::int32_t> loop);

}  // namespace quadloop
