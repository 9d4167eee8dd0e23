#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adapt/metric/metric_statistics.hpp"
#include "generate/generate.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::adapt {

/// Data from which the metric of the next mesh is computed.
struct MetricDemand {
  std::vector<std::string> variables;  ///< nodal variables of the solution
  /// Nodal error variable that determines sizes (`variables` then only shapes); may be empty.
  std::string error;
  double norm = 2;                ///< the p of the L^p norm of the interpolation error
  std::int64_t nodes = 0;         ///< target number of nodes
  double min = 0;                 ///< smallest requested edge length, in the geometry's unit
  bool facets = false;            ///< edges at facets may be shorter than half of their segments
  std::int64_t tile_size = 8192;  ///< approximate number of triangles per tile
};

/// How the adapted mesh conforms to the metric, and warnings for the user.
struct StretchReport {
  MetricStatistics statistics;
  std::vector<std::string> warnings;
};

/// Adapts the triangle mesh of a tree, without layers, to the metric of a solution on another mesh of the
/// domain, which may have layers. Sizes are those of the metric, but at most those of the leaves and at least
/// the demand's minimum; their growth is limited by the case's gradation. The number of nodes approaches the
/// target from below. Walls follow the geometry of `input`, which belongs to the mesh; the outer edge of
/// layers is kept. The result's tree counts the new cells. The same bits on any number of ranks. Throws
/// InputError if the solution lacks the variables, or if boundary edges cannot be kept from crossing.
/// *Collective.*
StretchReport stretch_mesh(const Communicator& comm, const MeshInput& input, const Mesh& solved,
                           const Field& solution, const MetricDemand& demand, MeshResult& result);

/// The smallest number of nodes of a mesh adapted to any metric, as the case's own sizes are upper limits.
/// `result` is the mesh of the case's tree, without layers, `min` the smallest allowed size. Costs as much as
/// adapting this mesh. *Collective.*
std::int64_t least_nodes_of_metric(const Communicator& comm, const MeshInput& input, double min,
                                   const MeshResult& result);

}  // namespace quadloop::adapt
