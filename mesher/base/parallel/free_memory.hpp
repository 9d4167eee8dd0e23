#pragma once

#include <string>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// Message for std::bad_alloc; exit status 1 (bad input).
inline constexpr const char* out_of_memory =
    "out of memory; use a coarser mesh (larger spacing.min and spacing.max), more machines, or a machine "
    "with more memory";

/// Returns the bytes of memory that the ranks may still use in total, limited by system, control groups and
/// process limits (ulimit), each rank as much as the most limited one. The free memory of a machine is
/// divided among its ranks. Infinity if there is no information. *Collective.*
double free_memory_of_all(const Communicator& comm);

/// Returns freed memory of this process to the system, as far as whole pages of it are free. Without it, pages
/// of arrays that are freed stay beside larger arrays which do not fit into their place.
void return_freed_memory();

/// Returns the free memory of the control groups, which are mounted below `root`; `membership` is the text of
/// /proc/self/cgroup. Exposed for tests.
double free_in_control_groups(const std::string& membership, const std::string& root);

}  // namespace quadloop
