#include "adapt/sensor/recovery/hessians.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "adapt/sensor/recovery/moments.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop::adapt {

namespace {

/// Absolute Hessians at owned nodes and ghost copies.
struct NodeHessians {
  IdVector<NodeId, Hessian> outside;  ///< from the cells that are not in layers
  IdVector<NodeId, Hessian> in_layers;
};

class Recovery {
 public:
  Recovery(const Communicator& comm, const Mesh& mesh, const ScaledField& field, ValuesAt at)
      : comm_{comm}, mesh_{mesh}, field_{field}, at_{at}, halo_(comm, mesh) {
    if (!has_layers(mesh)) return;
    places_ = layer_places(comm, mesh);
    places_.resize(halo_.points().size());
    halo_.exchange().update(places_);
  }

  NodeHessians hessians() {
    NodeHessians found{outside_layers(), IdVector<NodeId, Hessian>(mesh_.owned_nodes)};
    if (!places_.empty() && at_ == ValuesAt::nodes) found.in_layers = along_rows();
    for (auto* at_nodes : {&found.outside, &found.in_layers}) {
      at_nodes->resize(halo_.points().size());
      halo_.exchange().update(*at_nodes);
    }
    return found;
  }

  template <class Nodes>
  bool in_layers(const Nodes& nodes) const {
    return !places_.empty() && is_layer_cell(places_, nodes);
  }

 private:
  using OfNodes = IdVector<NodeId, Moments>;

  /// Values at the nodes of the halo mesh.
  IdVector<NodeId, double> node_values() const {
    IdVector<NodeId, double> values(field_.values);
    values.resize(halo_.points().size());
    halo_.exchange().update(values);
    return values;
  }

  /// Moments about each owned node of the points in the cells that touch it; values are relative to the
  /// node's value.
  OfNodes first_ring() {
    OfNodes moments(mesh_.owned_nodes);
    if (at_ == ValuesAt::nodes) {
      bases_ = node_values();
      halo_.for_each_cell([&](const auto& nodes) {
        if (in_layers(nodes)) return;
        for (const NodeId node : nodes) {
          if (!mesh_.owns(node)) continue;
          for (const NodeId other : nodes)
            moments[node].add(halo_.point(other) - halo_.point(node), bases_[other] - bases_[node]);
        }
      });
      return moments;
    }
    add_cells(moments);
    return moments;
  }

  /// Same for cell values, which are relative to the value of the first cell at the node.
  void add_cells(OfNodes& moments) {
    std::vector<CellShape> shapes;
    halo_.for_each_cell([&](const auto& nodes) {
      std::array<Point, std::tuple_size_v<std::decay_t<decltype(nodes)>>> corners;
      for (std::size_t k = 0; k < nodes.size(); ++k) corners[k] = halo_.point(nodes[k]);
      shapes.push_back(shape_of(corners));
    });
    const std::vector<double> values = halo_.spread(comm_, field_.values);
    bases_.resize(mesh_.owned_nodes);
    NodeFlags met(mesh_.owned_nodes, 0);
    std::size_t cell = 0;
    halo_.for_each_cell([&](const auto& nodes) {
      const std::size_t at = cell++;
      if (in_layers(nodes)) return;
      for (const NodeId node : nodes) {
        if (!mesh_.owns(node)) continue;
        if (met[node] == 0) bases_[node] = values[at];
        met[node] = 1;
        const Point from_node = (halo_.point(nodes[0]) - halo_.point(node)) + shapes[at].from_first;
        moments[node].add(from_node, values[at] - bases_[node]);
      }
    });
    bases_.resize(halo_.points().size());
    halo_.exchange().update(bases_);
  }

  IdVector<NodeId, Hessian> outside_layers() {
    const OfNodes first = first_ring();
    // One centroid per cell: at corners of the domain two rings may contain only four cells.
    OfNodes all = at_ == ValuesAt::nodes
                      ? with_neighbours(first, first, 0x1p-12)
                      : with_neighbours(first, with_neighbours(first, first, 0x1p-6), 0x1p-6);
    const double rounding = 256 * field_.rounding;  // the fit increases it
    IdVector<NodeId, Hessian> found;
    for (const Moments& moments : all) found.push_back(absolute(moments.hessian(rounding)));
    return found;
  }

  /// Adds to `own`, with this weight, the moments in `around` of the nodes in the cells around each node.
  OfNodes with_neighbours(const OfNodes& own, OfNodes around, double weight) const {
    around.resize(halo_.points().size());
    halo_.exchange().update(around);
    OfNodes both = own;
    halo_.for_each_cell([&](const auto& nodes) {
      if (in_layers(nodes)) return;
      for (const NodeId node : nodes) {
        if (!mesh_.owns(node)) continue;
        for (const NodeId other : nodes) {
          if (other == node) continue;
          both[node].add(around[other], halo_.point(other) - halo_.point(node), bases_[other] - bases_[node],
                         weight);
        }
      }
    });
    return both;
  }

