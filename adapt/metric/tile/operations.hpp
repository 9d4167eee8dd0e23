#pragma once

#include "adapt/metric/tile/tile_mesh.hpp"

namespace quadloop::adapt {

/// Each operation changes a tile's mesh if this is valid and improves its conformity to the metric; otherwise
/// it does nothing. Triangles remain positive by exact tests. Returns whether the mesh was changed.

/// Divides an edge at its midpoint, a boundary edge at the midpoint of its part of the geometry.
bool split_edge(TileMesh& mesh, std::int32_t a, std::int32_t b);

/// Collapses an edge to one of its ends, if no edge becomes longer than `longest` in the metric and no
/// triangle becomes too bad.
bool collapse_edge(TileMesh& mesh, std::int32_t a, std::int32_t b, double longest);

/// Flips an edge if the worse of the two triangles improves.
bool flip_edge(TileMesh& mesh, std::int32_t a, std::int32_t b);

/// Moves a node to equalise its edge lengths in the metric; a boundary node slides along the geometry. The
/// worst triangle around it does not get worse.
bool relax_node(TileMesh& mesh, std::int32_t n);

}  // namespace quadloop::adapt
