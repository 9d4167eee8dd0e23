#pragma once

#include <string>
#include <vector>

#include "mesher/base/word_table.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::flow {

/// An output functional, as a coefficient: divided by dynamic pressure and reference length.
struct Goal {
  enum class Quantity {
    lift,    ///< normal to the free stream
    drag,    ///< along the free stream
    moment,  ///< nose up, additionally divided by the reference length
    /// Integral of the pressure, minus the free-stream pressure, over the length of the boundaries.
    pressure,
  };
  static constexpr WordTable<Quantity, 4> words{{{"lift", Quantity::lift},
                                                 {"drag", Quantity::drag},
                                                 {"moment", Quantity::moment},
                                                 {"pressure", Quantity::pressure}}};

  Quantity quantity = Quantity::drag;
  /// Names of its boundaries; empty: all with a force.
  std::vector<std::string> boundaries = {};
  Point about = {};   ///< reference point of a moment
  double weight = 1;  ///< weight of its error relative to other functionals

  friend bool operator==(const Goal&, const Goal&) = default;
};

}  // namespace quadloop::flow
