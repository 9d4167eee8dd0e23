#pragma once

#include <cmath>
#include <cstdint>

#include "mesher/mesh/mesh.hpp"

namespace quadloop::test {

/// The rectangle [0, columns] x [0, height], whole: `layers` rows of height 0.1, 0.2, 0.4 ... at the bottom,
/// then as many rows of height 1. Below, "wall" from x = `from` on carries the layers and "symmetry" before
/// it does not; "side" is at the left and the right, "top" above. Triangles alone, or quads.
struct LayeredStrip {
  std::int32_t columns = 6, layers = 3, from = 2;
  bool triangles = false;

  std::int32_t rows() const { return 2 * layers; }
  NodeId node(std::int32_t i, std::int32_t j) const { return NodeId{j * (columns + 1) + i}; }
  double height(std::int32_t row) const {
    double y = 0;
    for (std::int32_t j = 0; j < row; ++j) y += j < layers ? 0.1 * std::ldexp(1.0, j) : 1;
    return y;
  }

  Mesh mesh() const {
    Mesh made;
    for (std::int32_t j = 0; j <= rows(); ++j) {
      for (std::int32_t i = 0; i <= columns; ++i) made.points.push_back({static_cast<double>(i), height(j)});
    }
    made.owned_nodes = size32(made.points);
    BoundaryEdges wall{"wall", "wall", {}, {layers, height(layers)}}, symmetry{"symmetry", "none", {}},
        side{"side", "none", {}}, top{"top", "none", {}};
    for (std::int32_t i = 0; i < columns; ++i) {
      (i < from ? symmetry : wall).edges.push_back({node(i, 0), node(i + 1, 0)});
      top.edges.push_back({node(i + 1, rows()), node(i, rows())});
      for (std::int32_t j = 0; j < rows(); ++j) add_cell(i, j, made);
    }
    for (std::int32_t j = 0; j < rows(); ++j) {
      side.edges.push_back({node(columns, j), node(columns, j + 1)});
      side.edges.push_back({node(0, j + 1), node(0, j)});
    }
    made.boundaries = {top, wall, symmetry, side};
    return made;
  }

 private:
  void add_cell(std::int32_t i, std::int32_t j, Mesh& to) const {
    const NodeId a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
    if (!triangles) {
      to.quads.push_back({a, b, c, d});
    } else if (i % 2 == 0) {
      to.triangles.push_back({a, b, c});
      to.triangles.push_back({a, c, d});
    } else {
      to.triangles.push_back({a, b, d});
      to.triangles.push_back({b, c, d});
    }
  }
};

}  // namespace quadloop::test
