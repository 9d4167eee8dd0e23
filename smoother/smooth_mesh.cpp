#include "smoother/smooth_mesh.hpp"

#include <algorithm>
#include <optional>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/delaunay/restore/restore_delaunay.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "smoother/binary_unit.hpp"
#include "smoother/even_widths.hpp"
#include "smoother/fit_to_layers.hpp"
#include "smoother/level_transitions/level_transitions.hpp"
#include "smoother/movable_mesh.hpp"
#include "smoother/objective/cost_limit.hpp"
#include "smoother/smooth_mirrored.hpp"
#include "smoother/sweeps/rings.hpp"
#include "smoother/sweeps/sweeper.hpp"

namespace quadloop::smoother {

namespace {

constexpr int free_rings = 3;  ///< nodes within this many rings of a cell above the threshold may move
constexpr double cost_rounding = 1e-12;  ///< relative difference of a cost seen from different corners
/// Rings around triangles that flips made too bad; increased by this each time.
constexpr int pinned_rings = 2;
constexpr int most_attempts = 5;
constexpr int most_even_sweeps = 40;
/// Above this cost the shape of a cell has priority over even edges along boundaries: an angle of about 15
/// degrees in the first round; in later rounds a factor of `SmoothOptions::bad`.
constexpr double even_at_first = 0.3, even_later = 1.1;
/// A sweep with this many times fewer moves than the busiest one ends a round.
constexpr std::int64_t few = 100;

/// Most cells are whole leaves, whose cost is 0 to the last bit.
bool is_square(const std::array<Point, 4>& p) {
  return p[0].y == p[1].y && p[1].x == p[2].x && p[2].y == p[3].y && p[3].x == p[0].x &&
         p[1].x - p[0].x == p[2].y - p[1].y && p[0].x < p[1].x;
}
bool is_square(const std::array<Point, 3>&) { return false; }

/// Whether the target of a cell, given by its number in the halo mesh, is the ideal shape.
bool is_ideal(const std::vector<CellTarget>& targets, std::size_t number) {
  return targets.empty() || targets[number].ideal();
}

/// The cost of a cell given by its number in the halo mesh; 0 if it is certainly below the limit.
template <std::size_t width>
double cost_of(const HaloMesh& mesh, const std::array<NodeId, width>& nodes,
               const std::vector<CellTarget>& targets, std::size_t number, const CostLimit& limit) {
  const auto corners = corners_of(mesh, nodes);
  if (!is_ideal(targets, number))
    return cell_cost(corners, stretched_targets<width>(targets[number].w1, targets[number].w2));
  if (is_square(corners) || limit.surely_kept_by(corners)) return 0;
  return cell_cost(corners, ideal_targets<width>());
}

/// Decides which cells cost more than a threshold.
class BadCellTest {
 public:
  BadCellTest(const HaloMesh& mesh, const std::vector<CellTarget>& targets, double threshold)
      : mesh_{mesh}, targets_{targets}, threshold_{threshold}, limit_{threshold} {}

  template <std::size_t width>
  bool is_bad(const std::array<NodeId, width>& nodes, std::size_t number) const {
    const auto corners = corners_of(mesh_, nodes);
    if (!is_ideal(targets_, number)) return cost_of(mesh_, nodes, targets_, number, limit_) > threshold_;
    if (is_square(corners) || limit_.surely_kept_by(corners)) return false;
    return limit_.surely_missed_by(corners) || cell_cost(corners, ideal_targets<width>()) > threshold_;
  }

 private:
  const HaloMesh& mesh_;
  const std::vector<CellTarget>& targets_;
  double threshold_;
  CostLimit limit_;
};

struct WorstCell {
  double cost = 0;
  std::int64_t inverted = 0;
  CostLimit limit{0};  ///< of the cost

