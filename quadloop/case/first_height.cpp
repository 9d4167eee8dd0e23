#include "quadloop/case/first_height.hpp"

#include <cmath>

namespace quadloop {

double height_of_y_plus(double y_plus, const FlowConditions& flow) {
  const double friction = std::pow(2 * std::log10(flow.reynolds) - 0.65, -2.3);
  return y_plus * flow.reference_length / (flow.reynolds * std::sqrt(friction / 2));
}

}  // namespace quadloop
