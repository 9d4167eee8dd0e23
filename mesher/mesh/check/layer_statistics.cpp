#include "mesher/mesh/check/layer_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/base/parallel/kth_smallest.hpp"
#include "mesher/mesh/layers/layered_edges.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/part_names.hpp"

namespace quadloop {

namespace {

/// Of the values of all ranks. *Collective.*
Spread spread_of(const Communicator& comm, std::vector<double> values) {
  const std::int64_t count = comm.sum(std::ssize(values));
  if (count == 0) return {};
  double least = std::numeric_limits<double>::infinity(), largest = -least;
  for (const double value : values) {
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
  return {comm.minimum(least), kth_smallest(comm, values, count / 2 + 1), comm.maximum(largest)};
}

/// A value of the column that begins at a wall node.
struct ColumnValue {
  GlobalNodeId foot;
  double value;
};

/// Values of the columns of one boundary or strip on this rank.
struct LayerTally {
  std::int64_t columns = 0;
  std::vector<GlobalNodeId>
      cut;  ///< columns at the border of a partition, where their continuation is missing
  std::vector<double> first, thickness;
  std::vector<ColumnValue> growth;

  /// *Collective.*
  LayerStatistics over(const Communicator& comm, const std::string& name, const WallLayers& layers) {
    std::vector<GlobalNodeId> all_cut = comm.all_gather_values(std::span<const GlobalNodeId>(cut));
    std::ranges::sort(all_cut);
    std::vector<double> ratios;
    for (const ColumnValue& ratio : std::exchange(growth, {})) {
      if (!std::ranges::binary_search(all_cut, ratio.foot)) ratios.push_back(ratio.value);
    }
    return {name,
            layers.count,
            comm.sum(columns),
            std::ssize(all_cut),
            spread_of(comm, std::move(first)),
            spread_of(comm, std::move(ratios)),
            spread_of(comm, std::move(thickness)),
            layers.thickness};
  }
};

/// An edge of the wall at one of this rank's nodes.
struct FootEdge {
  GlobalNodeId foot;
  Point from, to;

  Point direction() const {
    const Point along = to - from;
    return (1 / length(along)) * along;
  }
};

/// Returns the wall edges with layers at this rank's nodes, sorted by node. *Collective.*
std::vector<FootEdge> foot_edges(const Communicator& comm, const Mesh& mesh, const NodeOwners& owners) {
  Outbox<FootEdge> out;
  for (const LayeredEdge& edge : layered_edges(comm, mesh)) {
    for (const NodeId node : edge.nodes)
      out.add(owners.rank_of(mesh.global(node)),
              {mesh.global(node), mesh.point(edge.nodes[0]), mesh.point(edge.nodes[1])});
  }
  std::vector<FootEdge> edges = out.deliver(comm);
  std::ranges::stable_sort(edges, {}, &FootEdge::foot);
  return edges;
}

/// Height of a point above the wall; above a sharp edge its distance.
double height_above(std::span<const FootEdge> edges, Point foot, Point p) {
  constexpr double sharp = -0.5;  // columns of a fan start where the wall turns by more than 120 degrees
  const Point way = p - foot;
  if (edges.empty()) return length(way);
  double most = 0;
  for (const FootEdge& edge : edges) most = std::max(most, std::abs(cross(edge.direction(), way)));
  const bool is_edge = edges.size() > 1 && dot(edges[0].direction(), edges[1].direction()) < sharp;
  return is_edge ? length(way) : most;
}

/// For each of this rank's nodes those that are one layer farther from the wall, in the order of the cells.
class NodesAbove {
 public:
  /// `places` are those of all nodes of the HaloMesh.
  NodesAbove(const HaloMesh& halo, const LayerPlaces& places)
      : halo_{halo}, places_{places}, starts_(halo.owned_nodes() + std::size_t{2}, 0) {
    for_each([&](NodeId low, NodeId) { ++starts_[low.value() + std::size_t{2}]; });
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    nodes_.resize(starts_.back());
    for_each([&](NodeId low, NodeId high) { nodes_[starts_[low.value() + std::size_t{1}]++] = high; });
  }

  std::span<const NodeId> of(NodeId node) const {
    const std::size_t at = node.value();
    return std::span(nodes_).subspan(starts_[at], starts_[at + 1] - starts_[at]);
  }

 private:
  bool is_above(NodeId low, NodeId high) const {
    return halo_.owns(low) && places_[low].valid() && places_[high].valid() &&
           places_[high].boundary == places_[low].boundary && places_[high].left == places_[low].left - 1;
  }

  template <class Visit>
  void for_each(const Visit& visit) const {
    halo_.for_each_cell([&](const auto& nodes) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const NodeId a = nodes[k], b = nodes[(k + 1) % nodes.size()];
        if (is_above(a, b)) visit(a, b);
        if (is_above(b, a)) visit(b, a);
      }
    });
  }

