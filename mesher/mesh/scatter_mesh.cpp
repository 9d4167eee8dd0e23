#include "mesher/mesh/scatter_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "mesher/base/ids.hpp"
#include "mesher/base/morton.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/node_table.hpp"

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

/// Morton keys of the nodes, in their bounding box.
std::vector<std::uint64_t> curve_keys(const Mesh& mesh) {
  Box box;
  for (const Point p : mesh.points) box.include(p);
  const double side = std::max(box.width(), box.height());
  constexpr double steps = (std::uint64_t{1} << 31) - 1;
  const auto step = [&](double at, double low) {
    return static_cast<std::uint32_t>(side > 0 ? (at - low) / side * steps : 0);
  };
  std::vector<std::uint64_t> keys;
  keys.reserve(mesh.points.size());
  for (const Point p : mesh.points) keys.push_back(morton_key(step(p.x, box.low.x), step(p.y, box.low.y)));
  return keys;
}

std::vector<std::int32_t> numbers_to(std::size_t count) {
  std::vector<std::int32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Returns the indices in the order of their keys; the sort is stable.
template <class Key>
std::vector<std::int32_t> ordered_by(const std::vector<Key>& keys) {
  std::vector<std::int32_t> order = numbers_to(keys.size());
  std::stable_sort(order.begin(), order.end(),
                   [&](std::int32_t a, std::int32_t b) { return keys[a] < keys[b]; });
  return order;
}

/// Maps each node of the whole mesh to its position in the order.
using NodeNumbers = IdVector<NodeId, GlobalNodeId>;
NodeNumbers inverse_of(const std::vector<std::int32_t>& order) {
  NodeNumbers inverse(order.size());
  for (std::int64_t i = 0; const std::int32_t node : order) inverse[NodeId{node}] = GlobalNodeId{i++};
  return inverse;
}

template <std::size_t width>
std::vector<std::int32_t> ordered_cells(const Cells<width>& cells, const NodeNumbers& numbers) {
  std::vector<GlobalNodeId> first;
  for (const auto& nodes : cells) {
    GlobalNodeId least = numbers[nodes[0]];
    for (const NodeId node : nodes) least = std::min(least, numbers[node]);
    first.push_back(least);
  }
  return ordered_by(first);
}

/// Measures how far apart the node numbers of cells are, as a sum of powers of two: small if neighbours have
/// close numbers.
template <std::size_t width>
std::int64_t spread(const Cells<width>& cells, const NodeNumbers& numbers) {
  std::int64_t sum = 0;
  for (const auto& nodes : cells) {
    GlobalNodeId least = numbers[nodes[0]], largest = least;
    for (const NodeId node : nodes) {
      least = std::min(least, numbers[node]);
      largest = std::max(largest, numbers[node]);
    }
    sum += std::bit_width(static_cast<std::uint64_t>(largest.value() - least.value()));
  }
  return sum;
}

std::int64_t spread(const Mesh& mesh, const NodeNumbers& numbers) {
  return spread(mesh.triangles, numbers) + spread(mesh.quads, numbers);
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

/// Builds a rank's part from its nodes and from cells with global node numbers.
class PartBuilder {
 public:
  PartBuilder(const Communicator& comm, std::vector<Point> points)
      : part_{part_of(comm, std::move(points))}, nodes_{part_} {}

  /// Receives the rank's part of the root's cells. *Collective.*
  template <std::size_t width>
  void scatter_cells(const Communicator& comm, const Cells<width>& cells,
                     const std::vector<std::int32_t>& order, const NodeNumbers& numbers, Cells<width>& to) {
    const auto make = [&](std::size_t i) {
      std::array<GlobalNodeId, width> nodes;
      for (std::size_t k = 0; k < width; ++k) nodes[k] = numbers[cells[order[i]][k]];
      return nodes;
    };
    const auto take = [&](const GlobalCells<width>& some) {
      for (const auto& cell : some) {
        std::array<NodeId, width> nodes;
        for (std::size_t k = 0; k < width; ++k) nodes[k] = local(cell[k]);
        to.push_back(nodes);
      }
    };
    scatter_made(
        comm, order.size(), make, [&](std::size_t own) { to.reserve(own); }, take);
  }
  void add_edges(const std::vector<GlobalEdge>& edges) {
    for (const GlobalEdge& e : edges)
      part_.boundaries[e.boundary].edges.push_back({local(e.from), local(e.to)});
  }
  Mesh& part() { return part_; }

  /// Fetches the positions of the ghosts. *Collective.*
  Mesh finish(const Communicator& comm) {
    const NodeOwners owners(comm, part_.first_node);
    NodeExchange(comm, owners, part_.owned_nodes, part_.ghosts).update(part_.points);
    return std::move(part_);
  }

 private:
  static Mesh part_of(const Communicator& comm, std::vector<Point> points) {
    Mesh part;
    part.points = std::move(points);
    part.owned_nodes = size32(part.points);
    part.first_node = comm.exclusive_sum(part.owned_nodes);
    return part;
  }
  NodeId local(GlobalNodeId node) { return nodes_.local(node, {}); }

  Mesh part_;
  NodeTable nodes_;
};

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
  MeshOrder order;
  order.nodes = ordered_by(curve_keys(whole));
  const NodeNumbers numbers = inverse_of(order.nodes);
  order.triangles = ordered_cells(whole.triangles, numbers);
  order.quads = ordered_cells(whole.quads, numbers);
  return order;
}

MeshOrder order_for_parts(const Mesh& whole) {
  MeshOrder curve = space_filling_order(whole);
  const std::int64_t of_curve = spread(whole, inverse_of(curve.nodes)),
                     own = spread(whole, inverse_of(numbers_to(whole.points.size())));
  return 4 * own <= 5 * of_curve ? own_order(whole) : curve;
}

MeshOrder own_order(const Mesh& whole) {
  return {numbers_to(whole.points.size()), numbers_to(whole.triangles.size()),
          numbers_to(whole.quads.size())};
}

Mesh scatter_mesh(const Communicator& comm, const Mesh& whole, const MeshOrder& order) {
  const NodeNumbers numbers = inverse_of(order.nodes);
  PartBuilder builder(comm, scatter_points(comm, whole, order));
  builder.scatter_cells(comm, whole.triangles, order.triangles, numbers, builder.part().triangles);
  builder.scatter_cells(comm, whole.quads, order.quads, numbers, builder.part().quads);
  builder.part().boundaries = broadcast_boundaries(comm, whole);
  builder.add_edges(scatter_edges(comm, whole, numbers));
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

}  // namespace quadloop
