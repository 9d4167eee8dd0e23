#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/periodic_pair.hpp"

namespace quadloop {

/// A composition of the maps of periodic pairs and their inverses, which commute: 0 is the identity, the sum
/// of two shifts their composition, the negative of a shift its inverse.
using PeriodicShift = std::int32_t;

/// The maps of the periodic pairs of a mesh.
class PeriodicMaps {
 public:
  PeriodicMaps() = default;
  /// Throws InputError if a rotation is combined with another map, or if there are more than three different
  /// translations.
  explicit PeriodicMaps(const std::vector<PeriodicPair>& pairs);

  /// The map from the first to the second boundary of a pair.
  PeriodicShift of_pair(std::size_t pair) const { return of_pairs_[pair]; }
  Point image(PeriodicShift shift, Point p) const;
  /// Angle by which a shift turns vectors, counter-clockwise.
  double degrees(PeriodicShift shift) const;

 private:
  std::vector<PeriodicPair> maps_;  ///< without repetitions and inverses
  std::vector<PeriodicShift> of_pairs_;
};

/// The number of an image of a node. The image under the identity is the node itself, with its own number.
GlobalNodeId image_number(GlobalNodeId node, PeriodicShift shift);
/// The node and the shift of an image.
GlobalNodeId original_of(GlobalNodeId image);
PeriodicShift shift_of(GlobalNodeId image);
/// The number of the same image, shifted further.
inline GlobalNodeId shifted(GlobalNodeId image, PeriodicShift by) {
  return image_number(original_of(image), shift_of(image) + by);
}

}  // namespace quadloop
