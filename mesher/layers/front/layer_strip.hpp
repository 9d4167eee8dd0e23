#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/layers/front/layer_lines.hpp"

namespace quadloop {

/// The two columns at the edge from which a wake goes on, with the domain to the left of the wake and to its
/// right.
struct WakeRoot {
  std::int32_t station = 0;  ///< of the WallLine: the column on the left
  Point left, right;         ///< their ends on the front
  std::vector<Point> base;   ///< of a blunt edge: the wall from the left column to the right one
  double spacing = 0;        ///< wanted along the wall there
  BoundaryId base_boundary = {};
};

/// Layers on both sides of a line, as columns across it whose nodes are given: so both sides have the same
/// ones. Between its last rows and its front lie triangles, and the cells outside need not match.
struct LayerStrip {
  std::string name, place;       ///< those of the PlacedLine
  LayerSpec spec;                ///< the layers on either side as they are asked for
  double asked = 0;              ///< and how thick they are together
  std::optional<WakeRoot> root;  ///< its first column is the wall's two
  int layers = 0;                ///< on either side
  int core = 0;                  ///< rows between them, behind a blunt edge; even
  /// 2 layers + core + 1 points each, from right to left.
  std::vector<std::vector<Point>> columns;
  /// Layers on a blunt edge's base, of the heights asked for: lines along it, from the wall on and each from
  /// right to left. The next one is the middle of the first column, base_layers() rows from its two feet;
  /// the ends of each are that column's nodes on the way there. Empty: the first column lies on the base.
  std::vector<std::vector<Point>> base_lines;
  int base_layers() const { return static_cast<int>(base_lines.size()); }
  std::vector<Point> front;     ///< outside of it: along the left, round the end, back along the right; of a
                                ///< free line round its beginning too, else from and to the root's columns
  std::vector<double> spacing;  ///< wanted of cells outside, on the way to the next point of the front; one
                                ///< more in front of a root's strip: before the first point
  /// Of `front`: the corners at the end, left and right, and at the beginning of a free line, right and left.
  std::array<std::size_t, 4> corners{};
  /// Set: each column is the mirror image in this axis of that as far from the other end of the line, to the
  /// last bit, and the one in the middle lies on the axis. So is the front.
  std::optional<MirrorAxis> across = {};
};

/// How many cells a line's strip has at least, and how many columns: known without building it.
struct StripSize {
  double columns = 0, cells = 0;
};
StripSize least_size(const PlacedLine& line);

/// Layers open downstream of a wake's root, by 1.15 from column to column at the line itself and by a tenth
/// of the distance in all, and towards free ends, where they are as high as they are wide; columns are
/// `spacing` apart where they are far from ends.
LayerStrip layer_strip(const PlacedLine& line, const std::optional<WakeRoot>& root);

}  // namespace quadloop
