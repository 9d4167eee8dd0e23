#pragma once

#include <optional>
#include <utility>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/cut/leaf_cells.hpp"
#include "mesher/forest/leaf_graph.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// What the outline makes of this rank's leaves: each lies outside the domain, inside it whole, or is cut.
struct CutForest {
  enum class State : char { outside, inside, cut };

  /// Where the lists below begin for a cut leaf, or end.
  struct Offsets {
    std::int32_t nodes = 0, triangles = 0, quads = 0, outline = 0;
  };
  struct Entry {
    Offsets begin, end;
    CutLeaf::InsideHalves inside_halves;
  };

  std::vector<State> states;               ///< of each local leaf
  std::vector<std::int8_t> wanted_levels;  ///< SizeCursor::wanted_level() of each local leaf
  std::vector<std::int32_t> entry_of;      ///< of each local leaf; -1 where it is not cut
  std::vector<Entry> entries;              ///< of the cut leaves, and of uncut ones with a snapped corner
  std::vector<CutLeaf::Node> nodes;
  std::vector<LocalTriangle> triangles;  ///< numbers count from the leaf's first node
  std::vector<LocalQuad> quads;
  std::vector<CutLeaf::Edge> outline;
  /// Lattice corners that are not where the lattice has them; all of those at local leaves, and some others.
  struct Moved {
    LatticePoint corner;
    Point position;
  };
  std::vector<Moved> moved;
  std::int64_t followed = 0;  ///< cut leaves in which points beside the corners were kept

  template <class T>
  static std::span<const T> part(const std::vector<T>& all, std::int32_t begin, std::int32_t end) {
    return std::span(all).subspan(begin, end - begin);
  }
  /// Frees what is of no more use once the mesh is assembled: levels, the lists of nodes, cells and edges.
  void drop_lists() {
    std::exchange(wanted_levels, {});
    std::exchange(nodes, {});
    std::exchange(triangles, {});
    std::exchange(quads, {});
    std::exchange(outline, {});
    std::exchange(moved, {});
  }
};

/// Cuts the local leaves and tells inside from outside. No rank waits for another: an uncut leaf takes its
/// state from a local neighbour, or from an exact count of crossings. A snap that leaves a leaf unsound is
/// taken back. *Collective.* Throws InputError on all ranks where boundaries come nearer to each other than
/// double precision can resolve. `snap`: how near a crossing takes a lattice corner along, as a share of the
/// local edge. With a mirror axis corners on it stay on it.
CutForest cut_forest(const Communicator& comm, const LeafGraph& graph, SizeTree& sizes,
                     const ShiftedOutline& outline, const Interior& inside, double snap,
                     std::optional<MirrorAxis> mirror = {});

/// Whether this quadrant as a leaf needs to be refined to be cut: a whole loop inside it, chords that would
/// cross, or that would stray too far from the outline.
class ResolutionTest {
 public:
  ResolutionTest(const Lattice& lattice, const ShiftedOutline& outline, const Interior& inside)
      : lattice_{&lattice}, outline_{&outline}, cutter_{outline, inside} {}
  bool unresolved(const Quadrant& q, std::span<const std::int32_t> segments);

 private:
  const Lattice* lattice_;
  const ShiftedOutline* outline_;
  LeafTraces traces_;
  LeafCutter cutter_;
};

}  // namespace quadloop
