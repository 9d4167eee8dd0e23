#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/mirror_axis.hpp"

namespace quadloop {

/// A line within the domain with layers on both sides, as a case asks for it: a wake, which goes on from the
/// sharp edge of a wall and takes over its layers, or a free line with layers of its own.
struct LayerLine {
  /// Of a wake: the boundary with the edge, or those that meet there; empty for a free line.
  std::vector<std::string> from;
  std::vector<Point> path;          ///< of a wake: where it leads after the edge, or none for straight on
  double length = 0;                ///< of a wake without a path
  double spacing = 0;               ///< length wanted of the cells along it; above 0
  std::optional<LayerSpec> layers;  ///< of a free line
  std::string where = {};           ///< its place in the case file, "case.toml:12", for messages alone
  std::optional<Point> at = {};     ///< of a wake: near the edge that it begins at, of several
  /// Of a free line whose path, read backwards, is its own mirror image in an axis: its layers are, too.
  std::optional<MirrorAxis> across = {};

  friend bool operator==(const LayerLine& a, const LayerLine& b) {
    const auto made_of = [](const LayerLine& l) {
      return std::tie(l.from, l.at, l.path, l.length, l.spacing, l.layers);
    };
    return made_of(a) == made_of(b);
  }
};

/// Where it lies.
struct PlacedLine {
  static constexpr std::int32_t nowhere = -1;

  /// The vertex that a wake begins at; of a blunt edge the first one, and the last, with the base between
  /// them.
  std::int32_t edge = nowhere, base_end = nowhere;
  std::vector<Point> path;  ///< two points at least, the first one the edge or the middle of the base
  double spacing = 0;
  LayerSpec layers;
  std::string name = {};   ///< "wake" or "layer_line"; of several "wake_1", "wake_2" ...
  std::string place = {};  ///< what a message about it begins with: "case.toml:12: ", or nothing
  std::optional<MirrorAxis> across = {};  ///< as the line's
};

/// Finds the edges at which wakes begin. An edge is a vertex of its boundaries at which the wall turns away
/// from the domain by more than 120 degrees; or a base, of one boundary, between two corners of more than 50
/// degrees and shorter than a twentieth of the boundaries' box, which together turn by more than 120. A wake
/// begins at the only edge, or at that nearest to its `at`, which must lie within a twentieth of that box.
/// A wake without a path goes straight on, half way between the walls that meet there. Throws InputError for
/// a boundary that is none or has no layers, for no such edge or several, and for two wakes from one.
std::vector<PlacedLine> place_lines(const Geometry& geometry, const std::vector<LayerLine>& lines);

}  // namespace quadloop
