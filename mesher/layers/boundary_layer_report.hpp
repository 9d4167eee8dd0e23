#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The layers of one boundary or strip; they may continue along adjacent boundaries. Heights are normal to
/// the wall, in the geometry's unit of length.
struct BoundaryLayerReport {
  std::string boundary;        ///< or the strip's name
  int asked = 0, reached = 0;  ///< number of layers requested, and in the column with the fewest
  std::int64_t columns = 0;    ///< nodes of the front
  double y_plus = 0;           ///< target of the first layer; 0: none
  /// Range of requested first heights: from `first_asked` to `first_asked_most` if they follow a flow.
  double first_asked = 0, first_asked_most = 0, first_least = 0, first_median = 0;
  /// Growth ratios of the layers above those of equal height; requested: that of the first one.
  double growth_asked = 0, growth_least = 0;
  /// Requested thickness; if it follows a flow, the smallest, the largest, and that at `least`.
  double thickness_asked = 0, thickness_asked_most = 0, asked_at_least = 0;
  bool follows_flow = false;  ///< whether the thickness follows a flow
  double share_least = 1;     ///< smallest fraction of the requested thickness
  double share_full = 1;      ///< fraction of the wall's length with the requested thickness, within 1.5 %
  Point least;  ///< place on the wall with the smallest thickness fraction, or else the smallest growth
  double growth_at_least = 0;  ///< growth ratio there; behind a wake's root ratios fall to 1 by design
};

/// One entry for each boundary with layers, in the order of the geometry, then one for each strip: columns of
/// both sides, heights along them, and fractions of columns instead of lengths.
using LayerReport = std::vector<BoundaryLayerReport>;

}  // namespace quadloop
