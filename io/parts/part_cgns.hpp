#pragma once

#include "io/files/output_file.hpp"
#include "mesher/partition/mesh_part.hpp"

namespace quadloop::io {

/// Adds to the completed CGNS file of a partition a UserDefinedData_t "Part" under its zone: DataArray_t
/// "Number" (part, parts), "GlobalNodeNumber", "NodeOwner", "GlobalTriangleNumber", "GlobalQuadNumber", and
/// for each neighbour a UserDefinedData_t of its name with "SharedNodes". All numbers are from 1. On one
/// rank. Throws OutputError.
void put_part_into_cgns(const StagedFile& staged, const MeshPart& part, std::int32_t parts);

}  // namespace quadloop::io
