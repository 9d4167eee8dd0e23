#pragma once

#include <optional>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// The direction of the flow at the nodes of a mesh, from its velocity or momentum: two columns, x and y, for
/// each owned node. Of a solution in cells, the middle of the range over the cells around the node. Empty if
/// the solution has neither. *Collective.*
std::optional<Field> flow_direction(const Communicator& comm, const Mesh& mesh, const Field& solution);

/// Where a streamline begins: some distance behind a trailing edge, as the velocity is 0 on walls.
struct StreamlineStart {
  Point edge, bisector;  ///< the second of unit length, away from the edge
  double offset = 0;     ///< distance from the edge at which the velocity is evaluated first
  double step = 0;       ///< of the integration
  double length = 0;     ///< of the whole line
};

struct Streamline {
  enum class End {
    complete,
    outside,   ///< where it leaves the mesh
    reversed,  ///< where the flow has no direction, or turns by a right angle from that at the start
    no_start   ///< behind the edge the flow deviates by more than 60 degrees from the bisector
  };
  std::vector<Point> points;  ///< the edge, the start, then one for each step
  End end = End::complete;
};

/// Integrates streamlines downstream by the midpoint rule, of second order in the step, all of them at once.
/// The line begins with a straight piece in the middle between the bisector and the flow. The same points on
/// every rank, and on any number of ranks. O(cells log cells) once, then O(log cells) for each step.
/// *Collective.*
std::vector<Streamline> streamlines(const Communicator& comm, const Mesh& mesh, const Field& direction,
                                    const std::vector<StreamlineStart>& starts);

}  // namespace quadloop::adapt
