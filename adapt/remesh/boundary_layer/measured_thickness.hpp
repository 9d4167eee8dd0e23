#pragma once

#include <vector>

#include "adapt/remesh/demands/solved_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/measured_flow.hpp"

namespace quadloop::adapt {

/// Whether a solution has the velocity at nodes, from which thicknesses are measured.
bool has_velocity(const Field& solution);

/// The thickness of the boundary layer on the walls whose layers follow it (LayerSpec::follows_flow), by
/// layer_edge() along the normal at each wall node. Samples are 10 % apart, from 0.005 to 10 times the
/// thickness of the layers that the case specifies, but at most up to half of the distance to the next
/// boundary. Vorticity is that of the recovered gradients of the velocity. Values are smoothed along the wall
/// (smoothed()); 0 where no edge is found. Edges have the order of wall_pieces(); the same bits on every rank
/// and on any number of ranks. Empty without velocity at nodes. *Collective.*
std::vector<MeasuredThickness> measured_thickness(const Communicator& comm, const Geometry& geometry,
                                                  const SolvedMesh& solved);

}  // namespace quadloop::adapt
