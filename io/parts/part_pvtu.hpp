#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/parts/part_index.hpp"

namespace quadloop {

/// Writes PREFIX.pvtu, which lists the parts' .vtu files as pieces; `variables` are those of the solution. On
/// the set's only rank. Throws OutputError.
void write_part_pvtu(OutputSet& outputs, const PartIndex& index, const std::vector<std::string>& variables,
                     const std::string& prefix);

}  // namespace quadloop
