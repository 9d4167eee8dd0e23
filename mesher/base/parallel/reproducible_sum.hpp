#pragma once

#include <span>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// The sum of all ranks' values, with the same bits whatever the order of the values and the number of ranks:
/// values are added as integers that count a unit set by the largest of them and by how many there are. Off
/// by less than 2^-60 of the largest value's size times their number for up to 2^31 values, beside the
/// rounding of the result. 0 for no values; not a number where any value is not finite. *Collective.*
double reproducible_sum(const Communicator& comm, std::span<const double> values);

}  // namespace quadloop