  const HaloMesh& halo_;
  const LayerPlaces& places_;
  std::vector<std::int64_t> starts_;
  std::vector<NodeId> nodes_;
};

/// A column that has been followed up to a node.
struct Column {
  GlobalNodeId foot, at;
  std::int32_t boundary = -1;
  std::int32_t edges = 0;        ///< followed so far
  Point before = {};             ///< node before `at`
  double first = 0, height = 0;  ///< of the first edge, normal to the wall; of the last edge
  double thickness = 0;
};

/// Follows the columns of walls over all ranks.
class WallColumns {
 public:
  /// *Collective.*
  WallColumns(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo, const LayerPlaces& places)
      : comm_{comm},
        mesh_{mesh},
        halo_{halo},
        places_{spread_places(halo, places)},
        owners_(comm, mesh.first_node),
        above_(halo, places_),
        feet_{foot_edges(comm, mesh, owners_)},
        at_border_{border_of_part()},
        tallies_(mesh.boundaries.size()) {}

  /// Returns the tally of each boundary. *Collective.*
  std::vector<LayerTally> tallies() {
    std::vector<Column> columns;
    for (std::int32_t i = 0; i < mesh_.owned_nodes; ++i) {
      const LayerPlace& place = places_[NodeId{i}];
      if (place.strip >= 0 || !on_layered_wall(mesh_, place)) continue;
      const GlobalNodeId foot = mesh_.global(NodeId{i});
      columns.push_back({.foot = foot, .at = foot, .boundary = place.boundary});
    }
    while (comm_.any(!columns.empty())) {
      Outbox<Column> out;
      for (Column& column : columns) {
        while (owners_.rank_of(column.at) == comm_.rank() && follow(column)) {
        }
        if (const int rank = owners_.rank_of(column.at); rank != comm_.rank()) out.add(rank, column);
      }
      columns = out.deliver(comm_);
    }
    return std::move(tallies_);
  }

 private:
  static LayerPlaces spread_places(const HaloMesh& halo, LayerPlaces places) {
    places.resize(halo.points().size());
    halo.exchange().update(places);
    return places;
  }

  /// Flags this rank's nodes on edges between partitions. *Collective.*
  NodeFlags border_of_part() const {
    NodeFlags at_border(mesh_.points.size(), 0);
    std::vector<GlobalNodeId> nodes;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      if (!is_part_name(boundary.name)) continue;
      for (const auto& edge : boundary.edges) {
        for (const NodeId node : edge) nodes.push_back(mesh_.global(node));
      }
    }
    flag_at_owners(comm_, owners_, nodes, at_border);
    return at_border;
  }

  /// Goes one edge on from one of this rank's nodes; false, and the column is counted, if it ends there.
  bool follow(Column& column) {
    const NodeId node = owners_.local(column.at);
    LayerTally& tally = tallies_[column.boundary];
    if (at_border_[node] != 0) {
      tally.cut.push_back(column.foot);
      return false;
    }
    const std::span<const NodeId> next = above_.of(node);
    if (next.empty()) {
      ++tally.columns;
      if (column.edges > 0) tally.first.push_back(column.first);
      // the layers may continue in a strip, as those on a blunt base where a wake begins
      if (places_[node].left <= 0) tally.thickness.push_back(column.thickness);
      return false;
    }
    go_to(column.edges == 0 ? nearest(node, next) : straightest(column, node, next), node, column, tally);
    return true;
  }

  void go_to(NodeId next, NodeId node, Column& column, LayerTally& tally) const {
    const Point from = halo_.point(node), to = halo_.point(next);
    const double height = length(to - from);
    if (column.edges == 0)
      column.first =
          height_above(std::ranges::equal_range(feet_, column.foot, {}, &FootEdge::foot), from, to);
    else
      tally.growth.push_back({column.foot, height / column.height});
    column.thickness += column.height = height;
    column.before = from;
    column.at = halo_.global(next);
    ++column.edges;
  }

  NodeId nearest(NodeId node, std::span<const NodeId> among) const {
    return *std::ranges::min_element(
        among, {}, [&](NodeId other) { return length(halo_.point(other) - halo_.point(node)); });
  }
  NodeId straightest(const Column& column, NodeId node, std::span<const NodeId> among) const {
    const Point here = halo_.point(node), before = here - column.before;
    return *std::ranges::max_element(among, {}, [&](NodeId other) {
      const Point on = halo_.point(other) - here;
      return dot(on, before) / length(on);
    });
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const HaloMesh& halo_;
  LayerPlaces places_;
  NodeOwners owners_;
  NodesAbove above_;
  std::vector<FootEdge> feet_;
  NodeFlags at_border_;
  std::vector<LayerTally> tallies_;
};

/// The columns of one strip, on both sides of its line.
class StripColumns {
 public:
  /// `points` are the positions of the strip's nodes.
  StripColumns(const StripLayers& strip, const std::vector<Point>& points) : strip_{strip}, points_{points} {}

