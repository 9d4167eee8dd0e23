#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/periodic_pair.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/paired_nodes.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop {

/// The two sides of a pair in a geometry: vertices with equal index are partners, and both sides have the arc
/// lengths of `from`, along the chords from its start.
class PairOutline {
 public:
  /// Throws InputError with place if the sides are not images of each other.
  PairOutline(const Geometry& geometry, const PeriodicPair& pair);

  double length() const { return arcs_.back(); }
  /// Arc lengths of nodes, given along `from`.
  std::vector<double> arcs_on_from(const smoother::OutlinePath& path, const std::vector<Point>& nodes) const;
  std::vector<double> arcs_on_to(const smoother::OutlinePath& path, const std::vector<Point>& nodes) const;
  /// The point of the chords of `from` at an arc length; exactly a vertex at its arc length.
  Point on_from(double arc) const;
  /// Whether a kept vertex of either side is at exactly this arc length.
  bool kept_at(double arc) const;

 private:
  struct Side {
    std::string name;
    std::vector<std::int32_t> vertices;  ///< along `from`
  };
  std::vector<double> arcs_on(const Side& side, bool reverse, const smoother::OutlinePath& path,
                              const std::vector<Point>& nodes) const;

  const Geometry& geometry_;
  Side from_, to_;
  std::vector<double> arcs_;  ///< of the vertices
};

/// The nodes on both sides of a pair in a mesh, along `from`, with their arc lengths; the same on every rank.
struct PairSides {
  BoundaryLine from, to;  ///< `to` is reversed, its edges point against the list
  std::vector<double> from_arcs, to_arcs;
};

/// Throws InputError if the mesh has lost an end of a side. *Collective.*
PairSides pair_sides(const Communicator& comm, const smoother::OutlinePath& path, const PairOutline& outline,
                     const PeriodicPair& pair, const Mesh& mesh);

}  // namespace quadloop
