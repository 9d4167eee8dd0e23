#include "smoother/sweeps/node_stars.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesher/base/ids.hpp"
#include "smoother/sweeps/rings.hpp"

namespace quadloop::smoother {

namespace {

/// Number of corners whose shape depends on one node of the cell.
template <std::size_t width>
constexpr std::size_t corners_of_cell = width == 3 ? 1 : 3;

template <std::size_t width>
constexpr std::int32_t ideal_begin = width == 3 ? 0 : 3;

}  // namespace

/// Targets of a cell's corners as its nodes see them. Triangle: each node's own corner. Quadrilateral: for
/// each node its own corner, that of the next node, then that of the previous one.
template <std::size_t width>
std::vector<NodeStars::SeenTarget> NodeStars::seen_targets(
    const std::array<CornerTarget, width>& of_corners) {
  std::vector<SeenTarget> seen;
  for (std::size_t k = 0; k < width; ++k) {
    seen.push_back({of_corners[k], width == 3 ? CellAngle::all : CellAngle::at_p});
    if (width == 3) continue;
    seen.push_back({seen_from_next(seen_from_next(of_corners[(k + 1) % width])), CellAngle::at_q});
    seen.push_back({seen_from_next(of_corners[(k + width - 1) % width]), CellAngle::at_r});
  }
  return seen;
}

NodeStars::NodeStars(const HaloMesh& mesh, std::vector<NodeId> free_nodes,
                     const std::vector<CellTarget>& targets)
    : mesh_{mesh}, nodes_{std::move(free_nodes)} {
  for (const auto& seen : {seen_targets<3>(ideal_targets<3>()), seen_targets<4>(ideal_targets<4>())}) {
    seen_.insert(seen_.end(), seen.begin(), seen.end());
  }
  number_stars();
  const Touched touched = find_starts();
  corners_.resize(starts_.back());
  if (!targets.empty() || mesh.has_quads()) seen_of_.resize(corners_.size());
  std::size_t number = 0;
  mesh.for_each_cell([&](const auto& cell) {
    const std::size_t cell_number = number++;
    if (touched.cells[cell_number] != 0)
      add_cell(cell, targets.empty() ? CellTarget{} : targets[cell_number]);
  });
  starts_.pop_back();
  list_stars_round_ghosts(touched.near_ghosts);
}

std::vector<std::int32_t> NodeStars::all() const {
  std::vector<std::int32_t> stars(nodes_.size());
  std::iota(stars.begin(), stars.end(), 0);
  return stars;
}

void NodeStars::number_stars() {
  star_of_.resize(mesh_.points().size(), -1);
  for (std::int32_t i = 0; const NodeId node : nodes_) star_of_[node] = i++;
}

/// Starts are shifted by one entry until the corners are added.
NodeStars::Touched NodeStars::find_starts() {
  Touched touched;
  touched.cells.reserve(mesh_.cell_count());
  starts_.assign(nodes_.size() + 2, 0);
  mesh_.for_each_cell([&](const auto& cell) {
    bool any = false, any_copy = false;
    for (const NodeId node : cell) {
      const std::int32_t star = star_of_[node];
      if (star < 0) {
        any_copy |= !mesh_.owns(node);
        continue;
      }
      any = true;
      starts_[star + std::size_t{2}] +=
          corners_of_cell<std::tuple_size_v<std::remove_cvref_t<decltype(cell)>>>;
    }
    touched.cells.push_back(any ? 1 : 0);
    if (!any || !any_copy) return;
    for (const NodeId node : cell) {
      if (star_of_[node] >= 0) touched.near_ghosts.push_back(star_of_[node]);
    }
  });
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<std::int32_t>& near = touched.near_ghosts;
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return touched;
}

/// Ghost nodes are few and lie at partition borders.
void NodeStars::list_stars_round_ghosts(const std::vector<std::int32_t>& near_ghosts) {
  ghost_starts_.assign(mesh_.points().size() - mesh_.owned_nodes() + 1, 0);
  const auto for_each_pair = [&](const auto& visit) {
    for (const std::int32_t star : near_ghosts) {
      for_each_neighbour(star, [&](NodeId other) {
        if (!mesh_.owns(other)) visit(other.value() - mesh_.owned_nodes(), star);
      });
    }
  };
  for_each_pair([&](std::int32_t copy, std::int32_t) { ++ghost_starts_[copy + 1]; });
  std::partial_sum(ghost_starts_.begin(), ghost_starts_.end(), ghost_starts_.begin());
  ghost_stars_.resize(ghost_starts_.back());
  std::vector<std::size_t> ends(ghost_starts_.begin(), ghost_starts_.end() - 1);
  for_each_pair([&](std::int32_t copy, std::int32_t star) { ghost_stars_[ends[copy]++] = star; });
}

template <std::size_t width>
std::int32_t NodeStars::first_seen(const CellTarget& target) {
  if (target.ideal()) return ideal_begin<width>;
  const auto begin = size32(seen_);
  const auto seen = seen_targets<width>(stretched_targets<width>(target.w1, target.w2));
  seen_.insert(seen_.end(), seen.begin(), seen.end());
  return begin;
}

template <std::size_t width>
void NodeStars::add_cell(const std::array<NodeId, width>& cell, const CellTarget& target) {
  constexpr std::int32_t nodes{width}, per_node{corners_of_cell<width>};
  std::int32_t seen = -1;
  for (std::int32_t k = 0; k < nodes; ++k) {
    const std::int32_t star = star_of_[cell[k]];
    if (star < 0) continue;
    std::size_t& end = starts_[star + std::size_t{1}];
    if (seen < 0 && !seen_of_.empty()) seen = first_seen<width>(target);
    const NodeId next = cell[(k + 1) % width], previous = cell[(k + width - 1) % width];
    const std::int32_t own = seen + per_node * k;
    for (std::int32_t c = 0; c < per_node && !seen_of_.empty(); ++c) seen_of_[end + c] = own + c;
    corners_[end++] = {next, previous};
    if constexpr (width == 4) {
      const NodeId opposite = cell[(k + 2) % width];
      corners_[end++] = {next, opposite};
      corners_[end++] = {opposite, previous};
    }
  }
}

bool NodeStars::costs_more(std::size_t i, double limit) const {
  const Point p = mesh_.point(nodes_[i]);
  // Lower limit of 1 / condition number; positive, so J must be positive too.
  const double least = 1 - std::sqrt(limit);
  for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k) {
    const CornerForm form = corner_form(p, mesh_.point(corners_[k].q), mesh_.point(corners_[k].r));
    if (!(form.jacobian > least * weighted_edges(form, seen(k).target))) return true;
  }
  return false;
}