  LayerTally tally() const {
    LayerTally tally;
    for (std::int32_t column = 0; column < strip_.columns(); ++column) {
      ++tally.columns;
      add_side(column, strip_.layers.count, -1, tally);
      add_side(column, strip_.across - 1 - strip_.layers.count, 1, tally);
    }
    return tally;
  }

 private:
  Point at(std::int32_t column, std::int32_t row) const {
    return points_[static_cast<std::size_t>(column) * strip_.across + row];
  }

  /// Adds the layers from one row outwards.
  void add_side(std::int32_t column, std::int32_t foot, std::int32_t step, LayerTally& tally) const {
    double whole = 0, before = 0;
    for (std::int32_t layer = 1; layer <= strip_.layers.count; ++layer) {
      const Point low = at(column, foot + step * (layer - 1)), high = at(column, foot + step * layer);
      const double height = length(high - low);
      if (layer == 1)
        tally.first.push_back(distance_from_line(column, foot, high));
      else
        tally.growth.push_back({strip_.node(column, foot), height / before});
      whole += before = height;
    }
    tally.thickness.push_back(whole);
  }

  /// Distance from the row's edges on both sides of the column.
  double distance_from_line(std::int32_t column, std::int32_t row, Point p) const {
    const Point foot = at(column, row);
    double most = 0;
    for (const std::int32_t other : {column - 1, column + 1}) {
      if (other < 0 || other >= strip_.columns()) continue;
      const Point along = at(other, row) - foot;
      most = std::max(most, std::abs(cross(along, p - foot)) / length(along));
    }
    return most;
  }

  const StripLayers& strip_;
  const std::vector<Point>& points_;
};

/// Returns the tally of a strip's columns on the root, which gets the positions of its nodes; empty
/// elsewhere. *Collective.*
LayerTally tally_of_strip(const Communicator& comm, const Mesh& mesh, const StripLayers& strip) {
  struct Placed {
    std::int64_t index;
    Point place;
  };
  std::vector<Placed> own;
  for (std::int64_t index = 0; const GlobalNodeId node : strip.nodes) {
    const std::int64_t local = node.value() - mesh.first_node;
    if (local >= 0 && local < mesh.owned_nodes) own.push_back({index, mesh.points[local]});
    ++index;
  }
  const std::vector<Placed> all = gather_at_root(comm, own);
  if (!comm.is_root()) return {};
  std::vector<Point> points(strip.nodes.size());
  for (const Placed& placed : all) points[placed.index] = placed.place;
  return StripColumns(strip, points).tally();
}

/// Returns the mesh with only the cells for which `takes` is true.
template <class Takes>
Mesh with_cells(const Mesh& mesh, const Takes& takes) {
  Mesh part;
  part.points = mesh.points;
  part.owned_nodes = mesh.owned_nodes;
  std::ranges::copy_if(mesh.triangles, std::back_inserter(part.triangles), takes);
  std::ranges::copy_if(mesh.quads, std::back_inserter(part.quads), takes);
  return part;
}

}  // namespace

std::vector<LayerStatistics> layer_statistics(const Communicator& comm, const Mesh& mesh,
                                              const HaloMesh& halo, const LayerPlaces& places) {
  if (!has_layers(mesh)) return {};
  std::vector<LayerTally> tallies = WallColumns(comm, mesh, halo, places).tallies();
  std::vector<LayerStatistics> statistics;
  for (std::size_t b = 0; b < tallies.size(); ++b) {
    const BoundaryEdges& boundary = mesh.boundaries[b];
    if (boundary.layers.count == 0) continue;
    const LayerStatistics found = tallies[b].over(comm, boundary.name, boundary.layers);
    if (found.columns + found.cut_columns > 0) statistics.push_back(found);  // else the base of a wake
  }
  for (const StripLayers& strip : mesh.strips)
    statistics.push_back(tally_of_strip(comm, mesh, strip).over(comm, strip.name, strip.layers));
  return statistics;
}

QualityByLayers quality_by_layers(const Communicator& comm, const Mesh& mesh, const LayerPlaces& places) {
  const auto in_layers = [&](const auto& nodes) { return is_layer_cell(places, nodes); };
  const auto outside = [&](const auto& nodes) { return !is_layer_cell(places, nodes); };
  return {summarise_quality(comm, with_cells(mesh, in_layers)),
          summarise_quality(comm, with_cells(mesh, outside))};
}

}  // namespace quadloop
