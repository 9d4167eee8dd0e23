#pragma once

#include <cstdint>

#include "adapt/loop/case_settings.hpp"
#include "adapt/solvers/chosen_solver.hpp"

namespace quadloop {

/// The files of the user's case that the solver's own is made from, as settings: SU2's configuration, or what
/// is copied of OpenFOAM's folder, each by its template_key() with the digest of its bytes. Empty for other
/// solvers; what cannot be read is left out, as the solver says so. On the calling rank alone.
CaseSettings template_files(const ChosenSolver& solver);

/// Of all of them.
std::uint64_t template_digest(const CaseSettings& files);

}  // namespace quadloop
