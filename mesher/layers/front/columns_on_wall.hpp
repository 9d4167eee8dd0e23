#pragma once

#include <memory>
#include <vector>

#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

/// The columns of a wall's stations: straight lines from the wall to the layer front.
struct WallColumns {
  std::vector<Point> direction;  ///< unit vector, away from the wall
  std::vector<double> length;

  Point front(const WallLine& line, std::int32_t i) const { return line[i].wall + length[i] * direction[i]; }
};

/// Columns for layers of these thicknesses (normal to the wall, one per station). A column is normal to the
/// wall where possible. Beside a concave corner columns lean away from it, less with the distance, so that
/// the front is the wall's offset line and columns do not cross. Where columns would come too close to each
/// other or spread too far, their directions are averaged along the wall; a column always keeps an angle to
/// the wall on both sides of its station. Thickness must change by at most 0.35 of the distance along the
/// wall.
WallColumns columns_on_wall(const WallLine& line, const std::vector<double>& thickness);

/// Columns for a sequence of thicknesses. Each call recomputes only the places that changed and those whose
/// columns depend on them; the columns are bitwise those of columns_on_wall().
class ColumnsOnWall {
 public:
  /// `line` must outlive it.
  explicit ColumnsOnWall(const WallLine& line);
  ~ColumnsOnWall();
  ColumnsOnWall(const ColumnsOnWall&) = delete;
  ColumnsOnWall& operator=(const ColumnsOnWall&) = delete;

  const WallColumns& fit(const std::vector<double>& thickness);

 private:
  class Columns;
  std::unique_ptr<Columns> columns_;
};

}  // namespace quadloop
