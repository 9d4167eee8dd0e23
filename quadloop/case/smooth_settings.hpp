#pragma once

#include "quadloop/case/key_table.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

/// The table [smooth].
struct SmoothKeys {
  smoother::SmoothOptions options;
  bool follows_solution = false;  ///< whether cells follow the solution
  double stretch = 8;             ///< as MeshInput::stretch, if they do
};

const KeyTable<SmoothKeys>& smooth_keys();

/// Reads sweeps, objective, method and targets. Throws InputError that names key and line.
void read_smooth_table(const io::CaseTable& table, Settings& settings);

/// Targets from a solution need second derivatives of variables: requires that [adapt], which has been read,
/// names some. Throws InputError that names key and line.
void require_variables_of_targets(const io::CaseTable& root, const Settings& settings);

}  // namespace quadloop
