#pragma once

#include "mesher/base/word_table.hpp"

namespace quadloop::smoother {

/// How the cost of a node follows from its corners' costs. thesis: Eq. 3.4, see nodal_cost. power: the sum of
/// the squared costs if no corner is inverted, else the sum of -J. In a valid star an objective must not
/// exceed the number of corners, the height of the barrier in NloptSolver.
enum class Objective { thesis, power };

inline constexpr WordTable<Objective, 2> objective_words{
    {{"power", Objective::power}, {"thesis", Objective::thesis}}};

}  // namespace quadloop::smoother
