#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/parts/part_index.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::io {

/// Writes PREFIX.pvtu, which lists the parts' .vtu files as pieces, with the variables of `field`. On the
/// set's only rank. Throws OutputError.
void write_part_pvtu(OutputSet& outputs, const PartIndex& index, const Field& field,
                     const std::string& prefix);

}  // namespace quadloop::io
