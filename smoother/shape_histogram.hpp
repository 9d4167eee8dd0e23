#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// How many values lie between each two limits: counts[i] those from limits[i-1] up to limits[i], the first
/// those below limits[0], the last those of limits.back() and more.
struct Histogram {
  std::string name;
  std::vector<double> limits;
  std::vector<std::int64_t> counts;

  void add(double value);
};

/// The shapes of all cells: angles of the corners in degrees; of each cell its aspect ratio (longest edge
/// over shortest), its skewness (of the angles from the ideal one, 0 for the ideal cell, 1 for a flat one)
/// and its largest condition number of a corner (Eq. 3.3; infinite if inverted). *Collective.*
std::vector<Histogram> shape_histograms(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
