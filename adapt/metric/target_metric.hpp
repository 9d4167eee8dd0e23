#pragma once

#include <span>
#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// Limits of a metric's sizes.
struct SizeBounds {
  /// Smallest edge length. A metric with smaller sizes is scaled as a whole, so that cells at thin shocks
  /// keep their aspect ratio.
  double min = 0;
  std::vector<double> most;        ///< largest size at each owned node and ghost copy
  double slope = 0.25;             ///< growth limit of sizes per unit of length: (gradation - 1) / 2
  std::vector<double> least = {};  ///< smallest size at each of these nodes, may be 0; or empty
};

/// `least` for facets of a geometry (FacetZones), at the given nodes; empty if there are no facets.
std::vector<double> least_at_facets(const Geometry& geometry, std::span<const Point> points);

/// The metric that minimises the L^p norm of the interpolation error for a given complexity (the integral of
/// its density): det(H)^(-1 / (2 p + 2)) H up to a factor, with the absolute Hessians H (Loseille and
/// Alauzet, SIAM J. Numer. Anal. 49, 2011). The same bits on any number of ranks.
class TargetMetric {
 public:
  /// `bends`: positive definite Hessians at owned nodes and ghost copies (node_bends.hpp), or empty; `mesh`
  /// must outlive it. *Collective.*
  TargetMetric(const Communicator& comm, const Mesh& mesh, const std::vector<Symmetric>& bends, double norm,
               SizeBounds bounds);

  /// Whether there is no error to reduce.
  bool flat() const { return !(total_ > 0); }

  /// The metrics at owned nodes and ghost copies that have this complexity, within 2 %, after the size limits
  /// are applied; those of the limits alone if these require more. *Collective.*
  std::vector<LogMetric> of_complexity(double complexity) const;

  /// The metrics with this complexity before the size limits are applied; complexity removed by the limits is
  /// not added elsewhere. *Collective.*
  std::vector<LogMetric> before_bounds(double complexity) const;

 private:
  std::vector<Metric> bounded(double factor) const;
  double integral(const std::vector<Metric>& metrics) const;
  Metric within_bounds(const Metric& metric, std::size_t node) const;

  const Communicator& comm_;
  const Mesh& mesh_;
  SizeBounds bounds_;
  std::vector<Metric> shapes_;  ///< at owned nodes and ghost copies, up to a factor
  std::vector<double> areas_;   ///< of cells
  double total_ = 0;            ///< integral of the shapes' density
};

}  // namespace quadloop::adapt
