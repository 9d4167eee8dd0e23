#pragma once

#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// The geometry with two halves in place of each flagged curve: its chords are nearer to the curves, and it
/// makes the same demands of cell sizes and nodes. Twins must be flagged alike.
Geometry with_halved_curves(const Geometry& geometry, const std::vector<char>& flagged);

}  // namespace quadloop
