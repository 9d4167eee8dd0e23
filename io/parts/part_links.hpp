#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "mesher/partition/mesh_part.hpp"

namespace quadloop::io {

/// Writes everything of a part except its mesh. On the set's only rank. Throws OutputError.
void write_part_links(OutputSet& outputs, const MeshPart& part, std::int32_t parts, const std::string& path);

/// Reads one part of a set of `parts`; its mesh is empty. On the calling rank only. Throws InputError.
MeshPart read_part_links(const std::string& path, std::int32_t part, std::int32_t parts);

}  // namespace quadloop::io
