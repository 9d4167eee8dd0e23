#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Which values a field may have, beside being finite.
enum class FieldSign { any, not_negative, positive };

/// Throws InputError on all ranks where a value at an owned node, or in a cell, may not be there; it names
/// the first such variable and its first such node or cell over all ranks, counted from 1. *Collective.*
void check_field(const Communicator& comm, const Mesh& mesh, const Field& field, FieldSign sign);

/// A variable as sensors see it: (q - smallest) / (largest - smallest) over all ranks, from 0 to 1.
struct ScaledField {
  std::vector<double>
      values;           ///< at owned nodes and copies, or in cells; all 0 where the variable is constant
  double rounding = 0;  ///< differences below this may be nothing but the rounding of q
  bool constant = false;
};

/// `rounding` is 2^-44 of the variable's largest size (some 256 times its own rounding, for what a solver's
/// last bits add up to), and a variable whose whole range is no larger is constant. Scaled, no difference can
/// overflow. `values` are those of one variable at owned nodes and copies, or in cells, finite. *Collective.*
ScaledField scaled_by_range(const Communicator& comm, std::vector<double> values);

}  // namespace quadloop
