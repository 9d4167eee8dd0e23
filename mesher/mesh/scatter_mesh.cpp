#include "mesher/mesh/scatter_mesh.hpp"

#include <mpi.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>

#include "mesher/base/ids.hpp"
#include "mesher/mesh/part_builder.hpp"
#include "mesher/mesh/reorder_mesh.hpp"

namespace quadloop {

namespace {

template <std::size_t width>
using Cells = std::vector<std::array<NodeId, width>>;
template <std::size_t width>
using GlobalCells = std::vector<std::array<GlobalNodeId, width>>;

struct GlobalEdge {
  GlobalNodeId from, to;
  std::int32_t boundary;
};

std::vector<std::int32_t> numbers_to(std::size_t count) {
  std::vector<std::int32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Maps each node of the whole mesh to its position in the order.
using NodeNumbers = IdVector<NodeId, GlobalNodeId>;
NodeNumbers inverse_of(const std::vector<std::int32_t>& order) {
  NodeNumbers inverse(order.size());
  for (std::int64_t i = 0; const std::int32_t node : order) inverse[NodeId{node}] = GlobalNodeId{i++};
  return inverse;
}

MeshOrder narrowed(const PartOrder& order) {
  const auto narrow = [](const std::vector<std::int64_t>& numbers) {
    return std::vector<std::int32_t>(numbers.begin(), numbers.end());
  };
  return {narrow(order.nodes), narrow(order.triangles), narrow(order.quads)};
}

/// As scatter_evenly() of `count` rows, which the root creates piecewise by `make(i)`, as it also holds the
/// whole mesh. `begin(n)` receives the number of this rank's rows, `take(rows)` the rows piece by piece.
/// `count` is used on the root only. *Collective.*
template <class Make, class Begin, class Take>
void scatter_made(const Communicator& comm, std::size_t count, const Make& make, const Begin& begin,
                  const Take& take) {
  constexpr std::size_t rows_at_once = std::size_t{1} << 16;
  const std::size_t ranks = comm.size(), all = comm.maximum(static_cast<std::int64_t>(count));
  const auto begin_of = [&](std::size_t rank) { return all * rank / ranks; };
  const std::size_t piece = std::max<std::size_t>(1, rows_at_once / ranks), longest = all / ranks + 1;
  begin(begin_of(comm.rank() + 1) - begin_of(comm.rank()));
  for (std::size_t first = 0; first < longest; first += piece) {
    std::vector<decltype(make(std::size_t{0}))> rows;
    std::vector<std::int64_t> counts(ranks, 0);
    for (std::size_t rank = 0; comm.is_root() && rank < ranks; ++rank) {
      const std::size_t end = std::min(begin_of(rank + 1), begin_of(rank) + first + piece);
      for (std::size_t i = begin_of(rank) + first; i < end; ++i, ++counts[rank]) rows.push_back(make(i));
    }
    take(scatter_from_root(comm, rows, counts));
  }
}

std::vector<Point> scatter_points(const Communicator& comm, const Mesh& whole, const MeshOrder& order) {
  std::vector<Point> points;
  scatter_made(
      comm, order.nodes.size(), [&](std::size_t i) { return whole.points[order.nodes[i]]; },
      [&](std::size_t own) { points.reserve(own); },
      [&](const std::vector<Point>& some) { points.insert(points.end(), some.begin(), some.end()); });
  return points;
}

std::vector<GlobalEdge> scatter_edges(const Communicator& comm, const Mesh& whole,
                                      const NodeNumbers& numbers) {
  std::vector<GlobalEdge> edges;
  const std::int32_t boundaries = comm.is_root() ? size32(whole.boundaries) : 0;
  for (std::int32_t b = 0; b < boundaries; ++b) {
    for (const auto& [from, to] : whole.boundaries[b].edges) edges.push_back({numbers[from], numbers[to], b});
  }
  return scatter_evenly(comm, std::span<const GlobalEdge>(edges));
}

/// Broadcasts the root's boundaries, without their edges.
std::vector<BoundaryEdges> broadcast_boundaries(const Communicator& comm, const Mesh& whole) {
  std::vector<std::string> names;
  std::vector<BoundaryCondition> conditions;
  std::vector<WallLayers> layers;
  std::vector<char> between_blocks, inner_lines;
  for (const BoundaryEdges& boundary : whole.boundaries) {
    names.push_back(boundary.name);
    conditions.push_back(boundary.condition);
    layers.push_back(boundary.layers);
    between_blocks.push_back(boundary.between_blocks ? 1 : 0);
    inner_lines.push_back(boundary.inner_line ? 1 : 0);
  }
  names = broadcast_words(comm, names);
  comm.broadcast(conditions);
  comm.broadcast(layers);
  comm.broadcast(between_blocks);
  comm.broadcast(inner_lines);
  std::vector<BoundaryEdges> boundaries;
  for (std::size_t i = 0; i < layers.size(); ++i)
    boundaries.push_back(
        {names[i], conditions[i], {}, layers[i], between_blocks[i] != 0, inner_lines[i] != 0});
  return boundaries;
}

/// Broadcasts the root's strips; their nodes are renumbered by the order.
std::vector<StripLayers> broadcast_strips(const Communicator& comm, const Mesh& whole,
                                          const NodeNumbers& numbers) {
  struct Shape {
    WallLayers layers;
    std::int32_t across = 0;
    bool from_wall = false;
  };
  std::vector<std::string> names;
  std::vector<Shape> shapes;
  for (const StripLayers& strip : whole.strips) {
    names.push_back(strip.name);
    shapes.push_back({strip.layers, strip.across, strip.from_wall});
  }
  names = broadcast_words(comm, names);
  comm.broadcast(shapes);
  std::vector<StripLayers> strips;
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    StripLayers strip{names[s], shapes[s].layers, shapes[s].from_wall, shapes[s].across, {}};
    if (comm.is_root()) {
      for (const GlobalNodeId node : whole.strips[s].nodes)
        strip.nodes.push_back(numbers[NodeId{static_cast<std::int32_t>(node.value())}]);
    }
    comm.broadcast(strip.nodes);
    strips.push_back(std::move(strip));
  }
  return strips;
}

/// Broadcasts the root's named nodes, renumbered by the order.
std::vector<NamedNode> broadcast_named_nodes(const Communicator& comm, const Mesh& whole,
                                             const NodeNumbers& numbers) {
  std::vector<std::string> names;
  std::vector<GlobalNodeId> nodes;
  for (const NamedNode& named : whole.named_nodes) {
    names.push_back(named.name);
    nodes.push_back(numbers[NodeId{static_cast<std::int32_t>(named.node.value())}]);
  }
  names = broadcast_words(comm, names);
  comm.broadcast(nodes);
  std::vector<NamedNode> result;
  for (std::size_t i = 0; i < nodes.size(); ++i) result.push_back({names[i], nodes[i]});
  return result;
}

/// Broadcasts the root's pairs.
std::vector<PeriodicPair> broadcast_pairs(const Communicator& comm, const Mesh& whole) {
  struct Map {
    Point translation, centre;
    double degrees = 0;
  };
  std::vector<std::string> names;
  std::vector<Map> maps;
  for (const PeriodicPair& pair : whole.pairs) {
    names.push_back(pair.from);
    names.push_back(pair.to);
    maps.push_back({pair.translation, pair.centre, pair.degrees});
  }
  names = broadcast_words(comm, names);
  comm.broadcast(maps);
  std::vector<PeriodicPair> pairs;
  for (std::size_t p = 0; p < maps.size(); ++p)
    pairs.push_back({names[2 * p], names[2 * p + 1], maps[p].translation, maps[p].degrees, maps[p].centre});
  return pairs;
}

/// Receives the rank's part of the root's cells. *Collective.*
template <std::size_t width>
void scatter_cells(const Communicator& comm, const Cells<width>& cells,
                   const std::vector<std::int32_t>& order, const NodeNumbers& numbers, PartBuilder& builder,
                   Cells<width>& to) {
  const auto make = [&](std::size_t i) {
    std::array<GlobalNodeId, width> nodes;
    for (std::size_t k = 0; k < width; ++k) nodes[k] = numbers[cells[order[i]][k]];
    return nodes;
  };
  scatter_made(
      comm, order.size(), make, [&](std::size_t own) { to.reserve(own); },
      [&](const GlobalCells<width>& some) {
        builder.append(std::span<const std::array<GlobalNodeId, width>>(some), to);
      });
}

/// Gathers all cells on the root, with global node numbers. *Collective.*
template <std::size_t width>
GlobalCells<width> gather_cells(const Communicator& comm, const Mesh& part, const Cells<width>& cells) {
  GlobalCells<width> named;
  for (const auto& nodes : cells) {
    std::array<GlobalNodeId, width> numbers;
    for (std::size_t k = 0; k < width; ++k) numbers[k] = part.global(nodes[k]);
    named.push_back(numbers);
  }
  return gather_at_root(comm, named);
}

template <std::size_t width>
void put_cells(const GlobalCells<width>& cells, const MeshOrder& order,
               const std::vector<std::int32_t>& cell_order, Cells<width>& whole) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t k = 0; k < width; ++k) {
      whole[cell_order[i]][k] = NodeId{order.nodes[cells[i][k].value()]};
    }
  }
}

