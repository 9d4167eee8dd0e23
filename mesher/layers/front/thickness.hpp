#pragma once

#include <utility>
#include <vector>

#include "mesher/layers/front/columns_on_wall.hpp"

namespace quadloop {

/// Columns that fit.
struct FittingColumns {
  std::vector<double> thickness;  ///< normal to the wall, at each station
  WallColumns columns;
  std::vector<Point> front;
};

using StationPairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// The thickest layers, at most as thick as requested, whose columns keep a distance from other walls, from
/// their fronts and from each other. Thickness changes by at most 0.35 of the distance along the wall. Throws
/// InputError with coordinates where none fit. The columns at two stations of a list of partners, ends of
/// runs, have the same length. The ranks of `sharing` have the same arguments, divide the work and get the
/// same result; null: this rank is alone. *Collective* on these ranks.
FittingColumns fit_thickness(const WallLine& line, const StationPairs& partners = {},
                             const Communicator* sharing = nullptr);

}  // namespace quadloop
