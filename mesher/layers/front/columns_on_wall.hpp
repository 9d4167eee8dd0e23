#pragma once

#include <memory>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

/// The columns of a wall's stations: straight lines from the wall to the layer front. Where a run ends on a
/// curve, the last column is a part of the curve.
struct WallColumns {
  std::vector<Point> direction;  ///< unit vector, away from the wall
  std::vector<double> length;    ///< on a curve: the distance along its path

  Point front(const WallLine& line, std::int32_t i) const {
    if (line.ends_on_curve(i)) return line.end_path(i).point_at(length[i]);
    return line[i].wall + length[i] * direction[i];
  }
};

/// Columns for layers of given thicknesses (normal to the wall, one for each station), for one set of these
/// after another: each time the work is that of the places that have changed and of those whose columns
/// depend on them, with the columns that a first set would have, bit for bit. Each stands normal to the wall
/// where it can. Beside a concave corner, an end or a wake, columns lean as the one there does, less with the
/// distance, so that the front is the wall's offset line and nothing crosses; where columns would come too
/// close to each other, or spread too far, directions are averaged along the wall, but a column always rises
/// visibly from both sides of its station.
/// Thickness changes by at most 0.35 of the distance along the wall.
class ColumnsOnWall {
 public:
  /// `line` must outlive it. The ranks of `sharing` have the same line and divide the work; they get the
  /// columns that a rank alone does, bit for bit. Null: this rank is alone.
  explicit ColumnsOnWall(const WallLine& line, const Communicator* sharing = nullptr);
  ~ColumnsOnWall();
  ColumnsOnWall(const ColumnsOnWall&) = delete;
  ColumnsOnWall& operator=(const ColumnsOnWall&) = delete;

  /// *Collective* on the ranks that share the work, which give the same thickness.
  const WallColumns& fit(const std::vector<double>& thickness);

 private:
  class Columns;
  std::unique_ptr<Columns> columns_;
};

}  // namespace quadloop
