#pragma once

#include "adapt/metric/tile/tile_mesh.hpp"

namespace quadloop {

/// Each changes a tile's mesh where that is sound and leads nearer to the metric, or leaves it. Triangles
/// stay positive, exactly. Returns whether it has changed it.

/// Divides an edge in its middle, one of a boundary at the middle of its way along the outline.
bool split_edge(TileMesh& mesh, std::int32_t a, std::int32_t b);

/// Joins the ends of an edge at one of them, where no edge becomes longer than `longest` in the metric and no
/// triangle worse than it may be.
bool collapse_edge(TileMesh& mesh, std::int32_t a, std::int32_t b, double longest);

/// Turns an edge into the other diagonal of its two triangles, where the worse of both becomes better.
bool flip_edge(TileMesh& mesh, std::int32_t a, std::int32_t b);

/// Moves a node to where its edges have equal lengths, one that slides along the outline. The worst triangle
/// round it does not become worse.
bool relax_node(TileMesh& mesh, std::int32_t n);

}  // namespace quadloop
