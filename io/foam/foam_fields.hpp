#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesher/mesh/field.hpp"

namespace quadloop {

/// The folder of a case's latest time, above 0: that with the largest number for a name. Empty where there is
/// none.
std::string latest_foam_time(const std::string& case_folder);

/// The fields of cells (volScalarField, volVectorField) among the files of a time's folder, in the order of
/// their names, for a mesh of so many cells, in their order; a uniform one is filled up. A vector U gives U_x
/// and U_y. Other files are passed over. On the calling rank alone. Throws InputError: binary or compressed
/// files, another number of cells, values that are no numbers.
CellValues read_foam_fields(const std::string& folder, std::size_t cells);

/// Throws InputError where one of the folder's fields is binary or compressed, or has no internalField.
void require_foam_fields(const std::string& folder);

/// OpenFOAM knows yPlus and wallShearStress on walls alone and has 0 in all cells: gives each cell at a patch
/// of type wall what these fields in the time's folder have on its face there (of a cell with several such
/// faces the last one's), under the names of read_foam_fields(). The patches are those of `poly_mesh`. On the
/// calling rank alone, of all cells. Throws InputError as read_foam_fields() does.
void put_wall_values(const std::string& folder, const std::string& poly_mesh, CellValues& cells);

/// Puts the values in the place of internalField in those of the folder's fields whose variables, by the
/// names of read_foam_fields(), are all among them; boundary conditions and all other text stay. The names of
/// the files changed. On the calling rank alone, of all cells. Throws InputError as above, OutputError.
std::vector<std::string> set_foam_fields(const std::string& folder, const CellValues& cells);

}  // namespace quadloop
