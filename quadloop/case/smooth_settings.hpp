#pragma once

#include "io/input/case_file.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

/// The table [smooth]: sweeps, objective, method, and what cells are to become. That of the mesh must have
/// been read. Throws InputError that names key and line.
void read_smooth_table(const CaseTable& root, Settings& settings);

/// Targets by a solution are made from second derivatives of variables: [adapt], which has been read, must
/// name some. Throws InputError that names key and line.
void require_variables_of_targets(const CaseTable& root, const Settings& settings);

}  // namespace quadloop