template <std::size_t width>
Cells<width> whole_cells(const GlobalCells<width>& cells) {
  Cells<width> whole(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t k = 0; k < width; ++k)
      whole[i][k] = NodeId{static_cast<std::int32_t>(cells[i][k].value())};
  }
  return whole;
}

std::vector<Point> gather_points(const Communicator& comm, const Mesh& part) {
  return gather_at_root(comm, std::span(part.points).first(part.owned_nodes));
}

/// Distributes rows of `width` values of the whole mesh on the root, in the given order, `count` of them to
/// this rank. *Collective.*
std::vector<double> scatter_rows(const Communicator& comm, std::span<const double> of_whole,
                                 std::size_t width, std::span<const std::int32_t> order, std::size_t count) {
  const std::vector<std::int64_t> counts = comm.all_gather(static_cast<std::int64_t>(count * width));
  std::vector<double> rows;
  for (std::size_t i = 0; !of_whole.empty() && i < order.size(); ++i) {
    const auto row = of_whole.subspan(order[i] * width, width);
    rows.insert(rows.end(), row.begin(), row.end());
  }
  return scatter_from_root(comm, rows, counts);
}

/// Inverse of scatter_rows(). *Collective.*
std::vector<double> gather_rows(const Communicator& comm, std::span<const double> rows, std::size_t width,
                                std::span<const std::int32_t> order) {
  const std::vector<double> by_rank = gather_at_root(comm, rows);
  std::vector<double> whole(by_rank.size());
  for (std::size_t i = 0; i < order.size() && comm.is_root(); ++i)
    std::copy_n(by_rank.begin() + i * width, width, whole.begin() + order[i] * width);
  return whole;
}

