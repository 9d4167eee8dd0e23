#pragma once

#include <optional>
#include <span>
#include <utility>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/cut/leaf_cells.hpp"
#include "mesher/forest/leaf_graph.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// State and cut cells of this rank's leaves: each lies outside the domain, inside, or is cut.
struct CutForest {
  enum class State : char { outside, inside, cut };

  /// Start or end of a cut leaf's entries in the vectors below.
  struct Offsets {
    std::int32_t nodes = 0, triangles = 0, quads = 0, outline = 0;
  };
  struct Entry {
    Offsets begin, end;
    CutLeaf::InsideHalves inside_halves;
  };

  std::vector<State> states;               ///< of each local leaf
  std::vector<std::int32_t> blocks;        ///< of each local leaf that is inside; empty: one block
  std::vector<std::int8_t> target_levels;  ///< SizeCursor::target_level() of each local leaf
  std::vector<std::int32_t> entry_of;      ///< for each local leaf; -1 if it is not cut
  std::vector<Entry> entries;              ///< of the cut leaves, and of uncut ones with a snapped corner
  std::vector<CutLeaf::Node> nodes;
  std::vector<LocalTriangle> triangles;  ///< numbers are relative to the leaf's first node
  std::vector<LocalQuad> quads;
  std::vector<std::int32_t> triangle_blocks, quad_blocks;  ///< empty: one block
  std::vector<CutLeaf::Edge> outline;
  /// Grid vertices that have been moved; all of those at local leaves, and some others.
  struct Moved {
    GridPoint corner;
    Point position;
  };
  std::vector<Moved> moved;
  std::int64_t followed = 0;  ///< number of cut leaves in which points other than feature points were kept

  template <class T>
  static std::span<const T> part(const std::vector<T>& all, std::int32_t begin, std::int32_t end) {
    return std::span(all).subspan(begin, end - begin);
  }
  /// Frees what is not needed after the mesh is assembled: levels and the vectors of nodes, cells and edges.
  void drop_lists() {
    std::exchange(target_levels, {});
    std::exchange(nodes, {});
    std::exchange(triangles, {});
    std::exchange(quads, {});
    std::exchange(triangle_blocks, {});
    std::exchange(quad_blocks, {});
    std::exchange(outline, {});
    std::exchange(moved, {});
  }
};

/// Cuts the local leaves and determines inside and outside. No rank waits for another: an uncut leaf takes
/// its state from a local neighbour, or from an exact count of crossings. A snap that makes a leaf invalid is
/// revoked. `snap` is the snap tolerance: maximum distance of a crossing from a grid vertex that moves
/// onto it, relative to the local edge; at least 1e-9. With a mirror axis corners on it stay on it. The
/// points `required`, which must be away from the geometry and from each other, become nodes
/// (required_snaps). Throws InputError on all ranks if boundaries are closer to each other than double
/// precision can resolve. *Collective.*
CutForest cut_forest(const Communicator& comm, const LeafGraph& graph, SizeTree& sizes,
                     const ShiftedOutline& outline, const Interior& inside, double snap,
                     std::optional<MirrorAxis> mirror = {}, std::span<const Point> required = {});

/// Whether a quadrant must be refined before it can be cut: it contains a complete loop, or chords that would
/// cross each other or deviate too far from the boundary.
class ResolutionTest {
 public:
  ResolutionTest(const TreeGrid& grid, const ShiftedOutline& outline, const Interior& inside)
      : grid_{&grid}, outline_{&outline}, cutter_{outline, inside} {}
  bool unresolved(const Quadrant& q, std::span<const std::int32_t> segments);

 private:
  const TreeGrid* grid_;
  const ShiftedOutline* outline_;
  LeafTraces traces_;
  LeafCutter cutter_;
};

}  // namespace quadloop