  void include(double other, bool counts) {
    inverted += other >= 1 && counts ? 1 : 0;
    if (other <= cost) return;
    cost = other;
    limit = CostLimit(cost);
  }
};

/// Data collected before the first sweep.
struct Survey {
  bool tangled;        ///< whether there are inverted cells
  NodeFlags bad;       ///< nodes of cells above the threshold; valid for owned nodes
  NodeFlags near;      ///< those nodes and some rings around them, which may move
  NodeFlags parallel;  ///< nodes of parallelograms; valid for owned nodes
};

WorstCell over_ranks(const Communicator& comm, const WorstCell& worst) {
  return {comm.maximum(worst.cost), comm.sum(worst.inverted)};
}

bool is_parallelogram(const std::array<Point, 4>& p) { return is_square(p) || skew_of(p) <= parallel_skew; }
bool is_parallelogram(const std::array<Point, 3>&) { return false; }

void flag_nodes_of_parallelograms(const HaloMesh& mesh, NodeFlags& parallel) {
  mesh.for_each_cell([&](const auto& nodes) {
    if (is_parallelogram(corners_of(mesh, nodes))) flag_all(nodes, parallel);
  });
}

/// The worst cell and the nodes of cells above a threshold.
struct BadCells {
  WorstCell worst;
  NodeFlags nodes;  ///< nodes of cells above the threshold; valid for owned nodes
};

/// *Collective.*
BadCells find_bad_cells(const Communicator& comm, const HaloMesh& mesh,
                        const std::vector<CellTarget>& targets, double threshold) {
  BadCells bad{{}, NodeFlags(mesh.points().size(), 0)};
  const BadCellTest test(mesh, targets, threshold);
  std::size_t number = 0;
  mesh.for_each_cell([&](const auto& nodes) {
    const std::size_t cell = number++;
    const bool is_bad = test.is_bad(nodes, cell);
    if (is_bad) flag_all(nodes, bad.nodes);
    if (!is_bad && bad.worst.cost >= threshold) return;
    const double cost = cost_of(mesh, nodes, targets, cell, bad.worst.limit);
    bad.worst.include(cost, mesh.owns(nodes[0]));  // other ranks may also have the cell
  });
  bad.worst = over_ranks(comm, bad.worst);
  return bad;
}

/// Flags the nodes of cells that cost more than `bad`, considering only cells with a node flagged in `among`.
/// Valid for owned nodes.
NodeFlags nodes_of_bad_cells(const HaloMesh& mesh, const std::vector<CellTarget>& targets,
                             const NodeFlags& among, double bad) {
  NodeFlags flags(mesh.points().size(), 0);
  const BadCellTest test(mesh, targets, bad);
  std::size_t number = 0;
  mesh.for_each_cell([&](const auto& nodes) {
    const std::size_t cell = number++;
    if (any_flagged(among, nodes) && test.is_bad(nodes, cell)) flag_all(nodes, flags);
  });
  return flags;
}

void flag_those_of(const NodeFlags& some, NodeFlags& flags) {
  for (const NodeId node : flags.ids()) flags[node] |= some[node];
}

/// Flags additionally the bad nodes and the nodes in this many rings around them. *Collective.*
void yield(const HaloMesh& mesh, NodeFlags bad, int rings, NodeFlags& yielding) {
  grow(mesh, bad, rings);
  flag_those_of(bad, yielding);
}

/// The nodes near that may move: those of no parallelogram, and the ones flagged in `yielding`.
std::vector<NodeId> free_nodes(const Survey& surveyed, const HaloMesh& mesh, BoundarySlide& slide,
                               const NodeFlags& yielding) {
  std::vector<NodeId> free;
  for_each_flagged(surveyed.near, [&](NodeId node) {
    const bool may_move = mesh.owns(node) && (surveyed.parallel[node] == 0 || yielding[node] != 0);
    if (may_move && slide.freedom(node) != NodeFreedom::fixed) free.push_back(node);
  });
  return free;
}

/// The worst cell of the present mesh. *Collective.*
WorstCell worst_cell(const Communicator& comm, const HaloMesh& mesh, const std::vector<CellTarget>& targets) {
  WorstCell worst;
  std::size_t number = 0;
  mesh.for_each_cell([&](const auto& nodes) {
    worst.include(cost_of(mesh, nodes, targets, number++, worst.limit), mesh.owns(nodes[0]));
  });
  return over_ranks(comm, worst);
}

/// Whether a triangle is inverted or flat by the exact test; some that count as flat in smoothing are not.
bool any_turns_right(const Mesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    return orientation(mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2])) <= 0;
  });
}

