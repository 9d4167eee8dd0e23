#pragma once

#include "mesher/mesh/mesh.hpp"

namespace quadloop::test {

/// A unit square, and right of it a triangle of the same height, 8 long.
inline Mesh square_and_triangle() {
  const auto node = [](std::int32_t number) { return NodeId{number}; };
  Mesh mesh;
  for (const Point p : {Point{0, 0}, Point{1, 0}, Point{1, 1}, Point{0, 1}, Point{9, 0}})
    mesh.points.push_back(p);
  mesh.owned_nodes = 5;
  mesh.triangles = {{node(1), node(4), node(2)}};
  mesh.quads = {{node(0), node(1), node(2), node(3)}};
  return mesh;
}

}  // namespace quadloop::test
