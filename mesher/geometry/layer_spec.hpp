#pragma once

#include <span>
#include <vector>

namespace quadloop {

/// The boundary-layer cells requested for a boundary. Heights are normal to it, in the geometry's unit of
/// length.
struct LayerSpec {
  double first = 0;        ///< height of the first layer, positive
  double growth = 1.2;     ///< growth ratio of consecutive layers, at least 1
  double growth_to = 1.2;  ///< final growth ratio: it rises by 5 % per layer after the first five; at least
                           ///< `growth`
  int count = 0;           ///< number of layers, positive
  int equal = 1;           ///< number of layers with the first height
  double y_plus = 0;       ///< if positive, the target y+ of the first layer, of which `first` is an estimate
  /// Whether the total thickness follows the boundary layer of a solution; the other members are its first
  /// estimate.
  bool follows_flow = false;

  friend bool operator==(const LayerSpec&, const LayerSpec&) = default;
};

/// The requested heights of the layers, from the wall outwards.
std::vector<double> layer_heights(const LayerSpec& spec);

/// The total thickness of the layers.
double layers_thickness(const LayerSpec& spec);

/// The number of layers that reach the thickness, the last one possibly exceeding it; at most `most`.
int layers_within(const LayerSpec& spec, double thickness, int most);

/// The largest thickness, at most the requested one, with which the last layer is at most `last` high: the
/// excess of each growth ratio over 1 is scaled by one factor, found by bisection. At least that of equal
/// layers of the first height.
double thickness_with_last(const LayerSpec& spec, double last);

/// Layers with another first height but the same count and total thickness: the excess of each growth ratio
/// over 1 is scaled by one factor, found by bisection. The factor is limited to 1.5; then the layers are
/// thinner. A first height that leaves no space for the others becomes an equal share of the thickness.
LayerSpec with_first_height(const LayerSpec& spec, double first);

/// Layers with another first height and total thickness but the same count: the excess of each growth ratio
/// over 1 is scaled by one factor, found by bisection. The factor is at least 0.7, and the largest growth
/// ratio at most 1.3, or that of `spec` if it is larger; then the layers are thicker or thinner. The first
/// height is kept.
LayerSpec with_thickness(const LayerSpec& spec, double first, double thickness);

/// One column of layers.
struct ColumnHeights {
  std::vector<double> reached;  ///< distance from the wall to each node, the first one 0
  /// Height of the first layer; smallest growth ratio of the layers above those of equal height.
  double first = 0, growth = 0;
};

/// A column of spec.count layers with total height `length` and first height `first`: the excess of each
/// growth ratio over 1 is scaled by one factor in 0 to 1, found by Newton's method. If `length` is less than
/// this many equal layers, or more than the requested layers, the first height is adapted instead. No C
/// library functions are used, so that the bits are the same on all systems.
ColumnHeights column_heights(const LayerSpec& spec, double first, double length);

}  // namespace quadloop
