#pragma once

// For validate_geometry() only: the comparison of a mesh's boundaries with a geometry on the root.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/check/cell_reach.hpp"
#include "mesher/mesh/check/validate_geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The cells beside a boundary edge.
struct EdgeSides {
  std::int32_t boundary = 0;
  std::int32_t left = none, right = none;  ///< their blocks
  double longest = 0;                      ///< longest edge of the cell to its left

  static constexpr std::int32_t none = -1;  ///< there is no cell
};

/// An edge with a cell on its left only, by its place in the order of the cells' edges.
struct OuterSegment {
  std::int64_t cell;
  std::int32_t side;
  Point from, to;
};

/// What the root needs to know of a distributed mesh.
struct MeshOutline {
  Mesh boundaries;               ///< without cells
  std::vector<EdgeSides> sides;  ///< of the edges, boundary after boundary
  std::vector<OuterSegment> outer;
  Box box;
  std::int32_t blocks = 1;
};

/// A fault of rule `geometry`; if it has a question, only a fault if the cells around are small.
struct PossibleFault {
  std::string what;  ///< of a loop the name of its boundary
  Point place;
  std::optional<ReachQuestion> question = {};  ///< none: certainly a fault
  Point loop_size = {};
};

/// The result of a comparison; the faults of `fit` lack the possible ones.
struct OutlineComparison {
  GeometryFit fit;
  std::vector<PossibleFault> possible_faults;
};
OutlineComparison compare_outline(const MeshOutline& outline, std::span<const Chain> geometry,
                                  double tolerance);

/// Adds the possible faults that the answers to their questions, in their order, do not rule out.
void add_confirmed(const std::vector<PossibleFault>& possible_faults, const std::vector<double>& answers,
                   GeometryFit& fit);

}  // namespace quadloop
