#include "mesher/sizes/quartered_square.hpp"

namespace quadloop {

namespace {

/// For a vertex: whether it is beyond each of the three lines along each axis.
struct Vertex {
  std::array<bool, 3> x{}, y{};
  bool in(int column, int row) const { return x[column] && !x[column + 1] && y[row] && !y[row + 1]; }
};

/// Whether both are before the interval between two consecutive lines, or both beyond it.
bool miss(const std::array<bool, 3>& a, const std::array<bool, 3>& b, int stretch) {
  return (!a[stretch] && !b[stretch]) || (a[stretch + 1] && b[stretch + 1]);
}

}  // namespace

QuarteredSquare::QuarteredSquare(const ShiftedOutline& outline, const TreeGrid& grid, const Quadrant& square)
    : outline_{&outline} {
  for (const int line : {0, 1, 2}) {
    x_[line] = grid.x(square.x + line * square.size() / 2);
    y_[line] = grid.y(square.y + line * square.size() / 2);
  }
}

QuarteredSquare::Passage QuarteredSquare::passage_of(std::int32_t segment) const {
  const std::int32_t end = outline_->geometry().next(segment);
  Passage passage;
  const bool east = outline_->beyond_x(segment, x_[1]), north = outline_->beyond_y(segment, y_[1]);
  const bool is_one = outline_->beyond_x(end, x_[1]) == east && outline_->beyond_y(end, y_[1]) == north;
  if (is_one) passage.quarters = 1U << (2 * north + east);
  if (is_one && (east || north)) return passage;  // those are not on any path to the other quarters
  const auto vertex = [&](std::int32_t v) {
    Vertex at;
    for (const int line : {0, 1, 2}) {
      at.x[line] = outline_->beyond_x(v, x_[line]);
      at.y[line] = outline_->beyond_y(v, y_[line]);
    }
    return at;
  };
  const Vertex a = vertex(segment), b = vertex(end);
  if (is_one && a.x == b.x && a.y == b.y) return passage;
  std::array<std::array<bool, 3>, 3> left{};  // row by row: whether the corner is to the left of the segment
  for (const int row : {0, 1, 2}) {
    for (const int column : {0, 1, 2}) left[row][column] = outline_->has_left(segment, {x_[column], y_[row]});
  }
  for (const int row : {0, 1}) {
    for (const int column : {0, 1}) {
      if (miss(a.x, b.x, column) || miss(a.y, b.y, row)) continue;
      const bool side = left[row][column];
      const bool passes =
          left[row][column + 1] != side || left[row + 1][column] != side || left[row + 1][column + 1] != side;
      if (passes || a.in(column, row) || b.in(column, row)) passage.quarters |= 1U << (2 * row + column);
    }
  }
  if (a.y[0] != b.y[0]) passage.winding[1] = left[0][1] - left[0][0];
  if (a.x[0] != b.x[0]) passage.winding[2] = left[1][0] - left[0][0];
  passage.winding[3] = passage.winding[2] + (a.y[1] != b.y[1] ? left[1][1] - left[1][0] : 0);
  return passage;
}

}  // namespace quadloop