/// The worst triangle of a mesh in which each triangle is on one rank. *Collective.*
WorstCell worst_triangle(const Communicator& comm, const Mesh& mesh) {
  WorstCell worst;
  for (const auto& nodes : mesh.triangles) {
    const auto corners = corners_of(mesh, nodes);
    if (!worst.limit.surely_kept_by(corners)) worst.include(cell_cost(corners, ideal_targets<3>()), true);
  }
  return over_ranks(comm, worst);
}

/// Sweeps until almost no node moves, at most `sweeps` times. Sweeps after the open ones are compared with
/// the busiest of these later ones, as fewer nodes move there. *Collective.*
void sweep_until_settled(const Communicator& comm, Sweeper& sweeper, int sweeps, SmoothReport& report) {
  progress::SharedStage stage(comm, "smoothing", sweeps, "sweeps");
  std::int64_t moves = 1, busiest = 0;
  for (int sweep = 0; sweep < sweeps && moves > 0 && moves >= busiest / few; ++sweep, ++report.sweeps) {
    moves = sweeper.sweep();
    busiest = sweep == Sweeper::open_sweeps ? moves : std::max(busiest, moves);
    report.moves += moves;
    stage.say("sweep " + std::to_string(sweep + 1) + ", " + std::to_string(moves) + " nodes moved");
    stage.advance_together(sweep + 1);
  }
}

/// The star cost up to which slides keep boundary edges even. 0 with targets, which define their own lengths.
double even_up_to(int round, const SmoothOptions& options, bool any_targets) {
  if (any_targets) return 0;
  return round == 0 ? even_at_first : even_later * options.bad;
}

/// Has the nodes that slide visited again among the bad ones: they may have been held back.
void look_again_at_slides(const HaloMesh& mesh, BoundarySlide& slide, const NodeFlags& bad,
                          NodeFlags& stale) {
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes()})) {
    if (bad[node] != 0 && slide.freedom(node) == NodeFreedom::sliding) stale[node] = 1;
  }
}

/// Rounds of sweeps: parallelograms stay in the first; in the next ones those yield that a bad cell touches,
/// then those in rings round it, until no cell is bad or no more nodes yield. *Collective.*
void sweep_in_rounds(const Communicator& comm, HaloMesh& halo, BoundarySlide& slide,
                     const std::vector<CellTarget>& targets, const Survey& surveyed,
                     const SmoothOptions& options, SmoothReport& report) {
  NodeFlags yielding(halo.points().size(), 0), stale(halo.points().size(), 1), bad = surveyed.bad;
  const bool some_may_yield = comm.any(std::ranges::any_of(surveyed.near.ids(), [&](NodeId node) {
    return surveyed.near[node] != 0 && surveyed.parallel[node] != 0;
  }));
  const int last_round = some_may_yield ? free_rings : 0;
  std::size_t settled = 0;
  for (int round = 0; round <= last_round; ++round) {
    const double threshold = round == 0 ? options.threshold : options.bad;
    if (round > 0) bad = nodes_of_bad_cells(halo, targets, surveyed.near, threshold);
    if (round > 0) look_again_at_slides(halo, slide, bad, stale);
    if (round > 0) yield(halo, bad, round - 1, yielding);
    std::vector<NodeId> free = free_nodes(surveyed, halo, slide, yielding);
    if (!comm.any(free.size() > settled)) return;
    settled = free.size();
    const NodeStars stars(halo, std::move(free), targets);
    const Sweeper::Rule rule{options.method,  options.objective,
                             threshold,       surveyed.tangled,
                             targets.empty(), even_up_to(round, options, !targets.empty())};
    Sweeper sweeper(comm, halo, stars, slide, rule, bad, stale);
    sweep_until_settled(comm, sweeper, options.sweeps, report);
    report.free_nodes = comm.sum(std::ssize(stars));
  }
}

/// Nodes on the front of layers spread evenly, the cells beside it fitted to the layers. *Collective.*
void fit_front(const Communicator& comm, HaloMesh& halo, BoundarySlide& slide,
               std::span<const double> heights) {
  if (!comm.any(!heights.empty())) return;
  even_widths(comm, halo, slide, heights, most_even_sweeps);
  fit_to_layers(comm, halo, slide, heights);
}

