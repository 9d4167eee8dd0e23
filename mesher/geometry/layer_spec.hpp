#pragma once

#include <span>
#include <vector>

namespace quadloop {

/// The thin layers of cells that a boundary asks for. Heights are normal to it, in the geometry's unit of
/// length.
struct LayerSpec {
  double first = 0;     ///< height of the layer at the boundary; above 0
  double growth = 1.2;  ///< of each layer over the one below it; at least 1
  double growth_to =
      1.2;        ///< what it rises to, by a twentieth a layer after the first five; at least `growth`
  int count = 0;  ///< of layers; above 0
  int equal = 1;  ///< so many layers have the first height
  double y_plus =
      0;  ///< above 0: what the first height is to be in wall units, of which `first` is an estimate

  friend bool operator==(const LayerSpec&, const LayerSpec&) = default;
};

/// The heights of the layers as they are asked for, from the boundary outwards.
std::vector<double> layer_heights(const LayerSpec& spec);

/// The thickness of all layers together.
double layers_thickness(const LayerSpec& spec);

/// The number of layers that reach the thickness, the last one perhaps beyond it; at most `most`.
int layers_within(const LayerSpec& spec, double thickness, int most);

/// Layers of another first height, as many and as thick together: the excess of each growth over 1 is scaled
/// by one number, found by bisection. By 1.5 at most; where that is too little they are thinner. A first
/// height that leaves no room for the others becomes an equal share of the thickness.
LayerSpec with_first_height(const LayerSpec& spec, double first);

/// One column of layers.
struct ColumnHeights {
  std::vector<double> reached;  ///< distance from the wall to each node, the first one 0
  double first = 0,
         growth = 0;  ///< of the layer at the wall, and the least of the layers above the equal ones
};

/// A column of spec.count layers that is `length` long and begins with a layer of height `first`: the excess
/// of each growth over 1 is scaled by one number in 0 to 1, found by bisection. Where `length` is less than
/// so many equal layers, or more than the layers asked for, the first height gives way instead. No function
/// of the C library is used, so that the bits are the same everywhere.
ColumnHeights column_heights(const LayerSpec& spec, double first, double length);

}  // namespace quadloop
