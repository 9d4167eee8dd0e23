#pragma once

#include "mesher/mesh/mesh.hpp"

namespace quadloop::test {

/// The square [0, 2] x [0, 2]: two unit quads below, four triangles above; nodes row by row, node 4 in the
/// middle. Boundaries "wall" (south, east) and "far" (north, west).
inline Mesh mixed_square() {
  Mesh mesh;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) mesh.points.push_back({static_cast<double>(i), static_cast<double>(j)});
  }
  mesh.owned_nodes = 9;
  const auto node = [](std::int32_t number) { return NodeId{number}; };
  mesh.quads = {{node(0), node(1), node(4), node(3)}, {node(1), node(2), node(5), node(4)}};
  mesh.triangles = {{node(3), node(4), node(7)},
                    {node(3), node(7), node(6)},
                    {node(4), node(5), node(8)},
                    {node(4), node(8), node(7)}};
  mesh.boundaries = {
      {"wall", "wall", {{node(0), node(1)}, {node(1), node(2)}, {node(2), node(5)}, {node(5), node(8)}}},
      {"far", "farfield", {{node(8), node(7)}, {node(7), node(6)}, {node(6), node(3)}, {node(3), node(0)}}}};
  return mesh;
}

}  // namespace quadloop::test
