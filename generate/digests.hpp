#pragma once

#include <cstdint>
#include <string>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A number that changes with every setting that the mesh depends on, beside the geometry.
std::uint64_t case_digest(const MeshOptions& options, const std::vector<LayerLine>& lines = {});

/// A number that changes with any character of a text.
std::uint64_t text_digest(const std::string& text);

/// This rank's nodes' part in coordinate_digest(): the parts of all ranks add up to it, modulo 2^64.
std::uint64_t digest_of_owned(const Mesh& mesh);

/// A number that changes with any node's coordinates and does not depend on the number of ranks.
/// *Collective.*
std::uint64_t coordinate_digest(const Communicator& comm, const Mesh& mesh);

/// A number that changes with any value, constant or name of a solution and does not depend on the number of
/// ranks. *Collective.*
std::uint64_t solution_digest(const Communicator& comm, const Mesh& mesh, const Field& solution);

}  // namespace quadloop
