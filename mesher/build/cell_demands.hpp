#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// Size settings that may be changed: those of the case and of its boundaries.
struct SizeSettings {
  SizeOptions size;
  std::vector<Boundary> boundaries;
};

/// A setting that increases the number of cells.
struct CellDemand {
  std::string key;      ///< key in the case file, with its location if it has no name
  double value = 0;     ///< current value
  double loosest = 0;   ///< value without any effect
  bool is_size = true;  ///< false: a gap setting, where larger values give more cells
  std::function<void(SizeSettings&, double value)> set;
  std::function<void(SizeSettings&)> lift;  ///< removes the effect of this setting
};

/// Returns the settings that increase the number of cells, each key once; boundaries of equal spacing are
/// combined.
std::vector<CellDemand> cell_demands(const SizeSettings& settings, const Geometry& geometry);

/// Returns the same geometry with other boundary settings.
Geometry with_boundaries(const Geometry& geometry, const std::vector<Boundary>& boundaries);

}  // namespace quadloop