void NodeStars::fetch_corners_ahead(std::span<const std::int32_t> order, std::size_t k) const {
  constexpr std::size_t far = 16, line = 64 / sizeof(Corner);
  if (k + 2 * far < order.size()) {
    __builtin_prefetch(&starts_[order[k + 2 * far]]);
    __builtin_prefetch(&nodes_[order[k + 2 * far]]);
  }
  if (k + far < order.size()) {
    const auto corners = corners_of(order[k + far]);
    for (std::size_t c = 0; c < corners.size(); c += line) __builtin_prefetch(&corners[c]);
  }
}

void NodeStars::fetch_points_ahead(std::span<const std::int32_t> order, std::size_t k) const {
  constexpr std::size_t near = 8;
  if (k + near < order.size()) {
    for (const Corner& c : corners_of(order[k + near])) __builtin_prefetch(&mesh_.point(c.q));
  }
}

void NodeStars::gather(std::size_t i, Star& star) const {
  const std::size_t begin = starts_[i];
  star.assign(starts_[i + 1] - begin, [&](std::size_t c) {
    const SeenTarget& should = seen(begin + c);
    const Corner& corner = corners_[begin + c];
    return StarCorner{mesh_.point(corner.q), mesh_.point(corner.r), should.target, should.angle};
  });
}

}  // namespace quadloop::smoother
