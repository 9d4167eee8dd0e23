#pragma once

// For io/cgns only.
#include <string>

#include "io/cgns/cgns_contents.hpp"
#include "io/model/loaded_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// Reads the arrays of a plane mesh of one zone, each rank its even share of each of them. `contents` is the
/// same on all ranks, and by ranges. Throws an InputError on all ranks if a number is invalid, or a
/// rank cannot read the file; the message does not name the place. *Collective.*
LoadedMesh read_cgns_ranges(const Communicator& comm, const std::string& path, CgnsContents contents);

}  // namespace quadloop::io
