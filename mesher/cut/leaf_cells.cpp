#include "mesher/cut/leaf_cells.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/base/error.hpp"
#include "mesher/cut/lattice_rank.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

// Of the corners of quadrilaterals: at most 50 degrees from the right angle in a whole leaf, whose corners
// may have been snapped, 40 in a cut one.
constexpr double whole_cosine = 0.766, cut_cosine = 0.643;

bool is_whole(const CutLeaf& leaf, std::span<const std::int32_t> loop) {
  return std::all_of(loop.begin(), loop.end(),
                     [&](std::int32_t n) { return leaf.nodes[static_cast<std::size_t>(n)].place < 4; });
}

/// Strictly convex, in plain doubles as every reader of the mesh will compute it, and no corner far from a
/// right angle: such a quadrilateral stays one.
bool is_well_shaped(const CutLeaf& leaf, std::span<const std::int32_t> loop, double largest_cosine) {
  const auto at = [&](std::size_t i) { return leaf.nodes[static_cast<std::size_t>(loop[i % 4])].position; };
  for (std::size_t i = 0; i < 4; ++i) {
    const Point u = at(i + 1) - at(i), v = at(i + 3) - at(i);
    if (cross(u, v) <= 0 || orientation(at(i + 3), at(i), at(i + 1)) <= 0) return false;
    if (std::abs(dot(u, v)) > largest_cosine * length(u) * length(v)) return false;
  }
  return true;
}

using Template = std::array<LocalTriangle, 5>;

/// A hanging node on side s, or on s and s+1: the templates of the bottom side, turned.
Template turned(const Template& bottom, int s) {
  Template result = bottom;
  for (auto& triangle : result) {
    for (auto& n : triangle) n = n < 4 ? (n + s) % 4 : 4 + (n - 4 + s) % 4;
  }
  return result;
}

constexpr Template one_hanging{{{0, 4, 3}, {4, 1, 2}, {4, 2, 3}, {}, {}}};
constexpr Template two_hanging{{{0, 4, 3}, {4, 5, 3}, {4, 1, 5}, {5, 2, 3}, {}}};

}  // namespace

void LeafCellMaker::set_ranks(const Quadrant& q, const Box& box, const CutLeaf& leaf) {
  const std::int64_t s = q.size(), half = s / 2;
  const std::array<std::array<std::int64_t, 2>, 8> offset{
      {{0, 0}, {s, 0}, {s, s}, {0, s}, {half, 0}, {s, half}, {half, s}, {0, half}}};
  const std::array<Point, 4> corner{box.low, Point{box.high.x, box.low.y}, box.high,
                                    Point{box.low.x, box.high.y}};
  std::array<TieRank, 8> lattice;
  for (std::size_t i = 0; i < 8; ++i) lattice[i] = line_rank(q.x + offset[i][0], q.y + offset[i][1]);
  const auto origin = corner[static_cast<std::size_t>(std::max_element(lattice.begin(), lattice.begin() + 4) -
                                                      lattice.begin())];
  ranks_.clear();
  for (const CutLeaf::Node& node : leaf.nodes) {
    TieRank rank = node.place < 8 ? lattice[static_cast<std::size_t>(node.place)] : TieRank{};
    const auto [near, far] = std::minmax(
        {std::abs(node.position.x - origin.x), std::abs(node.position.y - origin.y)});  // a list: values
    rank.farther = far;
    rank.nearer = near;
    ranks_.push_back(rank);
  }
}

bool LeafCellMaker::make(const Quadrant& q, const Box& box, const CutLeaf& leaf, LeafCells& cells) {
  cells.triangles.clear();
  cells.quads.clear();
  smallest_sine_ = 1;
  points_.clear();
  for (const CutLeaf::Node& node : leaf.nodes) points_.push_back(node.position);
  set_ranks(q, box, leaf);
  std::vector<std::span<const std::int32_t>> loops;
  bool holes = false;
  for (std::size_t i = 0; i < leaf.loop_count(); ++i) {
    loops.push_back(leaf.loop(i));
    holes = holes || winding_of(leaf, leaf.loop(i)) < 0;
  }
  if (holes) return triangulate(loops, cells);
  for (const auto& loop : loops) {
    if (loop.size() == 4 && is_well_shaped(leaf, loop, is_whole(leaf, loop) ? whole_cosine : cut_cosine)) {
      cells.quads.push_back({loop[0], loop[1], loop[2], loop[3]});
    } else if (!triangulate(std::span(&loop, 1), cells)) {
      return false;
    }
  }
  return true;
}

bool LeafCellMaker::triangulate(std::span<const std::span<const std::int32_t>> loops, LeafCells& cells) {
  if (!triangulator_.triangulate(points_, ranks_, loops, cells.triangles)) return false;
  smallest_sine_ = std::min(smallest_sine_, triangulator_.smallest_sine());
  return true;
}

std::span<const LocalTriangle> hanging_template(unsigned finer) {
  static const std::array<Template, 4> one{one_hanging, turned(one_hanging, 1), turned(one_hanging, 2),
                                           turned(one_hanging, 3)};
  static const std::array<Template, 4> two{two_hanging, turned(two_hanging, 1), turned(two_hanging, 2),
                                           turned(two_hanging, 3)};
  if (std::has_single_bit(finer))
    return std::span(one[static_cast<std::size_t>(std::countr_zero(finer))]).first(3);
  const int side = finer == 0b1001 ? 3 : std::countr_zero(finer);
  QUADLOOP_REQUIRE(finer == 0b1001 || finer == 0b11U << side, "a leaf has hanging nodes on opposite sides");
  return std::span(two[static_cast<std::size_t>(side)]).first(4);
}

}  // namespace quadloop
