#pragma once

// For validate(), require_sound() and is_surely_valid() only: the individual rules. All but the first require
// a mesh that satisfies the first.

#include <vector>

#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

using Faults = std::vector<MeshFault>;

inline constexpr double area_tolerance = 1e-10;  ///< relative: rounding of a sum over many cells

void check_indices(const Mesh& mesh, Faults& faults);
void check_coincident(const Mesh& mesh, Faults& faults);
void check_positive(const Mesh& mesh, Faults& faults);
void check_conforming(const Mesh& mesh, const CellBlocks& blocks, const MeshTopology& topology,
                      Faults& faults);
void check_closed(const Mesh& mesh, const MeshTopology& topology, Faults& faults);
void check_area(const Mesh& mesh, const MeshTopology& topology, Faults& faults);
void check_overlap(const Mesh& mesh, const MeshTopology& topology, Faults& faults);

/// A boundary edge, with the domain to its left.
struct BoundarySegment {
  Point from, to;
};

/// Above this number of separate parts of a mesh windings are not counted; the other rules must suffice.
inline constexpr std::size_t most_components = 2000;

/// Adds an error for each two segments that meet other than at a common end or as the two sides of a crack.
void check_boundary_crossings(const std::vector<BoundarySegment>& segments, Faults& faults);

/// Returns the winding number of the segments around p, exactly: signed crossings of the ray to its right.
std::int32_t winding(const std::vector<BoundarySegment>& segments, Point p);

}  // namespace quadloop
