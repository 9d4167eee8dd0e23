#include "smoother/smooth_mesh.hpp"

#include <algorithm>
#include <optional>

#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/restore_delaunay.hpp"
#include "smoother/boundary_slide.hpp"
#include "smoother/colouring.hpp"
#include "smoother/untangle.hpp"

namespace quadloop {

namespace {

constexpr int free_rings = 3;  ///< of nodes round those of cells above the threshold that may come to move

template <std::size_t width>
std::array<Point, width> corners_of(const HaloMesh& mesh, const std::array<NodeId, width>& nodes) {
  std::array<Point, width> points;
  for (std::size_t k = 0; k < width; ++k) points[k] = mesh.point(nodes[k]);
  return points;
}

/// Most cells are whole leaves, whose cost is 0 to the last bit.
bool is_square(const std::array<Point, 4>& p) {
  return p[0].y == p[1].y && p[1].x == p[2].x && p[2].y == p[3].y && p[3].x == p[0].x && p[1].x - p[0].x == p[2].y - p[1].y && p[0].x < p[1].x;
}
bool is_square(const std::array<Point, 3>&) { return false; }

/// The cost of a cell by its number in the halo mesh.
template <std::size_t width>
double cost_of(const HaloMesh& mesh, const std::array<NodeId, width>& nodes, const std::vector<CellTarget>& targets, std::size_t number) {
  const bool ideal = targets.empty() || targets[number].ideal();
  const auto corners = corners_of(mesh, nodes);
  if (ideal && is_square(corners)) return 0;
  return cell_cost(corners, ideal ? ideal_targets<width>() : stretched_targets<width>(targets[number].w1, targets[number].w2));
}

struct WorstCell {
  double cost = 0;
  std::int64_t inverted = 0;
};

/// What has to be known before the first sweep: the worst cell, and the nodes that may come to move.
struct Survey {
  WorstCell worst;
  std::vector<double> costs;  ///< of each cell of the halo mesh
  std::vector<char> near;     ///< a flag for each node: of a cell above the threshold, or some rings round those
};

template <class Nodes>
bool any_flagged(const std::vector<char>& flags, const Nodes& nodes) {
  return std::any_of(nodes.begin(), nodes.end(), [&](NodeId n) { return flags[static_cast<std::size_t>(n.value())] != 0; });
}

WorstCell over_ranks(const Communicator& comm, const WorstCell& worst) { return {comm.maximum(worst.cost), comm.sum(worst.inverted)}; }

/// Adds a cell to a rank's worst; those that other ranks have too count where their first node is owned.
void include(WorstCell& worst, const HaloMesh& mesh, NodeId first, double cost) {
  worst.cost = std::max(worst.cost, cost);
  worst.inverted += cost >= 1 && first.value() < mesh.owned_nodes() ? 1 : 0;
}

/// *Collective.*
Survey survey(const Communicator& comm, const HaloMesh& mesh, const std::vector<CellTarget>& targets, double threshold) {
  Survey result;
  std::vector<char>& near = result.near;
  near.assign(mesh.points().size(), 0);
  const auto mark = [&](const auto& nodes) {
    for (const NodeId node : nodes) near[static_cast<std::size_t>(node.value())] = 1;
  };
  result.costs.reserve(mesh.points().size());
  mesh.for_each_cell([&](const auto& nodes) {
    const double cost = cost_of(mesh, nodes, targets, result.costs.size());
    include(result.worst, mesh, nodes[0], cost);
    result.costs.push_back(cost);
    if (cost > threshold) mark(nodes);
  });
  for (int ring = 0; ring < free_rings; ++ring) {
    mesh.exchange().update(near);
    const std::vector<char> before = near;
    mesh.for_each_cell([&](const auto& nodes) {
      if (any_flagged(before, nodes)) mark(nodes);
    });
  }
  mesh.exchange().update(near);
  result.worst = over_ranks(comm, result.worst);
  return result;
}

std::vector<std::int32_t> free_nodes(const Survey& surveyed, const HaloMesh& mesh, const BoundarySlide& slide) {
  std::vector<std::int32_t> free;
  for (std::int32_t node = 0; node < mesh.owned_nodes(); ++node) {
    if (surveyed.near[static_cast<std::size_t>(node)] != 0 && slide.freedom(node) != NodeFreedom::fixed) free.push_back(node);
  }
  return free;
}

/// Visits the nodes sweep by sweep.
class Sweeper {
 public:
  Sweeper(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars, const BoundarySlide& slide, const SmoothOptions& options)
      : comm_{comm}, mesh_{mesh}, stars_{stars}, slide_{slide}, options_{options}, solver_{make_node_solver(options.method)} {
    const Colouring colouring = colour_nodes(comm, mesh, stars);
    by_colour_.resize(static_cast<std::size_t>(colouring.count));
    for (std::size_t i = 0; i < stars.size(); ++i) {
      by_colour_[static_cast<std::size_t>(colouring.colour_of[static_cast<std::size_t>(stars.nodes()[i])])].push_back(i);
    }
    moved_at_.assign(mesh.points().size(), 0);
    visited_at_.assign(stars.size(), -1);
    worst_.assign(stars.size(), 0);
    bad_.assign(mesh.points().size(), 0);
  }

  /// Returns the number of nodes moved over all ranks. *Collective.*
  std::int64_t sweep() {
    find_bad();
    std::int64_t moves = 0;
    for (const auto& nodes : by_colour_) {
      ++clock_;
      for (const std::size_t i : nodes) {
        if (is_active(i) && is_stale(i)) moves += visit(i) ? 1 : 0;
      }
      share_moves();
    }
    return comm_.sum(moves);
  }

