#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Returns a hash of all settings that affect the mesh, except the geometry.
std::uint64_t case_digest(const MeshOptions& options, const std::vector<LayerLine>& lines = {},
                          const std::vector<LayerLine>& wakes_without_layers = {});

/// Returns a hash of a text.
std::uint64_t text_digest(const std::string& text);

/// Returns the contribution of this rank's nodes to coordinate_digest(): those of all ranks add up to it,
/// modulo 2^64.
std::uint64_t digest_of_owned(const Mesh& mesh);

/// Returns a hash of all node coordinates, independent of the number of ranks. *Collective.*
std::uint64_t coordinate_digest(const Communicator& comm, const Mesh& mesh);

/// Returns a hash of all values, constants and names of a solution, independent of the number of ranks.
/// *Collective.*
std::uint64_t solution_digest(const Communicator& comm, const Mesh& mesh, const Field& solution);

}  // namespace quadloop
