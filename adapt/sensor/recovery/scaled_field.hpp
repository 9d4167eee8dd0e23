#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// Allowed values of a field, besides being finite.
enum class FieldSign { any, not_negative, positive };

/// Throws InputError on all ranks if a value at an owned node, or in a cell, is not allowed; the message
/// names the first such variable and its first such node or cell over all ranks, counted from 1.
/// *Collective.*
void check_field(const Communicator& comm, const Mesh& mesh, const Field& field, FieldSign sign);

/// A variable scaled for sensors: (q - smallest) / (largest - smallest) over all ranks, from 0 to 1.
struct ScaledField {
  std::vector<double>
      values;           ///< at owned nodes and ghost copies, or in cells; all 0 if the variable is constant
  double rounding = 0;  ///< smaller differences may be rounding errors of q
  bool constant = false;
};

/// `rounding` is 2^-44 of the variable's largest magnitude (about 256 times its own rounding, to allow for
/// accumulated errors of a solver); a variable with a smaller range is constant. Scaled differences cannot
/// overflow. `values` are finite values of one variable at owned nodes and ghost copies, or in cells.
/// *Collective.*
ScaledField scaled_by_range(const Communicator& comm, std::vector<double> values);

}  // namespace quadloop::adapt
