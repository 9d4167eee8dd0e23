#include "mesher/cut/leaf_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/base/error.hpp"
#include "mesher/cut/grid_rank.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

// Maximum deviation of quadrilateral corners from 90 degrees: 50 degrees in an uncut leaf, whose corners may
// be snapped, 40 in a cut one.
constexpr double whole_cosine = 0.766, cut_cosine = 0.643;

bool is_whole(const CutLeaf& leaf, std::span<const std::int32_t> loop) {
  return std::all_of(loop.begin(), loop.end(), [&](std::int32_t n) { return is_corner(leaf.nodes[n].site); });
}

/// Whether the quadrilateral is strictly convex, in the rounded arithmetic of any reader of the mesh, and no
/// corner is far from a right angle: then it is kept.
bool is_well_shaped(const CutLeaf& leaf, std::span<const std::int32_t> loop, double largest_cosine) {
  const auto at = [&](std::size_t i) { return leaf.nodes[loop[i % 4]].position; };
  for (std::size_t i = 0; i < 4; ++i) {
    const Point u = at(i + 1) - at(i), v = at(i + 3) - at(i);
    if (cross(u, v) <= 0 || orientation(at(i + 3), at(i), at(i + 1)) <= 0) return false;
    if (std::abs(dot(u, v)) > largest_cosine * length(u) * length(v)) return false;
  }
  return true;
}

using Template = std::array<SiteTriangle, 4>;

/// Rotates a template of the bottom side to each side.
constexpr std::array<Template, 4> turned_templates(const Template& bottom) {
  std::array<Template, 4> result{bottom, bottom, bottom, bottom};
  for (const Side side : all_sides) {
    for (SiteTriangle& triangle : result[index_of(side)]) {
      for (Site& site : triangle) site = turned(site, side);
    }
  }
  return result;
}

/// Templates of three triangles (a hanging node on a side) and of four (another one on the next side).
constexpr std::array<Template, 4> one_hanging =
    turned_templates({{{Site::south_west, Site::bottom_middle, Site::north_west},
                       {Site::bottom_middle, Site::south_east, Site::north_east},
                       {Site::bottom_middle, Site::north_east, Site::north_west},
                       {}}});
constexpr std::array<Template, 4> two_hanging =
    turned_templates({{{Site::south_west, Site::bottom_middle, Site::north_west},
                       {Site::bottom_middle, Site::right_middle, Site::north_west},
                       {Site::bottom_middle, Site::south_east, Site::right_middle},
                       {Site::right_middle, Site::north_east, Site::north_west}}});

}  // namespace

const TieRank& LeafCellMaker::rank_of(std::int32_t node) {
  if (ranks_.empty()) set_ranks();
  return ranks_[node];
}

void LeafCellMaker::set_ranks() {
  const Quadrant& q = *leaf_.quadrant;
  const Box& box = *leaf_.box;
  const std::array<Point, 4> corner{box.low, Point{box.high.x, box.low.y}, box.high,
                                    Point{box.low.x, box.high.y}};
  std::array<TieRank, 8> grid;
  for (const Site site : grid_sites) grid[index_of(site)] = line_rank(q.at(site).x, q.at(site).y);
  const auto origin = corner[std::max_element(grid.begin(), grid.begin() + 4) - grid.begin()];
  for (const CutLeaf::Node& node : leaf_.cut->nodes) {
    TieRank rank = is_on_grid(node.site) ? grid[index_of(node.site)] : TieRank{};
    const auto [near, far] = std::minmax(
        {std::abs(node.position.x - origin.x), std::abs(node.position.y - origin.y)});  // from a list: values
    rank.farther = far;
    rank.nearer = near;
    ranks_.push_back(rank);
  }
}

bool LeafCellMaker::make(const Quadrant& q, const Box& box, const CutLeaf& leaf, LeafCells& cells) {
  cells.triangles.clear();
  cells.quads.clear();
  cells.triangle_blocks.clear();
  cells.quad_blocks.clear();
  smallest_sine_ = 1;
  points_.clear();
  for (const CutLeaf::Node& node : leaf.nodes) points_.push_back(node.position);
  ranks_.clear();
  leaf_ = {&q, &box, &leaf};
  constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
  for (std::int32_t block = -1;;) {
    std::int32_t next = none;
    for (const std::int32_t other : leaf.loop_blocks) next = other > block ? std::min(next, other) : next;
    if (next == none) return true;
    block = next;
    if (!make_block(block, cells)) return false;
    cells.triangle_blocks.resize(cells.triangles.size(), block);
    cells.quad_blocks.resize(cells.quads.size(), block);
  }
}

bool LeafCellMaker::make_block(std::int32_t block, LeafCells& cells) {
  const CutLeaf& leaf = *leaf_.cut;
  loops_.clear();
  for (std::size_t i = 0; i < leaf.loop_count(); ++i) {
    if (leaf.loop_blocks[i] == block) loops_.push_back(leaf.loop(i));
  }
  const bool holes = loops_.size() > 1 && std::any_of(loops_.begin(), loops_.end(), [&](const auto& loop) {
                       return loop.size() < 3 || winding_of(leaf, loop) < 0;
                     });
  if (holes) return triangulate(loops_, cells);
  for (const auto& loop : loops_) {
    if (loop.size() == 4 && is_well_shaped(leaf, loop, is_whole(leaf, loop) ? whole_cosine : cut_cosine)) {
      cells.quads.push_back({loop[0], loop[1], loop[2], loop[3]});
    } else if (!triangulate(std::span(&loop, 1), cells)) {
      return false;
    }
  }
  return true;
}

bool LeafCellMaker::triangulate(std::span<const std::span<const std::int32_t>> loops, LeafCells& cells) {
  if (!triangulator_.triangulate(
          points_, [this](std::int32_t node) { return rank_of(node); }, loops, cells.triangles))
    return false;
  smallest_sine_ = std::min(smallest_sine_, triangulator_.smallest_sine());
  return true;
}

std::span<const SiteTriangle> hanging_template(SideSet hanging) {
  for (const Side side : all_sides) {
    if (hanging == SideSet{side}) return std::span(one_hanging[index_of(side)]).first(3);
    if (hanging == SideSet{side, next(side)}) return two_hanging[index_of(side)];
  }
  throw Fault("a leaf has hanging nodes on opposite sides");
}

}  // namespace quadloop
