#pragma once

#include "mesher/base/word_table.hpp"

namespace quadloop {

/// How the corners' costs become the cost of their node. thesis: Eq. 3.4, see nodal_cost. power: the sum of
/// the squared costs, where no corner is inverted; the sum of -J counts where some are. In a valid star no
/// objective may exceed the number of corners: that is how high NloptSolver's wall round such places stands.
enum class Objective { thesis, power };

inline constexpr WordTable<Objective, 2> objective_words{
    {{"power", Objective::power}, {"thesis", Objective::thesis}}};

}  // namespace quadloop
