#pragma once

#include <cstddef>
#include <string>

#include "io/files/reading/line_range.hpp"
#include "io/model/loaded_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// Reads a plane SU2 mesh of one zone as read_su2() does, each rank the lines in its range of bytes; then the
/// rows are distributed evenly. A rank holds `piece` bytes of the file at a time. Throws an InputError on all
/// ranks if the file needs a correction or a warning, or has an error; the message does not name the place:
/// read_su2() then gives the result. *Collective.*
LoadedMesh read_su2_ranges(const Communicator& comm, const std::string& path,
                           std::size_t piece = LineRange::usual_piece);

}  // namespace quadloop::io
