#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "mesher/base/counted.hpp"
#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/facets.hpp"
#include "mesher/grid/tree_grid.hpp"
#include "mesher/sizes/proximity.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

namespace {

/// Warns of a requested size that `min` limits, if it does. `what`: "boundary 'a' requests a spacing".
void warn_if_limited(const std::string& what, double wanted, Point at, double min, Warnings& warnings) {
  if (wanted >= min) return;
  warnings.push_back(fmt::format(
      "{} of {:.6g} at ({:.6g}, {:.6g}), but spacing.min = {} is larger; set a smaller spacing.min", what,
      wanted, at.x, at.y, min));
}

/// Warns of sizes of boundaries and of their corners that cannot be reached, and of a boundary without a
/// sharp corner. The place is the first one.
void warn_of_boundaries(const Geometry& geometry, double min, Warnings& warnings) {
  IdVector<BoundaryId, std::int32_t> first(geometry.boundaries().size(), -1), corner = first;
  const auto set_first = [](std::int32_t& place, std::int32_t v) { place = place < 0 ? v : place; };
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    set_first(first[geometry.boundary_of(v)], v);
    if (geometry.corner_spacing_of(v) == 0) continue;
    for (const std::int32_t segment : {geometry.previous(v), v})
      set_first(corner[geometry.boundary_of(segment)], v);
  }
  for (const BoundaryId b : first.ids()) {
    const Boundary& boundary = geometry.boundary(b);
    const std::string requests = fmt::format("boundary '{}' requests a ", boundary.name);
    if (boundary.spacing > 0 && first[b] >= 0)
      warn_if_limited(requests + "spacing", boundary.spacing, geometry.point(first[b]), min, warnings);
    if (boundary.corner_spacing == 0) continue;
    if (corner[b] >= 0) {
      warn_if_limited(requests + "corner_spacing", boundary.corner_spacing, geometry.point(corner[b]), min,
                      warnings);
    } else {
      warnings.push_back(
          fmt::format("boundary '{}' has corner_spacing = {}, but no corner: it turns nowhere by more than "
                      "corner = {} degrees",
                      boundary.name, boundary.corner_spacing, boundary.corner_degrees));
    }
  }
}

/// Warns of narrow parts of the domain with fewer quadtree cells across than requested.
void warn_of_gaps(const MeshOptions& options, const Geometry& geometry, double finest, Warnings& warnings) {
  if (!options.size.gap) return;
  const auto narrow = Proximity(geometry).narrow_parts(*options.size.gap * finest);
  if (narrow.segments == 0) return;
  warnings.push_back(fmt::format(
      "spacing.gap requests {} cells across gaps, but gaps at {} of the geometry, the first at ({:.6g}, "
      "{:.6g}), are narrower than {} cells of {:.6g}; spacing.min = {} permits no smaller cells",
      *options.size.gap, counted(narrow.segments, "segment"), narrow.first.x, narrow.first.y,
      *options.size.gap, finest, options.size.min));
}

/// The points of one boundary where it turns by more than `curvature` within a smallest cell.
struct SharpTurns {
  std::int64_t points = 0;
  double wanted = std::numeric_limits<double>::infinity();  ///< smallest size that `curvature` requests
  Point at;                                                 ///< where
};

/// Each point turns along half of the segments beside it; consecutive ones within `finest` turn together.
IdVector<BoundaryId, SharpTurns> sharp_turns(const Geometry& geometry, double curvature, double finest) {
  IdVector<BoundaryId, SharpTurns> sharp(geometry.boundaries().size(), {});
  double turn = 0, reach = 0;
  const auto change = [&](std::int32_t v, double sign) {
    turn += sign * geometry.bend_degrees(v);
    reach += sign * 0.5 *
             (length(geometry.point(v) - geometry.point(geometry.previous(v))) +
              length(geometry.point(geometry.next(v)) - geometry.point(v)));
  };
  std::int32_t first = 0;
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    if (geometry.kept(v) || geometry.previous(v) != v - 1) {
      first = v;
      turn = reach = 0;
    }
    change(v, 1);
    while (reach > finest && first < v) change(first++, -1);
    if (reach > finest || turn <= curvature) continue;
    SharpTurns& of_boundary = sharp[geometry.boundary_of(v)];
    ++of_boundary.points;
    if (const double wanted = curvature / turn * reach; wanted < of_boundary.wanted)
      of_boundary = {of_boundary.points, wanted, geometry.point((first + v) / 2)};
  }
  return sharp;
}

void warn_of_curvature(const MeshOptions& options, const Geometry& geometry, double finest,
                       Warnings& warnings) {
  if (!options.size.curvature) return;
  const auto sharp = sharp_turns(geometry, *options.size.curvature, finest);
  for (const BoundaryId b : sharp.ids()) {
    const auto& [points, wanted, at] = sharp[b];
    if (points == 0) continue;
    const std::string requests =
        fmt::format("spacing.curvature = {} requests smaller cells at {} of boundary '{}', the smallest",
                    *options.size.curvature, counted(points, "point"), geometry.boundary(b).name);
    warn_if_limited(requests, wanted, at, options.size.min, warnings);
  }
}

