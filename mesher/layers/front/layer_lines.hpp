#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/mirror_axis.hpp"

namespace quadloop {

/// A line within the domain with layers on both sides, as specified in a case: a wake, which begins at the
/// trailing edge of a wall and continues its layers, or a free line with layers of its own. A wake without
/// layers requests only cell sizes along its line.
struct LayerLine {
  /// For a wake: the boundary with the edge, or the boundaries that meet there; empty for a free line.
  std::vector<std::string> from;
  std::vector<Point> path;          ///< of a wake: its course after the edge; empty: straight, or the flow's
  double length = 0;                ///< of a wake without a path
  double spacing = 0;               ///< requested cell length along the line, positive
  std::optional<LayerSpec> layers;  ///< of a free line
  std::string where = {};           ///< its place in the case file, "case.toml:12", for messages alone
  std::optional<Point> at = {};     ///< of a wake: near the edge that it begins at, of several
  /// Of a free line whose path, read backwards, is its own mirror image in an axis: its layers are, too.
  std::optional<MirrorAxis> across = {};
  bool follows_flow = false;    ///< of a wake with a length: along a streamline, if one is known
  bool without_layers = false;  ///< of a wake: `spacing` is the size of the cells that meet it
  /// Of a wake without layers: the size of cells at the end of its length, at least `spacing`. Between, it
  /// varies linearly.
  double spacing_at_end = 0;

  friend bool operator==(const LayerLine& a, const LayerLine& b) {
    const auto made_of = [](const LayerLine& l) {
      return std::tie(l.from, l.at, l.path, l.length, l.spacing, l.layers, l.follows_flow, l.without_layers,
                      l.spacing_at_end);
    };
    return made_of(a) == made_of(b);
  }
};

/// A wake that ends before its requested length, as it comes near something else.
struct ShortenedWake {
  double requested = 0, left = 0;  ///< lengths
  std::string before;              ///< "boundary flap" or "wake_2"
  Point at;                        ///< the end of the wake

  friend bool operator==(const ShortenedWake&, const ShortenedWake&) = default;
};

/// The location of a layer line.
struct PlacedLine {
  static constexpr std::int32_t nowhere = -1;

  /// First and last vertex of the edge at which a wake begins: equal for a sharp edge, the ends of the base
  /// for a blunt edge.
  std::int32_t edge = nowhere, base_end = nowhere;
  std::vector<Point> path;  ///< at least two points; the first is the edge or the middle of the base
  double spacing = 0;
  LayerSpec layers;
  std::string name = {};   ///< "wake" or "layer_line"; of several "wake_1", "wake_2" ...
  std::string place = {};  ///< what a message about it begins with: "case.toml:12: ", or nothing
  std::optional<MirrorAxis> across = {};  ///< as the line's
  double turn_degrees = 0;  ///< of a wake: between the bisector of the walls at the edge and the path
  /// Of a wake that follows the flow: the boundaries at which it begins. Its layers keep clear of all others.
  std::vector<BoundaryId> clear_of_all_but = {};
  std::optional<ShortenedWake> shortened = {};
  bool is_guess = false;  ///< of a wake that follows the flow: straight, as no streamline is known
};

/// Finds the edges at which wakes begin. An edge is a vertex where the wall turns away from the domain by
/// more than 120 degrees, or a base: a part of one boundary, shorter than a twentieth of the boundaries'
/// bounding box, between two corners of more than 50 degrees each that turn by more than 120 degrees
/// together. A wake begins at the only edge, or at the edge nearest to its `at`, which must be within a
/// twentieth of the box from it. A wake without a path is straight and bisects the walls at the edge; one
/// that follows the flow has the course of the streamline, if any, whose first point is the nearest to the
/// edge, at most the requested spacing away: moved to the edge, and cut off at the requested length. Throws
/// InputError for an unknown boundary, for one without layers unless the wake has none, for no or several
/// matching edges (also for half an edge on a symmetry boundary), and for two wakes at one edge.
std::vector<PlacedLine> place_lines(const Geometry& geometry, const std::vector<LayerLine>& lines,
                                    const std::vector<std::vector<Point>>& streamlines = {});

/// The first part of a polyline, of this length; the whole polyline if it is not longer.
std::vector<Point> beginning_of(const std::vector<Point>& path, double length);
double length_of(const std::vector<Point>& path);

}  // namespace quadloop
