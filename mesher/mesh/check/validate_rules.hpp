#pragma once

// For validate() and require_sound() only: the individual rules. All but the first require a mesh that
// satisfies the first.

#include <vector>

#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

using Faults = std::vector<MeshFault>;

inline constexpr double area_tolerance = 1e-10;  ///< relative: rounding of a sum over many cells

void check_indices(const Mesh& mesh, Faults& faults);
void check_coincident(const Mesh& mesh, Faults& faults);
void check_positive(const Mesh& mesh, Faults& faults);
void check_conforming(const Mesh& mesh, const CellBlocks& blocks, const MeshTopology& topology,
                      Faults& faults);
void check_closed(const Mesh& mesh, const MeshTopology& topology, Faults& faults);
void check_area(const Mesh& mesh, const MeshTopology& topology, Faults& faults);
void check_overlap(const Mesh& mesh, const MeshTopology& topology, Faults& faults);

}  // namespace quadloop