 private:
  std::int32_t node(std::size_t i) const { return stars_.nodes()[i]; }
  std::int32_t moved_at(std::int32_t n) const { return moved_at_[static_cast<std::size_t>(n)]; }

  /// Whether the node or one that it shares a cell with has moved since it was last visited.
  bool is_stale(std::size_t i) const {
    bool stale = moved_at(node(i)) >= visited_at_[i];
    stars_.for_each_neighbour(i, [&](std::int32_t other) { stale = stale || moved_at(other) >= visited_at_[i]; });
    return stale;
  }

  /// Flags the nodes of cells above the threshold, of other ranks too.
  void find_bad() {
    for (std::size_t i = 0; i < stars_.size(); ++i) {
      if (!is_stale(i)) continue;
      stars_.gather(i, star_);
      bad_[static_cast<std::size_t>(node(i))] = star_.worst_cost(mesh_.points()[static_cast<std::size_t>(node(i))]) > options_.threshold ? 1 : 0;
    }
    mesh_.exchange().update(bad_);
  }

  bool is_active(std::size_t i) const {
    bool active = bad_[static_cast<std::size_t>(node(i))] != 0;
    stars_.for_each_neighbour(i, [&](std::int32_t other) { active = active || bad_[static_cast<std::size_t>(other)] != 0; });
    return active;
  }

  bool visit(std::size_t i) {
    stars_.gather(i, star_);
    visited_at_[i] = clock_;
    const std::int32_t n = node(i);
    Point& p = mesh_.points()[static_cast<std::size_t>(n)];
    const auto better = better_place(n, p);
    if (!better) return false;
    p = *better;
    moved_at_[static_cast<std::size_t>(n)] = clock_;
    return true;
  }

  std::optional<Point> better_place(std::int32_t n, Point p) {
    if (slide_.freedom(n) == NodeFreedom::sliding) return slide_.improve(n, star_, options_.objective);
    if (star_.cost(p, options_.objective).valid[0]) return solver_->improve(star_, p, options_.objective);
    return untangle(star_, p);
  }

  void share_moves() {
    const auto just_moved = [&](std::int32_t n) { return moved_at(n) == clock_; };
    mesh_.exchange().update(mesh_.points(), just_moved);
    mesh_.exchange().update(moved_at_, just_moved);
  }

  const Communicator& comm_;
  HaloMesh& mesh_;
  const NodeStars& stars_;
  const BoundarySlide& slide_;
  const SmoothOptions& options_;
  std::unique_ptr<NodeSolver> solver_;
  std::vector<std::vector<std::size_t>> by_colour_;
  std::vector<std::int32_t> moved_at_;    ///< the clock when each node moved last
  std::vector<std::int32_t> visited_at_;  ///< the clock when each free node was visited last
  std::vector<double> worst_;
  std::vector<char> bad_;
  std::int32_t clock_ = 0;
  Star star_;
};

/// The worst cell now; cells away from nodes that may have moved are as they were. *Collective.*
WorstCell worst_cell(const Communicator& comm, const HaloMesh& mesh, const std::vector<CellTarget>& targets, const Survey& before) {
  WorstCell worst;
  std::size_t number = 0;
  mesh.for_each_cell([&](const auto& nodes) {
    const double cost = any_flagged(before.near, nodes) ? cost_of(mesh, nodes, targets, number) : before.costs[number];
    include(worst, mesh, nodes[0], cost);
    ++number;
  });
  return over_ranks(comm, worst);
}

/// Puts the nodes where they are now; flags those that have moved.
std::vector<char> take_positions(const HaloMesh& from, Mesh& to) {
  std::vector<char> moved(to.points.size(), 0);
  for (std::size_t node = 0; node < to.points.size(); ++node) {
    moved[node] = to.points[node] != from.points()[node] ? 1 : 0;
    to.points[node] = from.points()[node];
  }
  return moved;
}

/// Whether a triangle is inverted or flat, exactly: some that count as flat when they are smoothed are none.
bool any_turns_right(const Mesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const auto& t) { return orientation(mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2])) <= 0; });
}

}  // namespace

SmoothReport smooth_mesh(const Communicator& comm, Mesh& mesh, const SmoothOptions& options) {
  SmoothReport report;
  std::optional<OutlinePath> outline;
  if (options.geometry != nullptr) outline.emplace(*options.geometry);
  HaloMesh halo(comm, mesh);
  const std::vector<CellTarget> targets = comm.any(!options.targets.empty()) ? halo.spread(comm, options.targets) : std::vector<CellTarget>{};
  const BoundarySlide slide(comm, halo, mesh.boundaries, outline ? &*outline : nullptr, options.pinned);
  const Survey before = survey(comm, halo, targets, options.threshold);
  const NodeStars stars(halo, free_nodes(before, halo, slide), targets);
  Sweeper sweeper(comm, halo, stars, slide, options);
  for (std::int64_t moves = 1; report.sweeps < options.sweeps && moves > 0; ++report.sweeps) {
    moves = sweeper.sweep();
    report.moves += moves;
  }
  const WorstCell after = worst_cell(comm, halo, targets, before);
  report.inverted_after = after.inverted;
  const std::vector<char> moved = take_positions(halo, mesh);
  const bool sound = report.inverted_after == 0 || !comm.any(any_turns_right(mesh));
  if (options.delaunay && sound) restore_delaunay(comm, mesh, moved, options.delaunay);
  report.free_nodes = comm.sum(static_cast<std::int64_t>(stars.size()));
  report.worst_cost_before = before.worst.cost;
  report.worst_cost_after = after.cost;
  report.inverted_before = before.worst.inverted;
  return report;
}

}  // namespace quadloop
