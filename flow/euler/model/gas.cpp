#include "flow/euler/model/gas.hpp"

#include <numbers>

namespace quadloop::flow::euler {

State Gas::free_stream(double mach, double degrees) const {
  const double angle = degrees * std::numbers::pi / 180;
  return {1, mach * std::cos(angle), mach * std::sin(angle), 1 / gamma};
}

}  // namespace quadloop::flow::euler