/// Moves level lines, which reduces the number of bad nodes. Returns flags of nodes near edges that may have
/// become non-Delaunay; may be empty. *Collective.*
NodeFlags move_level_lines(const Communicator& comm, HaloMesh& halo, bool has_quads,
                           const SmoothOptions& options, const NodeFlags& pinned, NodeFlags& bad) {
  halo.exchange().update(bad);
  NodeFlags doubtful;
  if (has_quads) move_square_lines(comm, halo, pinned, options.bad);
  if (!has_quads) doubtful = move_triangle_lines(comm, halo, bad, pinned, options.threshold);
  bad = nodes_of_bad_cells(halo, {}, bad, options.threshold);
  return doubtful;
}

/// *Collective.*
Survey survey(const HaloMesh& halo, const BadCells& bad, bool any_targets) {
  Survey surveyed{bad.worst.inverted > 0, bad.nodes, bad.nodes, NodeFlags(halo.points().size(), 0)};
  grow(halo, surveyed.near, free_rings);
  if (!any_targets) flag_nodes_of_parallelograms(halo, surveyed.parallel);
  return surveyed;
}

/// The result of moving the nodes of a mesh.
struct Moved {
  WorstCell before;
  WorstCell after;         ///< not computed if flips follow
  bool any_moved = false;  ///< on any rank
  NodeFlags moved;         ///< nodes near which edges may have become non-Delaunay
};

/// Moves the nodes, without flips. *Collective.*
Moved move_nodes(const Communicator& comm, Mesh& mesh, const SmoothOptions& options, SmoothReport& report) {
  std::optional<OutlinePath> outline;
  if (options.geometry != nullptr) outline.emplace(*options.geometry);
  MovableMesh movable(comm, mesh, options.pinned);
  HaloMesh& halo = movable.halo();
  const bool any_targets = comm.any(!options.targets.empty());  // a rank without cells has no targets
  const std::vector<CellTarget> targets =
      any_targets ? halo.spread(comm, options.targets) : std::vector<CellTarget>{};
  BoundarySlide slide(comm, halo, mesh.boundaries, outline ? &*outline : nullptr, movable.pinned(),
                      movable.joined());
  BadCells bad = find_bad_cells(comm, halo, targets, options.threshold);
  NodeFlags doubtful;
  if (options.level_transitions && options.sweeps > 0 && !any_targets)
    doubtful =
        move_level_lines(comm, halo, comm.any(!mesh.quads.empty()), options, movable.pinned(), bad.nodes);
  doubtful = movable.in_given(std::move(doubtful));
  movable.take_positions();
  sweep_in_rounds(comm, halo, slide, targets, survey(halo, bad, any_targets), options, report);
  if (options.sweeps > 0) fit_front(comm, halo, slide, options.front_heights);
  NodeFlags moved = movable.take_positions();
  if (!doubtful.empty()) flag_those_of(doubtful, moved);
  const bool any_moved = comm.any(std::ranges::find(moved, 1) != moved.end());
  const bool flips_follow = options.delaunay && any_moved && bad.worst.inverted == 0;
  return {bad.worst, flips_follow ? WorstCell{} : worst_cell(comm, halo, targets), any_moved,
          std::move(moved)};
}

/// Sweeps, then flips. The report contains the worst cost after flips. *Collective.*
SmoothReport smooth_once(const Communicator& comm, Mesh& mesh, const SmoothOptions& options) {
  SmoothReport report;
  auto [before, after, any_moved, moved] = move_nodes(comm, mesh, options, report);
  const bool sound = after.inverted == 0 || !comm.any(any_turns_right(mesh));
  if (options.delaunay && sound && any_moved) {
    if (options.keep_slots) restore_delaunay(comm, mesh, moved, options.delaunay, options.triangle_to_block);
    if (!options.keep_slots) report.standing = restore_delaunay_nearby(comm, mesh, moved, options.delaunay);
    after = worst_triangle(comm, mesh);
  }
  report.worst_cost_before = before.cost;
  report.worst_cost_after = after.cost;
  report.inverted_before = before.inverted;
  report.inverted_after = after.inverted;
  return report;
}

