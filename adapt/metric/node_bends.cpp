#include "adapt/metric/node_bends.hpp"

#include <algorithm>
#include <cmath>

#include "adapt/sensor/recovery/hessians.hpp"
#include "adapt/sensor/recovery/scaled_field.hpp"
#include "adapt/sensor/solver_error.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::adapt {

namespace {

/// Lower limit of eigenvalues relative to the largest one. Far below significant values: at shocks
/// eigenvalues are about 1e8 times those of a far field with large cells.
constexpr double least_anywhere = 1e-14;
/// Largest aspect ratio of cells. With longer cells flow solvers stall (on the wedge for 90 and more), and
/// the number of nodes is hardly reduced.
constexpr double most_stretch = 15;

/// *Collective.*
double largest_anywhere(const Communicator& comm, const std::vector<Hessian>& hessians) {
  double largest = 0;
  for (const Hessian& h : hessians) largest = std::max(largest, largest_eigenvalue(h));
  return comm.maximum(largest);
}

Metric positive(const Hessian& h, double largest) {
  Eigen2 e = eigen_of({h.xx, h.xy, h.yy});
  e.larger = std::max(e.larger, least_anywhere * largest);
  e.smaller = std::max(e.smaller, e.larger / (most_stretch * most_stretch));
  return Metric{symmetric_of(e)};
}

/// Replaces the shape of each matrix by the mean shape (of logarithms) in the cells around it, keeping its
/// determinant: along shocks second derivatives are noisy and change sign and direction from node to node.
/// *Collective.*
void average_shapes(const Communicator& comm, const Mesh& mesh, std::vector<Symmetric>& bends) {
  const HaloMesh halo(comm, mesh);
  std::vector<LogMetric> logs;
  for (const Symmetric& bend : bends) logs.push_back(log_of(Metric{bend}));
  logs.resize(halo.points().size());
  halo.exchange().update(logs);
  std::vector<LogMetric> sums(static_cast<std::size_t>(mesh.owned_nodes));
  std::vector<double> counts(sums.size(), 0);
  halo.for_each_cell([&](const auto& nodes) {
    Symmetric sum;
    for (const NodeId node : nodes) sum = sum + logs[node.value()];
    for (const NodeId node : nodes) {
      if (!mesh.owns(node)) continue;
      sums[node.value()] = LogMetric{sums[node.value()] + sum};
      counts[node.value()] += static_cast<double>(nodes.size());
    }
  });
  for (std::size_t n = 0; n < sums.size(); ++n) {
    if (counts[n] == 0) continue;  // no cell outside layers
    const Symmetric mean = 1 / counts[n] * sums[n];
    const double rise = 0.5 * (logs[n].xx + logs[n].yy - mean.xx - mean.yy);
    logs[n] = LogMetric{mean + Symmetric{rise, 0, rise}};
  }
  halo.exchange().update(logs);
  for (std::size_t n = 0; n < bends.size(); ++n) bends[n] = exp_of(logs[n]);
}

}  // namespace

std::vector<Symmetric> variable_bends(const Communicator& comm, const Mesh& mesh, const Field& field) {
  check_field(comm, mesh, field, FieldSign::any);
  const Field shared = with_ghosts(comm, mesh, field);
  std::vector<Symmetric> joint;
  for (std::size_t v = 0; v < shared.width(); ++v) {
    const ScaledField scaled = scaled_by_range(comm, shared.column(v));
    if (scaled.constant) continue;
    const std::vector<Hessian> hessians = node_hessians(comm, mesh, scaled);
    const double largest = largest_anywhere(comm, hessians);
    if (!(largest > 0)) continue;
    const bool first = joint.empty();
    if (first) joint.resize(hessians.size());
    for (std::size_t i = 0; i < hessians.size(); ++i) {
      const Metric own = positive(hessians[i], largest);
      joint[i] = first ? own : intersection(Metric{joint[i]}, own);
    }
  }
  if (comm.any(!joint.empty())) average_shapes(comm, mesh, joint);
  return joint;
}

namespace {

template <class Nodes>
double area_of(const HaloMesh& halo, const Nodes& nodes) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
    twice +=
        cross(halo.point(nodes[i]) - halo.point(nodes[0]), halo.point(nodes[i + 1]) - halo.point(nodes[0]));
  return 0.5 * twice;
}

/// Sums over the cells around a node.
struct Round {
  double area = 0, lost = 0;
};

}  // namespace

std::vector<Symmetric> error_bends(const Communicator& comm, const Mesh& mesh, const Field& error,
                                   std::vector<Symmetric> bends) {
  const std::vector<double> densities = error_densities(comm, mesh, error);
  const HaloMesh halo(comm, mesh);
  std::vector<Round> rounds(static_cast<std::size_t>(mesh.owned_nodes));
  halo.for_each_cell([&](const auto& nodes) {
    const double area = area_of(halo, nodes);
    for (const NodeId node : nodes) {
      if (!mesh.owns(node)) continue;
      double sum = 0;
      for (std::size_t k = 0; k < nodes.size(); ++k)
        sum += squared_length(bends[node.value()],
                              halo.point(nodes[(k + 1) % nodes.size()]) - halo.point(nodes[k]));
      rounds[node.value()].area += area;
      rounds[node.value()].lost += area * sum / 24;
    }
  });
  double largest = 0;
  std::vector<double> factors(halo.points().size(), 0);
  for (std::size_t n = 0; n < rounds.size(); ++n) {
    if (rounds[n].lost > 0) factors[n] = densities[n] * rounds[n].area / rounds[n].lost;
  }
  halo.exchange().update(factors);
  for (std::size_t n = 0; n < bends.size(); ++n) {
    bends[n] = factors[n] * bends[n];
    largest = std::max(largest, eigen_of(bends[n]).larger);
  }
  largest = comm.maximum(largest);
  if (!(largest > 0)) return {};
  for (Symmetric& bend : bends) bend = positive({bend.xx, bend.xy, bend.yy}, largest);
  return bends;
}

}  // namespace quadloop::adapt