  /// The two neighbours of a node in its row.
  struct Row {
    std::array<NodeId, 2> neighbours;

    void add(NodeId node) {
      if (!neighbours[0].valid()) neighbours[0] = node;
      if (neighbours[0] != node) neighbours[1] = node;
    }
  };

  IdVector<NodeId, Hessian> along_rows() const {
    const IdVector<NodeId, double> values = node_values();
    IdVector<NodeId, Row> rows(mesh_.owned_nodes);
    const auto add = [&](NodeId node, NodeId other) {
      const LayerPlace &a = places_[node], &b = places_[other];
      if (mesh_.owns(node) && a.left == b.left && a.strip < 0 && b.strip < 0) rows[node].add(other);
    };
    halo_.for_each_cell([&](const auto& nodes) {
      if (!in_layers(nodes)) return;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        add(nodes[k], nodes[(k + 1) % nodes.size()]);
        add(nodes[(k + 1) % nodes.size()], nodes[k]);
      }
    });
    IdVector<NodeId, Hessian> found;
    for (std::int32_t i = 0; i < mesh_.owned_nodes; ++i) found.push_back(along_row(NodeId{i}, rows, values));
    return found;
  }

  /// Returns 0 at the ends of rows.
  Hessian along_row(NodeId node, const IdVector<NodeId, Row>& rows,
                    const IdVector<NodeId, double>& values) const {
    const auto [one, other] = rows[node].neighbours;
    if (!one.valid() || !other.valid()) return {};
    const double back = length(halo_.point(one) - halo_.point(node)),
                 ahead = length(halo_.point(other) - halo_.point(node)), whole = back + ahead;
    const double bend =
        2 * std::abs((values[one] - values[node]) / back + (values[other] - values[node]) / ahead) / whole;
    if (!(bend * whole * whole > 4 * field_.rounding)) return {};
    const Point chord = halo_.point(other) - halo_.point(one);
    const double square = dot(chord, chord);
    return bend / square * Hessian{chord.x * chord.x, chord.x * chord.y, chord.y * chord.y};
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const ScaledField& field_;
  ValuesAt at_;
  HaloMesh halo_;
  LayerPlaces places_;  ///< includes cells of other ranks; empty if there are no layers
  IdVector<NodeId, double> bases_;
};

}  // namespace

double largest_eigenvalue(const Hessian& h) {
  return std::abs(0.5 * (h.xx + h.yy)) + std::hypot(0.5 * (h.xx - h.yy), h.xy);
}

Hessian absolute(const Hessian& h) {
  const double mean = 0.5 * (h.xx + h.yy), spread = std::hypot(0.5 * (h.xx - h.yy), h.xy);
  if (mean >= spread) return h;
  if (-mean >= spread) return -1.0 * h;
  // Eigenvalues of opposite sign: mean + spread > 0 > mean - spread.
  const double slope = mean / spread, shift = (spread - mean) * (spread + mean) / spread;
  return {slope * h.xx + shift, slope * h.xy, slope * h.yy + shift};
}

double along(const Hessian& h, Point e) { return h.xx * e.x * e.x + 2 * h.xy * e.x * e.y + h.yy * e.y * e.y; }

std::vector<CellHessian> cell_hessians(const Communicator& comm, const Mesh& mesh, const ScaledField& field,
                                       ValuesAt at) {
  const std::size_t cells = mesh.cell_count();
  comm.together([&] {
    QUADLOOP_REQUIRE(field.values.size() == (at == ValuesAt::nodes ? mesh.points.size() : cells),
                     "there must be one value for each node or cell");
  });
  Recovery recovery(comm, mesh, field, at);
  const NodeHessians of_nodes = recovery.hessians();
  std::vector<CellHessian> of_cells;
  of_cells.reserve(cells);
  const auto add = [&](const auto& nodes) {
    const auto& rows = recovery.in_layers(nodes) ? of_nodes.in_layers : of_nodes.outside;
    Hessian sum;
    double largest = 0;
    for (const NodeId node : nodes) {
      sum = sum + rows[node];
      largest = std::max(largest, largest_eigenvalue(rows[node]));
    }
    of_cells.push_back({1.0 / static_cast<double>(nodes.size()) * sum, largest});
  };
  mesh.for_each_cell(add);
  return of_cells;
}

std::vector<Hessian> node_hessians(const Communicator& comm, const Mesh& mesh, const ScaledField& field) {
  const auto of_nodes = Recovery(comm, mesh, field, ValuesAt::nodes).hessians().outside;
  return {of_nodes.begin(), of_nodes.begin() + std::ssize(mesh.points)};
}

}  // namespace quadloop::adapt