/// Flags owned nodes: those of triangles that cost more than `limit`, and `rings` rings around them in the
/// mesh before flips. *Collective.*
NodeFlags nodes_near_worse(const Communicator& comm, const Mesh& flipped, const Mesh& before, double limit,
                           int rings) {
  std::vector<GlobalNodeId> of_worse;
  for (const auto& nodes : flipped.triangles) {
    if (cell_cost(corners_of(flipped, nodes), ideal_targets<3>()) <= limit) continue;
    for (const NodeId node : nodes) of_worse.push_back(flipped.global(node));
  }
  const HaloMesh halo(comm, before);
  NodeFlags near(halo.points().size(), 0);
  flag_at_owners(comm, NodeOwners(comm, before.first_node), of_worse, near);
  grow(halo, near, rings);
  near.resize(halo.owned_nodes());
  return near;
}

/// Flips to Delaunay raise the smallest angle but may raise the largest cost. If that exceeds its original
/// value, the nodes near the worse triangles are pinned and the mesh is smoothed again; as a last resort the
/// mesh is left unchanged. *Collective.*
SmoothReport smooth_delaunay(const Communicator& comm, Mesh& mesh, const SmoothOptions& options) {
  QUADLOOP_REQUIRE(!comm.any(!options.targets.empty()), "flips would leave cells without targets");
  QUADLOOP_REQUIRE(options.keep_slots || !comm.any(!options.triangle_to_block.empty()),
                   "blocks are known by slots");
  const Mesh before = mesh;
  SmoothOptions careful = options;
  careful.pinned.resize(mesh.owned_nodes, 0);
  for (int attempt = 1;; ++attempt) {
    const SmoothReport report = smooth_once(comm, mesh, careful);
    const double limit = (1 + cost_rounding) * report.worst_cost_before;
    if (report.worst_cost_after <= limit) return report;
    const NodeFlags worse = nodes_near_worse(comm, mesh, before, limit, pinned_rings * attempt);
    for (const NodeId node : worse.ids()) careful.pinned[node] |= worse[node];
    if (attempt == most_attempts) careful.sweeps = 0;
    mesh = before;
  }
}

SmoothReport smooth_ordinary(const Communicator& comm, Mesh& mesh, const SmoothOptions& options) {
  return options.delaunay ? smooth_delaunay(comm, mesh, options) : smooth_once(comm, mesh, options);
}

}  // namespace

SmoothOptions sparing_parallelograms(SmoothOptions options) {
  constexpr double cost_at_hanging_nodes = 0.0945;  // Eq. 3.2, rounded up
  options.level_transitions = false;
  options.bad = cost_at_hanging_nodes;
  return options;
}

SmoothReport smooth_mesh(const Communicator& comm, Mesh& mesh, const SmoothOptions& options) {
  if (options.mirror) {
    return smooth_mirrored(comm, mesh, options, [&](Mesh& half, const SmoothOptions& of_half) {
      return smooth_mesh(comm, half, of_half);
    });
  }
  const BinaryUnit unit(comm, mesh);
  if (unit.is_one()) return smooth_ordinary(comm, mesh, options);
  SmoothOptions scaled_options = options;
  std::optional<Geometry> scaled_geometry;
  if (options.geometry != nullptr)
    scaled_options.geometry = &scaled_geometry.emplace(unit.into(*options.geometry));
  for (double& height : scaled_options.front_heights) height = unit.into(Point{height, 0}).x;
  if (options.delaunay) scaled_options.delaunay = [&](Point p) { return options.delaunay(unit.out_of(p)); };
  const std::vector<PeriodicPair> pairs = mesh.pairs;
  for (Point& p : mesh.points) p = unit.into(p);
  for (PeriodicPair& pair : mesh.pairs) {
    pair.translation = unit.into(pair.translation);
    pair.centre = unit.into(pair.centre);
  }
  const SmoothReport report = smooth_ordinary(comm, mesh, scaled_options);
  for (Point& p : mesh.points) p = unit.out_of(p);
  mesh.pairs = pairs;
  return report;
}

}  // namespace quadloop::smoother
