#include "mesher/geometry/periodic_pair.hpp"

#include "mesher/geometry/turn.hpp"

namespace quadloop {

Point PeriodicPair::image(Point p) const {
  return rotates() ? turned_about(centre, p, unit_vector(degrees)) : p + translation;
}

Point PeriodicPair::source(Point p) const {
  return rotates() ? turned_about(centre, p, unit_vector(-degrees)) : p - translation;
}

}  // namespace quadloop
