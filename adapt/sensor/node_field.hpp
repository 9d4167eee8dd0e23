#pragma once

#include <string>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A variable of the solution by its name: a value for each of this rank's owned nodes. Values after these,
/// of copies, are not read: owners' count.
struct NodeField {
  std::string name;
  std::vector<double> values;
};

/// Which values a field may have, beside being finite.
enum class FieldSign { any, not_negative, positive };

/// Throws InputError on all ranks where a value may not be there; it names the variable and the first such
/// node over all ranks, counted from 1. *Collective.*
void check_field(const Communicator& comm, const Mesh& mesh, const NodeField& field, FieldSign sign);

/// The field's values at owned nodes and copies of the mesh. *Collective.*
std::vector<double> with_copies(const Communicator& comm, const Mesh& mesh, const NodeField& field);

/// A variable as sensors see it: (q - smallest) / (largest - smallest) over all ranks, from 0 to 1.
struct ScaledField {
  std::vector<double> values;  ///< at owned nodes and copies; all 0 where the variable is constant
  double rounding = 0;         ///< differences below this may be nothing but the rounding of q
  bool constant = false;
};

/// `rounding` is 2^-44 of the variable's largest size (some 256 times its own rounding, for what a solver's
/// last bits add up to), and a variable whose whole range is no larger is constant. Scaled, no difference can
/// overflow. The field must be finite. *Collective.*
ScaledField scaled_by_range(const Communicator& comm, const Mesh& mesh, const NodeField& field);

}  // namespace quadloop
