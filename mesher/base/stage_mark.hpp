#pragma once

#include <string>

namespace quadloop {

/// Tell a profiling library for MPI (IPM, or another in front of the calls) that a stage begins, or ends, by
/// MPI_Pcontrol(1, stage) and MPI_Pcontrol(-1, stage); without one, and without MPI, nothing happens. Not
/// collective.
void mark_stage_begin(const std::string& stage);
void mark_stage_end(const std::string& stage);

}  // namespace quadloop
