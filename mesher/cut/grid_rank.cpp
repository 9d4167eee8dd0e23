#include "mesher/cut/grid_rank.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace quadloop {

namespace {

/// Trailing zeros of a line's number, at most those of a tree's edge, so that the sides of the root have
/// equal rank.
std::int8_t zeros_of(std::int64_t line) {
  if (line == 0) return Quadrant::unit_level;
  return static_cast<std::int8_t>(
      std::min(Quadrant::unit_level, std::countr_zero(static_cast<std::uint64_t>(line))));
}

}  // namespace

TieRank line_rank(std::int64_t column, std::int64_t row) {
  // from a list: values, not references
  const auto [low, high] = std::minmax({zeros_of(column), zeros_of(row)});
  return {low, high, 0, 0, 0, 0};
}

TieRank tie_rank(const TreeGrid& grid, int finest_level, Point position, std::optional<MirrorAxis> mirror) {
  TieRank rank = tie_rank(grid.box().centre(), position);
  // The coordinate along the axis comes first, as it is the same for the image.
  if (mirror == MirrorAxis::y) std::swap(rank.x, rank.y);
  const auto column = grid.column_on(position.x, finest_level), row = grid.row_on(position.y, finest_level);
  if (!column || !row) return rank;  // not on lines of the tree
  const TieRank lines = line_rank(*column, *row);
  rank.coarser = lines.coarser;
  rank.finer = lines.finer;
  return rank;
}

}  // namespace quadloop
