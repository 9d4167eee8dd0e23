#pragma once

#include "quadloop/case/key_table.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

/// The table [smooth].
struct SmoothKeys {
  SmoothOptions options;
  bool follows_solution = false;  ///< cells do
  double stretch = 8;             ///< as MeshInput::stretch, if they do
};

const KeyTable<SmoothKeys>& smooth_keys();

/// Sweeps, objective, method, and what cells are to become. Throws InputError that names key and line.
void read_smooth_table(const CaseTable& table, Settings& settings);

/// Targets by a solution are made from second derivatives of variables: [adapt], which has been read, must
/// name some. Throws InputError that names key and line.
void require_variables_of_targets(const CaseTable& root, const Settings& settings);

}  // namespace quadloop
