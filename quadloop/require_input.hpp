#pragma once

#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Throws InputError unless the field has a row for each owned node, and each of its cell variables one for
/// each cell. *Collective.*
void require_rows(const Communicator& comm, const Mesh& mesh, const Field& field);

/// Throws InputError, with the source of the heights, unless they are two or more, ascend, and neither their
/// values nor their differences are out of range: areas and volumes would exceed that of double precision.
void require_heights(const std::vector<double>& heights, const std::string& source);

}  // namespace quadloop
