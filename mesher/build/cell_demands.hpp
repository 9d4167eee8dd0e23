#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// The sizes of a mesh as they might be changed: what a case says of them, and what its boundaries ask for.
struct SizeSettings {
  SizeOptions size;
  std::vector<Boundary> boundaries;
};

/// One setting that asks for cells.
struct CellDemand {
  std::string key;      ///< as the user knows it, with its place where it has no name
  double value = 0;     ///< as it is
  double loosest = 0;   ///< asks for nothing any more
  bool is_size = true;  ///< else gap: it asks for more the larger it is
  std::function<void(SizeSettings&, double value)> set;
  std::function<void(SizeSettings&)> lift;  ///< takes away what it alone asks for
};

/// What asks for cells, each key once; boundaries of one spacing go together.
std::vector<CellDemand> cell_demands(const SizeSettings& settings, const Geometry& geometry);

/// The same outline with other demands of its boundaries.
Geometry with_boundaries(const Geometry& geometry, const std::vector<Boundary>& boundaries);

}  // namespace quadloop
