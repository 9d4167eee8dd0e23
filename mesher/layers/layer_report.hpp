#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What became of the layers of one boundary or strip; they may go on along a boundary's neighbours. Heights
/// are normal to the wall, in the geometry's unit of length.
struct BoundaryLayerReport {
  std::string boundary;        ///< or the strip's name
  int asked = 0, reached = 0;  ///< layers; those of the column that has least
  std::int64_t columns = 0;    ///< nodes of the front
  double y_plus = 0;           ///< asked of the first layer; 0: none
  /// Where first heights follow a flow they are asked for from `first_asked` to `first_asked_most`.
  double first_asked = 0, first_asked_most = 0, first_least = 0, first_median = 0;
  double growth_asked = 0, growth_least = 0;  ///< of the layers above the equal ones; asked: the first one's
  double thickness_asked = 0;
  double share_least = 1;  ///< of the thickness asked for
  double share_full = 1;   ///< of the wall's length, with the thickness asked for, to 1.5 %
  Point least;             ///< where on the wall the share, or else the growth, is least
};

/// One entry for each boundary that asks for layers and has any, in the order of the geometry, then one for
/// each strip: its columns on both sides, heights along them, shares of columns in the place of lengths.
using LayerReport = std::vector<BoundaryLayerReport>;

/// Of the layers that add_layers() puts between the wall and the front's nodes; `outer` is the mesh outside
/// of them. The same on any number of ranks. *Collective.*
LayerReport report_layers(const Communicator& comm, const LayerFront& front, const Mesh& outer);

/// Of one strip alone, as it is given.
BoundaryLayerReport report_strip(const LayerStrip& strip);

/// A line for each boundary whose layers are somewhere less than half as thick as was asked, with the place:
/// the thinnest first, five at most, and one that counts the others.
std::vector<std::string> warnings_of(const LayerReport& report);

/// What `min`, the smallest leaves allowed, keeps from being as small as layers want: leaves beside the last
/// layers of walls, where these are half as thick as was asked or more, of which the five boundaries farthest
/// from it are named, and beside strips; and bases of blunt edges that are too narrow for layers of their
/// own. Each with its place.
std::vector<std::string> size_warnings(const LayerFront& front, double min);

}  // namespace quadloop
