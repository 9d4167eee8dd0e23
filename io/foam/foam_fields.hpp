#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesher/mesh/field.hpp"

namespace quadloop::io {

/// Returns the folder of a case's latest time above 0: that with the largest number as its name. Empty if
/// there is none.
std::string latest_foam_time(const std::string& case_folder);

/// Reads the cell fields (volScalarField, volVectorField) in a time folder, sorted by name, for a mesh of
/// this number of cells, in their order; uniform fields are expanded. A vector U gives U_x and U_y. Other
/// files are ignored. On the calling rank only. Throws InputError for binary or compressed files, another
/// number of cells, and invalid numbers.
CellValues read_foam_fields(const std::string& folder, std::size_t cells);

/// Throws InputError if one of the folder's fields is binary or compressed, or has no internalField.
void require_foam_fields(const std::string& folder);

/// OpenFOAM defines yPlus and wallShearStress on walls only, with 0 in all cells. Sets the value of each cell
/// at a patch of type wall to that of its face there (the last one for a cell with several), with the names
/// of read_foam_fields(), from the time folder. The patches are those of `poly_mesh`. On the calling rank
/// only, for all cells. Throws InputError as read_foam_fields() does.
void put_wall_values(const std::string& folder, const std::string& poly_mesh, CellValues& cells);

/// Replaces internalField in those fields of the folder whose variables, with the names of
/// read_foam_fields(), are all given; boundary conditions and all other text are kept. Returns the names of
/// the changed files. On the calling rank only, for all cells. Throws InputError as above, OutputError.
std::vector<std::string> set_foam_fields(const std::string& folder, const CellValues& cells);

}  // namespace quadloop::io
