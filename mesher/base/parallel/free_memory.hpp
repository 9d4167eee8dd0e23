#pragma once

#include <string>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// What a user is told where memory ends (std::bad_alloc): bad input, exit status 1.
inline constexpr const char* out_of_memory =
    "out of memory; use a coarser mesh (larger spacing.min and spacing.max), more machines, or a machine "
    "with more memory";

/// Bytes of memory that the ranks may still fill together: what the system, its control groups and the limits
/// of the processes (ulimit) leave, each rank having as much as the worst off. What is free on a machine is
/// shared out over its ranks. Infinity where nothing says. *Collective.*
double free_memory_of_all(const Communicator& comm);

/// What the control groups leave below `root`, where control groups are mounted: `membership` is the text of
/// /proc/self/cgroup. Exposed for tests.
double free_in_control_groups(const std::string& membership, const std::string& root);

}  // namespace quadloop
