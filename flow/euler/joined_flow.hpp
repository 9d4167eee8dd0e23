#pragma once

#include "flow/euler/model/euler_options.hpp"
#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/periodic_mesh.hpp"

namespace quadloop::flow::euler {

/// Throws InputError if the options are not available for a mesh with periodic pairs, with the reason.
void require_usable_with_pairs(const Mesh& mesh, const FlowModel& model, const EulerOptions& options);

/// Returns the rows of the nodes that remain in the joined mesh, of a field with a row for each owned node of
/// the given mesh.
Field at_joined_nodes(const PeriodicMesh& joined, const Field& given);

/// Inverse of at_joined_nodes(): nodes across a pair get the row of their original; the velocity turns with a
/// rotation. *Collective.*
Field at_given_nodes(const DualMesh& mesh, const PeriodicMesh& joined, const Field& flow);

}  // namespace quadloop::flow::euler
