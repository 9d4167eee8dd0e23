#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/periodic_pair.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The nodes of a boundary that is one open line, from its start, with the domain to the left; the same on
/// every rank.
struct BoundaryLine {
  std::vector<GlobalNodeId> nodes;
  std::vector<Point> points;
  /// For each edge of the line its place in the concatenated lists of all ranks' edges.
  std::vector<std::int32_t> edges;
};

/// Returns the line; none if the mesh has no boundary of this name, or if it is not one open line.
/// *Collective.*
std::optional<BoundaryLine> line_of_boundary(const Communicator& comm, const Mesh& mesh,
                                             const std::string& boundary);

/// The nodes on the two sides of a pair, partners at the same index, along `from`; the same on every rank.
struct PairedNodes {
  BoundaryLine from, to;
};

/// Why the nodes of a pair do not match, and where.
struct PairFault {
  std::string what;
  Point place;
};

/// Returns the first such place along `from`; none if each node has a partner within 1e-11 of the largest
/// coordinate. *Collective.*
std::optional<PairFault> fault_of_pair(const Communicator& comm, const Mesh& mesh, const PeriodicPair& pair);

/// Returns the nodes of a pair of the mesh. Throws InputError with the fault_of_pair(), if there is one.
/// *Collective.*
PairedNodes paired_nodes(const Communicator& comm, const Mesh& mesh, const PeriodicPair& pair);

/// Returns this rank's nodes on the sides of all pairs, ghosts included, ascending.
std::vector<NodeId> nodes_on_sides(const Mesh& mesh);

}  // namespace quadloop
