#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/mesh/mesh.hpp"

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

/// Reports the layers that add_layers() puts between the wall and the front's nodes; `outer` is the mesh
/// outside them. The same on any number of ranks. *Collective.*
LayerReport report_layers(const Communicator& comm, const LayerFront& front, const Mesh& outer);

/// Reports one strip as built.
BoundaryLayerReport report_strip(const LayerStrip& strip);

/// Warnings about boundaries whose layers are somewhere thinner than half the requested thickness, with the
/// place: the thinnest first, at most five, and a line that counts the others.
std::vector<std::string> warnings_of(const LayerReport& report);

/// Warnings where `min`, the smallest allowed leaf size, exceeds the size that layers need: beside the last
/// layers of walls that have at least half their requested thickness (the five boundaries with the largest
/// difference), beside strips, and on bases of blunt edges that are too narrow for layers of their own; and
/// of wakes that turn by more than 15 degrees at their edge. Each with its place.
std::vector<std::string> size_warnings(const LayerFront& front, double min);

}  // namespace quadloop