/// Returns the rows of the triangles, and those of the quads after them.
template <class Values>
std::array<std::span<Values>, 2> by_kind(std::span<Values> rows, std::size_t triangles, std::size_t width) {
  const std::size_t middle = std::min(triangles * width, rows.size());
  return {rows.first(middle), rows.subspan(middle)};
}

}  // namespace

MeshOrder space_filling_order(const Mesh& whole) {
  return narrowed(space_filling_order(Communicator(MPI_COMM_SELF), whole));
}

MeshOrder order_for_parts(const Mesh& whole) {
  return narrowed(order_for_parts(Communicator(MPI_COMM_SELF), whole));
}

MeshOrder own_order(const Mesh& whole) {
  return {numbers_to(whole.points.size()), numbers_to(whole.triangles.size()),
          numbers_to(whole.quads.size())};
}

Mesh scatter_mesh(const Communicator& comm, const Mesh& whole, const MeshOrder& order) {
  const NodeNumbers numbers = inverse_of(order.nodes);
  PartBuilder builder(comm, scatter_points(comm, whole, order));
  scatter_cells(comm, whole.triangles, order.triangles, numbers, builder, builder.part().triangles);
  scatter_cells(comm, whole.quads, order.quads, numbers, builder, builder.part().quads);
  builder.part().boundaries = broadcast_boundaries(comm, whole);
  for (const GlobalEdge& e : scatter_edges(comm, whole, numbers))
    builder.part().boundaries[e.boundary].edges.push_back(builder.local(std::array{e.from, e.to}));
  builder.part().strips = broadcast_strips(comm, whole, numbers);
  builder.part().pairs = broadcast_pairs(comm, whole);
  builder.part().named_nodes = broadcast_named_nodes(comm, whole, numbers);
  return builder.finish(comm);
}

