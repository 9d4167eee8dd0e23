#include "mesher/mesh/check/layer_statistics.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "mesher/mesh/layers/layered_edges.hpp"
#include "mesher/mesh/part_names.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  return {values.front(), values[values.size() / 2], values.back()};
}

class Columns {
 public:
  Columns(const Mesh& mesh, const LayerPlaces& places) : mesh_{mesh}, places_{places} {
    for_each_cell_edge(mesh, [&](NodeId a, NodeId b, std::int32_t) {
      if (is_above(a, b)) above_[a].push_back(b);
      if (is_above(b, a)) above_[b].push_back(a);
    });
    for (const LayeredEdge& edge : layered_edges(Communicator(MPI_COMM_SELF), mesh)) {
      for (const NodeId node : edge.nodes) edges_at_[node].push_back(edge.nodes);
    }
  }

  /// Returns the nodes of the column, from the wall node on.
  std::vector<NodeId> from(NodeId foot) const {
    std::vector<NodeId> nodes{foot};
    for (const std::vector<NodeId>* next = above(foot); next != nullptr; next = above(nodes.back()))
      nodes.push_back(nodes.size() == 1 ? nearest(foot, *next) : straightest(nodes, *next));
    return nodes;
  }

  /// Whether the layers continue in a strip, as those on a blunt base where a wake begins.
  bool ends_in_strip(const std::vector<NodeId>& column) const { return places_[column.back()].left > 0; }

  /// Height of a node above the wall; above a sharp edge its distance.
  double height(NodeId foot, NodeId node) const {
    constexpr double sharp = -0.5;  // columns of a fan start where the wall turns by more than 120 degrees
    const auto edges = edges_at_.find(foot);
    const Point way = mesh_.point(node) - mesh_.point(foot);
    if (edges == edges_at_.end()) return length(way);
    double most = 0;
    for (const auto& edge : edges->second) most = std::max(most, std::abs(cross(direction(edge), way)));
    const bool is_edge =
        edges->second.size() > 1 && dot(direction(edges->second[0]), direction(edges->second[1])) < sharp;
    return is_edge ? length(way) : most;
  }

 private:
  bool is_above(NodeId low, NodeId high) const {
    return places_[low].valid() && places_[high].valid() && places_[high].boundary == places_[low].boundary &&
           places_[high].left == places_[low].left - 1;
  }
  const std::vector<NodeId>* above(NodeId node) const {
    const auto found = above_.find(node);
    return found == above_.end() ? nullptr : &found->second;
  }
  Point direction(const std::array<NodeId, 2>& edge) const {
    const Point along = mesh_.point(edge[1]) - mesh_.point(edge[0]);
    return (1 / length(along)) * along;
  }
  NodeId nearest(NodeId node, const std::vector<NodeId>& among) const {
    return *std::ranges::min_element(
        among, {}, [&](NodeId other) { return length(mesh_.point(other) - mesh_.point(node)); });
  }
  NodeId straightest(const std::vector<NodeId>& column, const std::vector<NodeId>& among) const {
    const Point here = mesh_.point(column.back());
    const Point before = here - mesh_.point(column[column.size() - 2]);
    return *std::ranges::max_element(among, {}, [&](NodeId other) {
      const Point on = mesh_.point(other) - here;
      return dot(on, before) / length(on);
    });
  }

  const Mesh& mesh_;
  const LayerPlaces& places_;
  std::unordered_map<NodeId, std::vector<NodeId>> above_;
  std::unordered_map<NodeId, std::vector<std::array<NodeId, 2>>> edges_at_;
};

/// Sums over the columns of one boundary.
struct LayerTally {
  std::int64_t columns = 0, cut = 0;
  std::vector<double> first, growth, thickness;

  /// Adds a column, unless one of its nodes lies on the border of a partition, where its continuation is
  /// missing.
  void add(const Mesh& mesh, const Columns& columns_of, NodeId foot, const NodeFlags& at_border) {
    const std::vector<NodeId> column = columns_of.from(foot);
    if (std::ranges::any_of(column, [&](NodeId node) { return at_border[node] != 0; })) {
      ++cut;
      return;
    }
    ++columns;
    double whole = 0, before = 0;
    for (std::size_t k = 1; k < column.size(); ++k) {
      const double height = length(mesh.point(column[k]) - mesh.point(column[k - 1]));
      if (k > 1) growth.push_back(height / before);
      whole += before = height;
    }
    if (column.size() > 1) first.push_back(columns_of.height(foot, column[1]));
    if (!columns_of.ends_in_strip(column)) thickness.push_back(whole);
  }
};

/// The columns of one strip, on both sides of its line.
class StripColumns {
 public:
  StripColumns(const Mesh& whole, const StripLayers& strip) : mesh_{whole}, strip_{strip} {}

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
    return mesh_.points[strip_.node(column, row).value()];
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
        tally.growth.push_back(height / before);
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

  const Mesh& mesh_;
  const StripLayers& strip_;
};

LayerStatistics statistics_of(const std::string& name, const WallLayers& layers, LayerTally tally) {
  return {name,
          layers.count,
          tally.columns,
          tally.cut,
          spread_of(std::move(tally.first)),
          spread_of(std::move(tally.growth)),
          spread_of(std::move(tally.thickness)),
          layers.thickness};
}

/// Flags the nodes on edges between partitions.
NodeFlags border_of_part(const Mesh& mesh) {
  NodeFlags at_border(mesh.points.size(), 0);
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (!is_part_name(boundary.name)) continue;
    for (const auto& edge : boundary.edges) {
      for (const NodeId node : edge) at_border[node] = 1;
    }
  }
  return at_border;
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

std::vector<LayerStatistics> layer_statistics(const Mesh& whole, const LayerPlaces& places) {
  if (!has_layers(whole)) return {};
  const Columns columns(whole, places);
  const NodeFlags at_border = border_of_part(whole);
  std::vector<LayerTally> tallies(whole.boundaries.size());
  for (const NodeId node : places.ids()) {
    if (places[node].strip < 0 && on_layered_wall(whole, places[node]))
      tallies[places[node].boundary].add(whole, columns, node, at_border);
  }
  std::vector<LayerStatistics> statistics;
  for (std::size_t b = 0; b < tallies.size(); ++b) {
    const BoundaryEdges& boundary = whole.boundaries[b];
    // no layers, or none of its own: the base of a wake
    if (tallies[b].columns + tallies[b].cut == 0) continue;
    statistics.push_back(statistics_of(boundary.name, boundary.layers, std::move(tallies[b])));
  }
  for (const StripLayers& strip : whole.strips)
    statistics.push_back(statistics_of(strip.name, strip.layers, StripColumns(whole, strip).tally()));
  return statistics;
}

QualityByLayers quality_by_layers(const Communicator& comm, const Mesh& mesh, const LayerPlaces& places) {
  const auto in_layers = [&](const auto& nodes) { return is_layer_cell(places, nodes); };
  const auto outside = [&](const auto& nodes) { return !is_layer_cell(places, nodes); };
  return {summarise_quality(comm, with_cells(mesh, in_layers)),
          summarise_quality(comm, with_cells(mesh, outside))};
}

}  // namespace quadloop
