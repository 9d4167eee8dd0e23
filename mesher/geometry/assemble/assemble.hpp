#pragma once

#include <limits>
#include <string>
#include <vector>

#include "mesher/geometry/assemble/block_loops.hpp"
#include "mesher/geometry/assemble/boundary_rules.hpp"
#include "mesher/geometry/assemble/pair_outlines.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Warnings for the user, one line each.
using Warnings = std::vector<std::string>;

/// A line inside the domain that the mesh follows.
struct LineRule {
  std::string name;
  std::string boundary;     ///< a chain of the geometry; empty: the path
  std::vector<Point> path;  ///< closed if it ends where it begins
  bool baffle = false;      ///< each side has nodes of its own
  std::string where;        ///< where the rule stands, for messages
  bool spline = false;      ///< the points of the path are joined by cubic splines from corner to corner
};

struct AssembleOptions {
  std::vector<BoundaryRule> rules;
  double default_corner_degrees = 30;  ///< for boundaries without a rule of their own
  double join = 1e-9;  ///< tolerance, as a fraction of the extent, within which ends of chains are joined
  /// Largest distance of a curve from its chords, by the smallest cells: the nodes of a mesh move by it.
  double chord_height = std::numeric_limits<double>::infinity();
  double cell_degrees = 15;    ///< a curve may turn by so much along a cell
  bool unite_islands = false;  ///< unite islands that overlap or touch: united_islands()
  /// The chains come from a mesh, for example: no warnings about reversed loops or several domains.
  bool domain_is_known = false;
  /// The setting that added a boundary around all others, empty if there is none. With it no other boundary
  /// may enclose a domain.
  std::string far_field;
  /// The blocks of the domain; empty: the domain is one block.
  std::vector<BlockRule> blocks;
  std::vector<LineRule> lines;
  /// Boundaries of bodies, such as airfoils; each needs an outer boundary, as the flow is around them.
  std::vector<std::string> bodies;
  std::vector<WantedPair> pairs = {};  ///< made exact: match_outlines()
};

/// Builds the geometry of the domain from polylines. Joins open chains end to end into loops (ends must be
/// bit-identical after join_rounded_ends; either direction), or finds the loops of blocks (block_loops()).
/// Chains of one name form one boundary. Drops consecutive points that coincide. Reverses loops so that the
/// domain is to their left; the domain is inside loops of even nesting depth and outside loops of odd depth.
/// Boundaries and loops keep the order of the input. Inner lines become parts of the loops (block_loops()).
/// Throws InputError with boundary and coordinates if the
/// chains do not bound a domain.
Geometry assemble(std::vector<Chain> chains, const AssembleOptions& options, Warnings& warnings);

}  // namespace quadloop
