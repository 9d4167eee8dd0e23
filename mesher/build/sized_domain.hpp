#pragma once

#include "mesher/cut/cut_forest.hpp"
#include "mesher/geometry/interior.hpp"
#include "mesher/sizes/size_tree.hpp"

namespace quadloop {

/// A geometry on its background grid, with its size tree. Geometry, options and demands must outlive the
/// object; it cannot be moved.
struct SizedDomain {
  SizedDomain(const Geometry& geometry, const SizeOptions& options, const DemandedSplits& demanded)
      : grid{choose_root(geometry, options)},
        outline{geometry},
        inside{outline},
        resolution{grid, outline, inside},
        sizes{outline, grid, options,
              [this](const Quadrant& q, std::span<const std::int32_t> segments) {
                return resolution.unresolved(q, segments);
              },
              demanded} {}
  SizedDomain(const SizedDomain&) = delete;
  SizedDomain& operator=(const SizedDomain&) = delete;

  TreeGrid grid;
  ShiftedOutline outline;
  Interior inside;
  ResolutionTest resolution;
  SizeTree sizes;
};

}  // namespace quadloop
