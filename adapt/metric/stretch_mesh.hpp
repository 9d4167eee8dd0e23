#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adapt/metric/metric_figures.hpp"
#include "generate/generate.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop {

/// What the metric of the next mesh is made from.
struct MetricDemand {
  std::vector<std::string> variables;  ///< at the nodes of the mesh that was solved on
  std::string error;              ///< one there that sizes follow, `variables` then shapes alone; or none
  double norm = 2;                ///< the p of the L^p norm of the interpolation error
  std::int64_t nodes = 0;         ///< wanted, about
  double min = 0;                 ///< no edge is wanted shorter, in the geometry's unit
  bool facets = false;            ///< whether edges at facets may be shorter than half of their segments
  std::int64_t tile_size = 8192;  ///< triangles, about, that are adapted at a time
};

/// How the adapted mesh keeps to the metric, and what its user is to be told.
struct StretchReport {
  MetricFigures figures;
  std::vector<std::string> warnings;
};

/// Adapts the mesh of triangles that a tree has made, without layers, to the metric of a solution on another
/// mesh of the domain, which may have layers: sizes are those of the metric, but nowhere larger than the
/// leaves nor smaller than the demand's least, and grow as the case's gradation says. Nodes come near to the
/// number wanted, from below; walls keep to the outline of `input`, whose mesh it is, and the front of layers
/// stays. The result's tree counts the new cells. It has the same bits on any number of ranks. Throws
/// InputError where the solution has no such variables, and where edges of the
/// boundary cannot be kept from crossing. *Collective.*
StretchReport stretch_mesh(const Communicator& comm, const MeshInput& input, const Mesh& solved,
                           const Field& solution, const MetricDemand& demand, MeshResult& result);

/// How many nodes meshes that follow a metric have at least: the case's own sizes ask for them. `result` is
/// the mesh of the case's tree, without layers, `min` the smallest size allowed. Costs as much as adapting
/// this mesh. *Collective.*
std::int64_t least_nodes_of_metric(const Communicator& comm, const MeshInput& input, double min,
                                   const MeshResult& result);

}  // namespace quadloop
