#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/facets.hpp"
#include "mesher/lattice/lattice.hpp"
#include "mesher/sizes/proximity.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

namespace {

/// Warns of a corner spacing that cannot be reached, or of a boundary without a sharp corner.
Warnings corner_warnings(const Geometry& geometry, double min) {
  IdVector<BoundaryId, char> has_corner(geometry.boundaries().size(), 0);
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    if (geometry.corner_spacing_of(v) == 0) continue;
    for (const std::int32_t segment : {geometry.previous(v), v})
      has_corner[geometry.boundary_of(segment)] = 1;
  }
  Warnings warnings;
  for (const BoundaryId b : has_corner.ids()) {
    const Boundary& boundary = geometry.boundary(b);
    if (boundary.corner_spacing > 0 && has_corner[b] == 0) {
      warnings.push_back(
          fmt::format("boundary '{}' has no corner for its corner_spacing = {}: it turns by more than its "
                      "corner = {} degrees nowhere",
                      boundary.name, boundary.corner_spacing, boundary.corner_degrees));
    } else if (boundary.corner_spacing > 0 && boundary.corner_spacing < min) {
      warnings.push_back(fmt::format(
          "boundary '{}' asks for a corner_spacing of {}, but spacing.min = {} ends the refinement before",
          boundary.name, boundary.corner_spacing, min));
    }
  }
  return warnings;
}

/// Warns of narrow parts of the domain with fewer quadtree cells across than requested.
Warnings gap_warnings(const MeshOptions& options, const Geometry& geometry, const Lattice& lattice) {
  if (!options.size.gap) return {};
  const double finest = lattice.edge(lattice.finest_level(options.size.min));
  const auto narrow = Proximity(geometry).narrow_parts(*options.size.gap * finest);
  if (narrow.segments == 0) return {};
  return {
      fmt::format("spacing.gap asks for {} leaves across parts of the domain that are narrower than {} "
                  "leaves of {}, at {} segments "
                  "of the outline, the first at ({}, {}); spacing.min = {} ends the refinement before",
                  *options.size.gap, *options.size.gap, finest, narrow.segments, narrow.first.x,
                  narrow.first.y, options.size.min)};
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

Warnings facet_warnings(const MeshOptions& options, const Geometry& geometry) {
  Warnings warnings;
  const auto facets = facets_in_small_cells(options, geometry);
  for (const BoundaryId b : facets.ids()) {
    const auto& [points, turn, shortest, first] = facets[b];
    if (points == 0) continue;
    warnings.push_back(fmt::format(
        "boundary '{}' turns by up to {:.3g} degrees at {} points that are no corners, the first "
        "at ({}, {}). Cells smaller than {:.3g} resolve the straight facets between its points, and the "
        "pressure of a flow has a peak at each point; give the outline more points",
        geometry.boundary(b).name, turn, points, first.x, first.y, shortest));
  }
  return warnings;
}

}  // namespace

Warnings spacing_warnings(const MeshOptions& options, const Geometry& geometry) {
  Warnings warnings;
  const double min = options.size.min;
  const Lattice lattice = choose_root(geometry, options.size.root);
  const Box root = lattice.box();
  if (const double finest = lattice.edge(lattice.finest_level(min)); finest > options.size.max) {
    warnings.push_back(
        fmt::format("leaves stay at {}, above spacing.max = {}: sizes halve from the root's, and spacing.min "
                    "= {} forbids the next one; "
                    "make spacing.min {} or less",
                    finest, options.size.max, min, finest / 2));
  }
  for (const Boundary& b : geometry.boundaries()) {
    if (b.spacing > 0 && b.spacing < min) {
      warnings.push_back(fmt::format(
          "boundary '{}' asks for a spacing of {}, but spacing.min = {} ends the refinement before", b.name,
          b.spacing, min));
    }
  }
  for (std::string& warning : gap_warnings(options, geometry, lattice))
    warnings.push_back(std::move(warning));
  for (std::string& warning : corner_warnings(geometry, min)) warnings.push_back(std::move(warning));
  for (std::string& warning : facet_warnings(options, geometry)) warnings.push_back(std::move(warning));
  for (const SizeSource& source : options.size.sources) {
    if (source.spacing < min) {
      warnings.push_back(fmt::format(
          "{}: this [[source]] asks for a spacing of {}, but spacing.min = {} ends the refinement before",
          source.where, source.spacing, min));
    }
    if (!meets(source, root)) {
      warnings.push_back(
          fmt::format("{}: this [[source]] lies outside the root, which reaches from ({}, {}) to ({}, {}), "
                      "and does nothing; move it",
                      source.where, root.low.x, root.low.y, root.high.x, root.high.y));
    }
  }
  return warnings;
}

}  // namespace quadloop