/// The points of one boundary at which the flow resolves the facets of the polygon.
struct Facets {
  std::int64_t points = 0;
  double largest_turn = 0,
         shortest = 0;  ///< turn in degrees; length of the shortest segment at these points
  Point first;
};

/// Finds the points of a polygonal approximation of a curve whose cells are shorter than half of the adjacent
/// segments: the flow turns at single nodes, and its pressure jumps.
IdVector<BoundaryId, Facets> facets_in_small_cells(const MeshOptions& options, const Geometry& geometry) {
  IdVector<BoundaryId, Facets> facets(geometry.boundaries().size(), {});
  for (const auto& [v, turn, segment] : facets_of(geometry)) {
    const bool refined_to_min = options.size.curvature && turn > *options.size.curvature;
    const double wanted = refined_to_min ? options.size.min : geometry.spacing_of(v);
    if (wanted >= segment / 2) continue;
    Facets& of_boundary = facets[geometry.boundary_of(v)];
    if (of_boundary.points++ == 0) of_boundary = {1, 0, segment, geometry.point(v)};
    of_boundary.largest_turn = std::max(of_boundary.largest_turn, turn);
    of_boundary.shortest = std::min(of_boundary.shortest, segment);
  }
  return facets;
}

void warn_of_facets(const MeshOptions& options, const Geometry& geometry, Warnings& warnings) {
  const auto facets = facets_in_small_cells(options, geometry);
  for (const BoundaryId b : facets.ids()) {
    const auto& [points, turn, shortest, first] = facets[b];
    if (points < 2) continue;  // no side lies between two of them
    warnings.push_back(fmt::format(
        "boundary '{}' turns by up to {:.3g} degrees at {} points that are not corners, the first "
        "at ({:.6g}, {:.6g}). Cells smaller than {:.3g} resolve the straight facets between its points, and "
        "the "
        "pressure of a flow has a peak at each point; give the outline more points, or join them by splines "
        "(geometry.spline = true)",
        geometry.boundary(b).name, turn, points, first.x, first.y, shortest));
  }
}

Point centre_of(const SizeSource& source) {
  if (const auto* const disc = std::get_if<SizeSource::Disc>(&source.shape)) return disc->centre;
  if (const auto* const line = std::get_if<SizeSource::Line>(&source.shape))
    return 0.5 * (line->from + line->to);
  return box_of(source).centre();
}

void warn_of_sources(const MeshOptions& options, const Box& root, Warnings& warnings) {
  for (const SizeSource& source : options.size.sources) {
    const bool is_block = std::holds_alternative<SizeSource::Block>(source.shape);
    warn_if_limited(
        source.where + ": this " + (is_block ? "[[block]]" : "[[source]]") + " requests a spacing",
        source.spacing, centre_of(source), options.size.min, warnings);
    if (meets(source, root)) continue;
    warnings.push_back(
        fmt::format("{}: this [[source]] lies outside the root, which reaches from ({}, {}) to ({}, {}), "
                    "and does nothing; move it",
                    source.where, root.low.x, root.low.y, root.high.x, root.high.y));
  }
}

/// Returns the largest size that the case requests for all cells or for a boundary, and its source.
std::pair<double, std::string> largest_request(const MeshOptions& options, const Geometry& geometry) {
  std::pair<double, std::string> largest = {options.size.max, "spacing.max"};
  for (const Boundary& boundary : geometry.boundaries()) {
    if (boundary.spacing > largest.first)
      largest = {boundary.spacing, fmt::format("the spacing of boundary '{}'", boundary.name)};
  }
  return largest;
}

}  // namespace

std::optional<std::string> unit_warning(const std::vector<FileExtent>& files, const MeshOptions& options,
                                        const Geometry& geometry) {
  const bool is_converted =
      std::ranges::any_of(files, [](const FileExtent& file) { return file.metres != 0 && file.metres != 1; });
  const Point size = geometry.box().high - geometry.box().low;
  const double longest = std::max(size.x, size.y);
  const auto [largest, source] = largest_request(options, geometry);
  if (!is_converted || largest <= longest) return std::nullopt;
  return fmt::format(
      "{} = {} is larger than the whole domain, whose longer side is {:.6g}: geometry.unit converts the "
      "coordinates to metres; give all lengths of the case in metres",
      source, largest, longest);
}

Warnings spacing_warnings(const MeshOptions& options, const Geometry& geometry) {
  Warnings warnings;
  const TreeGrid grid = choose_root(geometry, options.size);
  const int finest_level = grid.finest_level(options.size.min);
  const double min = options.size.min, finest = grid.edge(finest_level);
  if (grid.is_larger(finest_level, options.size.max)) {
    warnings.push_back(fmt::format(
        "the cells are {} wide, larger than spacing.max = {}: sizes are the root's edge divided by "
        "powers of two, and spacing.min = {} forbids the next one; set spacing.min to {} or less",
        finest, options.size.max, min, finest / 2));
  }
  warn_of_boundaries(geometry, min, warnings);
  warn_of_curvature(options, geometry, finest, warnings);
  warn_of_gaps(options, geometry, finest, warnings);
  warn_of_facets(options, geometry, warnings);
  warn_of_sources(options, grid.box(), warnings);
  return warnings;
}

}  // namespace quadloop
