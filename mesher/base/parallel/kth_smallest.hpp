#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// Returns the k-th smallest of all ranks' values, k from 1 to their number; values must not be negative. The
/// values of a rank are reordered; nothing but counts is exchanged. *Collective.*
double kth_smallest(const Communicator& comm, std::vector<double>& values, std::int64_t k);

}  // namespace quadloop
