#pragma once

#include <span>
#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Within which sizes a metric stays.
struct SizeBounds {
  /// No edge is wanted shorter than this: a metric that asks for it becomes larger as a whole, so that cells
  /// of a front that is thinner stay as long along it.
  double min = 0;
  std::vector<double> most;        ///< at each owned node and copy: nor longer than this
  double slope = 0.25;             ///< by which sizes may grow for each unit of length: (gradation - 1) / 2
  std::vector<double> least = {};  ///< at each of them, or of none: nor shorter than this, which may be 0
};

/// `least` at facets of an outline (FacetZones), by the points of nodes; of none where there is no facet.
std::vector<double> least_at_facets(const Geometry& geometry, std::span<const Point> points);

/// The metric that makes the L^p norm of the interpolation error least for its complexity, the integral of
/// its density: det(H)^(-1 / (2 p + 2)) H, but for a factor, with the absolute hessians H (Loseille and
/// Alauzet, SIAM J. Numer. Anal. 49, 2011). The same bits on any number of ranks.
class WantedMetric {
 public:
  /// From hessians at owned nodes and copies, positive definite (node_bends.hpp), or none; `mesh` must
  /// outlive it. *Collective.*
  WantedMetric(const Communicator& comm, const Mesh& mesh, const std::vector<Symmetric>& bends, double norm,
               SizeBounds bounds);

  /// Whether there is nothing to follow.
  bool flat() const { return !(total_ > 0); }

  /// The metrics at owned nodes and copies whose complexity, within the bounds, is so much, to a fiftieth;
  /// that of the bounds alone where they ask for more. *Collective.*
  std::vector<LogMetric> of_complexity(double complexity) const;

  /// Those whose complexity is so much before they are brought within the bounds: where these take away from
  /// it nothing is added elsewhere. *Collective.*
  std::vector<LogMetric> before_bounds(double complexity) const;

 private:
  std::vector<Metric> bounded(double factor) const;
  double integral(const std::vector<Metric>& metrics) const;
  Metric within_bounds(const Metric& metric, std::size_t node) const;

  const Communicator& comm_;
  const Mesh& mesh_;
  SizeBounds bounds_;
  std::vector<Metric> shapes_;  ///< at owned nodes and copies, but for a factor
  std::vector<double> areas_;   ///< of cells
  double total_ = 0;            ///< the integral of the shapes' density
};

}  // namespace quadloop
