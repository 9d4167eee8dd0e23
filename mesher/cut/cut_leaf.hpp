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
  /// One piece of outline was merged into one chord: convex loops, nothing can be wrong.
  bool simple = false;
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

/// Cuts leaves; keeps its working memory from one to the next.
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
  struct Stop {
    Side side = Side::bottom;
    double along = 0;  ///< ascending counter-clockwise
    Point position;    ///< before any snap
    Site site = Site::on_bottom;
    std::int32_t crossing = -1;
    std::int32_t snap = -1;  ///< of the leaf's snaps, where the side bends through a kept point
  };

  void gather_stops();
  void add_stop(Side side, Point position, Site site, std::int32_t crossing, std::int32_t snap = -1);
  void name_stops();
  using SiteNodes = std::array<std::int32_t, lattice_sites.size()>;  ///< of each lattice site
  SiteNodes add_side_nodes();
  void name_snaps(const SiteNodes& site_nodes);
  void name_absorbed_stops();
  std::int32_t absorbing_snap(const Crossing& crossing) const;
  /// The snap that takes the crossing; null for none.
  const LeafSnap* snap_of(std::int32_t crossing) const {
    return crossing_snap_[crossing] < 0 ? nullptr : &input_.snaps[crossing_snap_[crossing]];
  }
  std::span<const std::int32_t> trimmed_vertices(const Piece& piece) const;
  bool walk_sides();
  bool status_at_start(bool& inside) const;
  void note_side(const Stop& from, const Stop& to);
  void add_chords(Detail detail);
  void add_chord_run(const Piece& piece, Detail detail);
  void list_points(const Piece& piece, std::span<const std::int32_t> vertices);
  void add_hanging_nodes(Point segment_end);
  void choose_points(bool closed, Detail detail);
  void keep_strays(std::size_t from, std::size_t to);
  std::int32_t node_at(Point position);
  void settle_inner_nodes();
  bool cancel_opposites();

  const ShiftedOutline* outline_;
  const Interior* inside_;
  Input input_;
  CutLeaf leaf_;
  std::vector<Stop> stops_;
  std::vector<std::int32_t> stop_node_, crossing_node_, snap_node_;
  std::vector<std::int32_t> crossing_snap_;  ///< the snap that takes each crossing; -1 for none
  std::vector<CutLeaf::Edge> edges_;         ///< of the loops: chords and sides
  std::vector<CutLeaf::Edge> bare_sides_;    ///< parts of sides outside the domain
  /// A point of a piece: its entry, a vertex, a hanging node put onto it, its exit.
  struct RunPoint {
    Point position;
    std::int32_t segment = -1;  ///< that begins here or goes on from here
    bool turns = false;         ///< the outline is not straight here
    bool fixed = false;         ///< a chord must end here
    bool chosen = false;        ///< a chord ends here
  };
  std::vector<RunPoint> run_;
  double largest_stray_ = 0;
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
