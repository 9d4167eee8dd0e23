#pragma once

#include <optional>

#include "mesher/geometry/geometry.hpp"
#include "quadloop/case/key_table.hpp"
#include "quadloop/case/settings.hpp"

namespace quadloop {

/// Settings of a table [[pair]].
struct PairKeys {
  PeriodicPair pair;
  std::optional<double> degrees;
};

const KeyTable<PairKeys>& pair_keys();

/// Reads a table [[pair]]. Throws InputError that names key and line.
WantedPair read_pair(const io::CaseTable& table);

/// Throws InputError for settings of the case that meshes with pairs do not support.
void require_plain_pairs(const Settings& settings);

/// Throws InputError for a boundary of a pair with a boundary condition or layers of its own.
void require_no_conditions(const Settings& settings, const Geometry& geometry);

}  // namespace quadloop
