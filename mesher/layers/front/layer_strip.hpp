#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/layers/front/adapted_size.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "mesher/layers/front/wake_room.hpp"

namespace quadloop {

/// The two wall columns at the edge where a wake begins, on the left and on the right of the wake.
struct WakeRoot {
  std::int32_t station = 0;  ///< of the WallLine: the left column
  Point left, right;         ///< the columns' ends on the front
  std::vector<Point> base;   ///< of a blunt edge: the wall from the left column to the right one
  double spacing = 0;        ///< requested along the wall there
  BoundaryId base_boundary = {};
};

/// Layers on both sides of a line, as columns of nodes across it; both sides have the same columns. Triangles
/// join the last rows to the strip's front, so that the cells outside need not match.
struct LayerStrip {
  std::string name, place;                 ///< those of the PlacedLine
  double turn_degrees = 0;                 ///< that of the PlacedLine
  std::optional<ShortenedWake> shortened;  ///< that of the PlacedLine
  LayerSpec spec;                          ///< the requested layers on each side
  double asked = 0;                        ///< requested total thickness of one side
  std::optional<WakeRoot> root;            ///< if set, the first column consists of the wall's two columns
  int layers = 0;                          ///< on each side
  int core = 0;                            ///< even number of rows between them behind a blunt edge
  /// Each column has 2 layers + core + 1 points, from right to left.
  std::vector<std::vector<Point>> columns;
  /// Layers on the base of a blunt edge, with their requested heights: lines along the base, from the wall
  /// outwards, each from right to left. The line after the last one is the middle of the first column,
  /// base_layers() rows from its two feet; the ends of each line are nodes of that column. Empty: the first
  /// column lies on the base.
  std::vector<std::vector<Point>> base_lines;
  int base_layers() const { return static_cast<int>(base_lines.size()); }
  std::vector<Point> front;  ///< boundary of the strip: along the left, around the end, back along the right;
                             ///< for a free line also around its beginning, else between the root's columns
  /// Requested cell size outside, for each segment of `front`; for a strip with a root one more, at the
  /// beginning, for the segment before the first point.
  std::vector<double> spacing;
  /// Indices in `front` of the corners at the end (left, right) and at the beginning of a free line (right,
  /// left).
  std::array<std::size_t, 4> corners{};
  /// Set: each column is the mirror image in this axis of that as far from the other end of the line, to the
  /// last bit, and the one in the middle lies on the axis. So is the front.
  std::optional<MirrorAxis> across = {};
};

/// Minimum numbers of columns and cells of a line's strip, computed without building it.
struct StripSize {
  double columns = 0, cells = 0;
};
StripSize least_size(const PlacedLine& line);

/// Builds the strip of a line. Downstream of a wake's root layers thicken: by a factor of 1.15 per column at
/// the line, and by a tenth of the distance in total. Towards free ends cells become as high as wide. Far
/// from ends columns are `spacing` apart, or less where adaptation requests smaller cells beside them; widths
/// grow by a tenth of the distance from there, and no row is higher than its columns are wide. `free`:
/// distance from the line of what it keeps clear of; columns and layers leave room there (WakeRoom). Throws
/// InputError if the path returns to its first point within the thickness of the layers: it has no direction
/// there.
LayerStrip layer_strip(const PlacedLine& line, const std::optional<WakeRoot>& root,
                       const AdaptedSize& adapted = {}, const FreeDistance& free = {});

}  // namespace quadloop
