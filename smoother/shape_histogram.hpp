#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::smoother {

/// Counts of values between limits: counts[i] counts values from limits[i-1] up to limits[i]; the first entry
/// those below limits[0], the last those of limits.back() and above.
struct Histogram {
  std::string name;
  std::vector<double> limits;
  std::vector<std::int64_t> counts;

  void add(double value);
};

/// Histograms of cell shape: corner angles in degrees; and per cell the aspect ratio (longest over shortest
/// edge), the equiangle skewness (0 for the ideal cell, 1 for a flat one) and the largest corner condition
/// number (Eq. 3.3; infinite if inverted). *Collective.*
std::vector<Histogram> shape_histograms(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop::smoother