Field scatter_field(const Communicator& comm, const Field& of_whole, const Mesh& part,
                    const MeshOrder& order) {
  Field field{broadcast_words(comm, of_whole.names), {}, of_whole.constants};
  comm.broadcast(field.constants);
  field.values = scatter_rows(comm, of_whole.values, field.width(), order.nodes, part.owned_nodes);
  field.cells.names = broadcast_words(comm, of_whole.cells.names);
  const std::size_t width = field.cells.width();
  if (width == 0) return field;
  const auto [triangles, quads] = by_kind(std::span(of_whole.cells.values), order.triangles.size(), width);
  field.cells.values = scatter_rows(comm, triangles, width, order.triangles, part.triangles.size());
  const std::vector<double> of_quads = scatter_rows(comm, quads, width, order.quads, part.quads.size());
  field.cells.values.insert(field.cells.values.end(), of_quads.begin(), of_quads.end());
  return field;
}

Field gather_field(const Communicator& comm, const Field& field, const Mesh& part, const MeshOrder& order) {
  Field whole{field.names, {}, field.constants, {field.cells.names, {}}};
  whole.values = gather_rows(comm, field.values, field.width(), order.nodes);
  const std::size_t width = field.cells.width();
  if (width == 0) return whole;
  const auto [triangles, quads] = by_kind(std::span(field.cells.values), part.triangles.size(), width);
  whole.cells.values = gather_rows(comm, triangles, width, order.triangles);
  const std::vector<double> of_quads = gather_rows(comm, quads, width, order.quads);
  whole.cells.values.insert(whole.cells.values.end(), of_quads.begin(), of_quads.end());
  return whole;
}

void gather_mesh(const Communicator& comm, const Mesh& part, const MeshOrder& order, Mesh& whole) {
  const std::vector<Point> points = gather_points(comm, part);
  for (std::size_t i = 0; i < points.size(); ++i) whole.points[order.nodes[i]] = points[i];
  put_cells(gather_cells(comm, part, part.triangles), order, order.triangles, whole.triangles);
  put_cells(gather_cells(comm, part, part.quads), order, order.quads, whole.quads);
}

Mesh gather_whole(const Communicator& comm, const Mesh& part) {
  Mesh whole;
  whole.points = gather_points(comm, part);
  whole.owned_nodes = size32(whole.points);
  whole.triangles = whole_cells(gather_cells(comm, part, part.triangles));
  whole.quads = whole_cells(gather_cells(comm, part, part.quads));
  for (const BoundaryEdges& boundary : part.boundaries) {
    const auto edges = gather_cells(comm, part, boundary.edges);
    whole.boundaries.push_back({boundary.name, boundary.condition, whole_cells(edges), boundary.layers,
                                boundary.between_blocks, boundary.inner_line});
  }
  whole.strips = part.strips;
  whole.blocks = {part.blocks.names, gather_at_root(comm, part.blocks.of_triangles),
                  gather_at_root(comm, part.blocks.of_quads)};
  whole.pairs = part.pairs;
  whole.named_nodes = part.named_nodes;
  return whole;
}

Mesh gather_boundaries(const Communicator& comm, const Mesh& part) {
  struct End {
    GlobalNodeId node;
    Point place;
  };
  using Ends = std::array<End, 2>;
  std::vector<std::vector<Ends>> edges;
  Mesh whole;
  for (const BoundaryEdges& boundary : part.boundaries) {
    std::vector<Ends> own;
    for (const auto& [from, to] : boundary.edges)
      own.push_back({End{part.global(from), part.point(from)}, End{part.global(to), part.point(to)}});
    edges.push_back(gather_at_root(comm, own));
    whole.boundaries.push_back(boundary);
    whole.boundaries.back().edges.clear();
  }
  std::map<GlobalNodeId, Point> nodes;
  for (const std::vector<Ends>& of_boundary : edges) {
    for (const Ends& ends : of_boundary) {
      for (const End& end : ends) nodes.emplace(end.node, end.place);
    }
  }
  std::unordered_map<GlobalNodeId, NodeId> numbers;
  for (const auto& [node, place] : nodes) {
    numbers.emplace(node, NodeId{size32(whole.points)});
    whole.points.push_back(place);
  }
  whole.owned_nodes = size32(whole.points);
  for (std::size_t b = 0; b < edges.size(); ++b) {
    for (const Ends& ends : edges[b])
      whole.boundaries[b].edges.push_back({numbers.at(ends[0].node), numbers.at(ends[1].node)});
  }
  return whole;
}

}  // namespace quadloop
