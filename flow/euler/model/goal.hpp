#pragma once

#include <string>
#include <vector>

#include "mesher/base/word_table.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A number that a flow is solved for, as a coefficient: over dynamic pressure and reference length.
struct Goal {
  enum class Quantity {
    lift,      ///< across the free stream
    drag,      ///< along it
    moment,    ///< nose up, over another reference length
    pressure,  ///< the integral of the pressure, less the free stream's, over the length of the boundaries
  };
  static constexpr WordTable<Quantity, 4> words{{{"lift", Quantity::lift},
                                                 {"drag", Quantity::drag},
                                                 {"moment", Quantity::moment},
                                                 {"pressure", Quantity::pressure}}};

  Quantity quantity = Quantity::drag;
  /// Names of the boundaries that it is of; none: all that feel a force.
  std::vector<std::string> boundaries = {};
  Point about = {};   ///< of a moment
  double weight = 1;  ///< of its error beside those of other goals

  friend bool operator==(const Goal&, const Goal&) = default;
};

}  // namespace quadloop
