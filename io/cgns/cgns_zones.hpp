#pragma once

// Inside io/cgns only.
#include <cstddef>
#include <span>

#include "io/model/loaded_mesh.hpp"

namespace quadloop {

/// Makes nodes at the same place in different zones one, of which the first zone's stays with its values;
/// `first_nodes` are the places where the nodes of each zone begin. Of an edge that several zones have as a
/// boundary the first mention stays, with its cell of the smaller block to the left. Linear.
void unite_zones(LoadedMesh& loaded, std::span<const std::size_t> first_nodes);

}  // namespace quadloop
