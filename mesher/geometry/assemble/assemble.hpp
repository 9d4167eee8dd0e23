#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/assemble/boundary_rules.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// What the user is told though the work goes on, one line each.
using Warnings = std::vector<std::string>;

struct AssembleOptions {
  std::vector<BoundaryRule> rules;
  double default_corner_degrees = 30;  ///< of boundaries without a rule of their own
  double join = 1e-9;          ///< ends of chains no farther apart than this share of the extent are joined
  bool unite_islands = false;  ///< those that overlap or touch: united_islands()
  /// From a mesh, say: then nobody is told of loops that were turned, nor of several domains.
  bool domain_is_known = false;
  /// The setting that added a boundary around all others, empty where none did. Then no other boundary may
  /// enclose a domain.
  std::string far_field;
  /// Boundaries of bodies, such as airfoils: the flow is around them, so each needs an outer boundary.
  std::vector<std::string> bodies;
};

/// Makes the outline of the domain from polylines: open chains are joined end to end (end points
/// bit-identical, after join_rounded_ends, in either direction) into loops; chains of one name are one
/// boundary; consecutive points that coincide are dropped; loops are turned so that the domain, which lies
/// inside loops of even nesting depth and outside those of odd depth, is to their left. Boundaries and loops
/// keep the order in which they are first seen. Throws InputError, naming boundary and coordinates, where the
/// chains are not the outline of a domain.
Geometry assemble(std::vector<Chain> chains, const AssembleOptions& options, Warnings& warnings);

}  // namespace quadloop
