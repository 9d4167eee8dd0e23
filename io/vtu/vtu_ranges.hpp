#pragma once

#include <string>

#include "io/model/loaded_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// Reads a plane mesh of one block in the form of write_vtu(), with arrays that are appended raw and not
/// compressed, as read_vtu() does: each rank its even share of the points and cells. Throws an InputError on
/// all ranks if the file is of another form, needs a correction or has an error; the message does not name
/// the place: read_vtu() then gives the result. *Collective.*
LoadedMesh read_vtu_ranges(const Communicator& comm, const std::string& path);

}  // namespace quadloop::io
