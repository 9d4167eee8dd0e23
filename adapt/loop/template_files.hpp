#pragma once

#include <cstdint>

#include "adapt/loop/case_settings.hpp"
#include "adapt/solvers/chosen_solver.hpp"

namespace quadloop::adapt {

/// Returns the files of the user's case that the solver's case is made from, as settings: SU2's
/// configuration, or the copied files of OpenFOAM's folder, each under its template_key() with the digest of
/// its bytes. Empty for other solvers. Unreadable files are omitted; the solver reports them. On the calling
/// rank only.
CaseSettings template_files(const ChosenSolver& solver);

/// Returns the digest of all files.
std::uint64_t template_digest(const CaseSettings& files);

}  // namespace quadloop::adapt
