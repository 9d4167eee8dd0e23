#include "mesher/mesh/reorder_mesh.hpp"

#include <algorithm>
#include <bit>
#include <compare>
#include <utility>

#include "mesher/base/morton.hpp"
#include "mesher/base/parallel/even_shares.hpp"
#include "mesher/mesh/box_over_ranks.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/node_table.hpp"
#include "mesher/mesh/part_builder.hpp"

namespace quadloop {

namespace {

/// A number for each node of this rank's mesh, ghosts included.
using NewNumbers = std::vector<std::int64_t>;

struct Keyed {
  std::uint64_t key;
  std::int64_t item;
  friend auto operator<=>(const Keyed&, const Keyed&) = default;
};

/// Returns the lowest of the keys on each rank but the first, after sorting: approximately, from samples.
std::vector<Keyed> splitters(const Communicator& comm, const std::vector<Keyed>& sorted) {
  constexpr std::size_t most_samples = 64;
  std::vector<Keyed> samples;
  const std::size_t count = std::min(sorted.size(), most_samples);
  for (std::size_t i = 0; i < count; ++i) samples.push_back(sorted[sorted.size() * i / count]);
  samples = comm.all_gather_values(std::span<const Keyed>(samples));
  std::ranges::sort(samples);
  std::vector<Keyed> lowest;
  for (int rank = 1; rank < comm.size() && !samples.empty(); ++rank)
    lowest.push_back(samples[samples.size() * rank / comm.size()]);
  return lowest;
}

/// Sorts items of all ranks by their keys, then by their numbers; returns this rank's even share of them.
/// *Collective.*
std::vector<std::int64_t> sorted_items(const Communicator& comm, std::vector<Keyed> items) {
  std::ranges::sort(items);
  if (comm.size() > 1) {
    const std::vector<Keyed> lowest = splitters(comm, items);
    std::vector<int> ranks;
    ranks.reserve(items.size());
    for (int rank = 0; const Keyed& item : items) {
      while (rank < std::ssize(lowest) && item >= lowest[rank]) ++rank;
      ranks.push_back(rank);
    }
    items = Exchange(comm, ranks).deliver(items);
    std::ranges::sort(items);
  }
  std::vector<std::int64_t> numbers;
  numbers.reserve(items.size());
  for (const Keyed& item : items) numbers.push_back(item.item);
  std::exchange(items, {});
  return in_even_shares(comm, std::move(numbers));
}

/// Returns the nodes along a space-filling curve over the mesh's bounding box. *Collective.*
std::vector<std::int64_t> nodes_along_curve(const Communicator& comm, const Mesh& mesh) {
  const Box box = box_over_ranks(comm, mesh.points);
  const double side = std::max(box.width(), box.height());
  constexpr double steps = (std::uint64_t{1} << 31) - 1;
  const auto step = [&](double at, double low) {
    return static_cast<std::uint32_t>(side > 0 ? (at - low) / side * steps : 0);
  };
  std::vector<Keyed> keys;
  keys.reserve(mesh.owned_nodes);
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const Point p = mesh.points[i];
    keys.push_back({morton_key(step(p.x, box.low.x), step(p.y, box.low.y)), mesh.first_node + i});
  }
  return sorted_items(comm, std::move(keys));
}

/// Returns the new numbers of a mesh's nodes. `nodes` moves these to the new order. *Collective.*
NewNumbers new_numbers(const Communicator& comm, const Mesh& mesh, const RowMove& nodes, std::size_t moved) {
  std::vector<std::int64_t> own(moved);
  std::int64_t next = comm.exclusive_sum(static_cast<std::int64_t>(moved));
  for (std::int64_t& number : own) number = next++;
  NewNumbers numbers = nodes.back(own);
  std::exchange(own, {});
  numbers.reserve(mesh.points.size());
  numbers.resize(mesh.points.size());
  const NodeOwners owners(comm, mesh.first_node);
  NodeExchange(comm, owners, mesh.owned_nodes, mesh.ghosts).update(numbers);
  return numbers;
}

NewNumbers own_numbers(const Mesh& mesh) {
  NewNumbers numbers;
  for (const NodeId node : ids_below(NodeId{size32(mesh.points)}))
    numbers.push_back(mesh.global(node).value());
  return numbers;
}

/// Returns the cells in the order of their first node. *Collective.*
template <std::size_t width>
std::vector<std::int64_t> ordered_cells(const Communicator& comm,
                                        const std::vector<std::array<NodeId, width>>& cells,
                                        const NewNumbers& numbers) {
  std::int64_t number = comm.exclusive_sum(std::ssize(cells));
  std::vector<Keyed> keys;
  keys.reserve(cells.size());
  for (const auto& nodes : cells) {
    std::int64_t least = numbers[nodes[0].value()];
    for (const NodeId node : nodes) least = std::min(least, numbers[node.value()]);
    keys.push_back({static_cast<std::uint64_t>(least), number++});
  }
  return sorted_items(comm, std::move(keys));
}

/// Measures how far apart the node numbers of cells are, as a sum of powers of two: small if neighbours have
/// close numbers.
std::int64_t spread(const Mesh& mesh, const NewNumbers& numbers) {
  std::int64_t sum = 0;
  mesh.for_each_cell([&](const auto& nodes) {
    std::int64_t least = numbers[nodes[0].value()], largest = least;
    for (const NodeId node : nodes) {
      least = std::min(least, numbers[node.value()]);
      largest = std::max(largest, numbers[node.value()]);
    }
    sum += std::bit_width(static_cast<std::uint64_t>(largest - least));
  });
  return sum;
}

PartOrder order_along(const Communicator& comm, const Mesh& mesh, std::vector<std::int64_t> nodes,
                      const NewNumbers& numbers) {
  return {std::move(nodes), ordered_cells(comm, mesh.triangles, numbers),
          ordered_cells(comm, mesh.quads, numbers)};
}

NewNumbers numbers_along(const Communicator& comm, const Mesh& mesh, std::span<const std::int64_t> nodes) {
  return new_numbers(comm, mesh, RowMove(comm, mesh.first_node, nodes), nodes.size());
}

/// Returns the new numbers of nodes, which are the same list on all ranks. *Collective.*
std::vector<GlobalNodeId> numbers_of(const Communicator& comm, const Mesh& mesh, const NewNumbers& numbers,
                                     const std::vector<GlobalNodeId>& nodes) {
  struct Found {
    std::int64_t index, number;
  };
  std::vector<Found> own;
  for (std::int64_t i = 0; i < std::ssize(nodes); ++i) {
    const std::int64_t local = nodes[i].value() - mesh.first_node;
    if (0 <= local && local < mesh.owned_nodes) own.push_back({i, numbers[local]});
  }
  std::vector<GlobalNodeId> found(nodes.size());
  for (const auto& [index, number] : comm.all_gather_values(std::span<const Found>(own)))
    found[index] = GlobalNodeId{number};
  return found;
}

template <std::size_t width>
std::array<GlobalNodeId, width> numbered(const std::array<NodeId, width>& nodes, const NewNumbers& numbers) {
  std::array<GlobalNodeId, width> result;
  for (std::size_t k = 0; k < width; ++k) result[k] = GlobalNodeId{numbers[nodes[k].value()]};
  return result;
}

/// Sets the nodes of a rank's cells: `column(k)` are the global numbers of the k-th nodes, so that not all
/// are in memory at once, and `local` returns the number of a ghost. Ghosts are found in the order of the
/// cells.
template <std::size_t width, class Column, class Local>
void set_cells(const Mesh& part, const Column& column, const Local& local,
               std::vector<std::array<NodeId, width>>& cells) {
  std::vector<GlobalNodeId> ghosts;  // the k-th is -k in the cells
  for (std::size_t k = 0; k < width; ++k) {
    const std::vector<std::int64_t> nodes = column(k);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::int64_t offset = nodes[i] - part.first_node;
      const bool owned = 0 <= offset && offset < part.owned_nodes;
      if (!owned) ghosts.push_back(GlobalNodeId{nodes[i]});
      cells[i][k] = NodeId{owned ? static_cast<std::int32_t>(offset) : -size32(ghosts)};
    }
  }
  if (ghosts.empty()) return;
  for (auto& cell : cells) {
    for (NodeId& node : cell) {
      if (node.value() < 0) node = local(ghosts[-node.value() - 1]);
    }
  }
}

/// Moves cells to the new order. *Collective.*
template <std::size_t width>
void move_cells(const RowMove& move, const std::vector<std::array<NodeId, width>>& cells,
                const NewNumbers& numbers, PartBuilder& builder, std::vector<std::array<NodeId, width>>& to) {
  to.resize(move.size());
  const auto column = [&](std::size_t k) {
    std::vector<std::int64_t> nodes;
    nodes.reserve(move.leaving().size());
    for (const std::int32_t cell : move.leaving()) nodes.push_back(numbers[cells[cell][k].value()]);
    return move.forth_from(nodes);
  };
  set_cells(
      builder.part(), column, [&](GlobalNodeId node) { return builder.local(node); }, to);
}

/// Inverse of move_cells(). *Collective.*
template <std::size_t width>
void move_cells_back(const RowMove& move, const std::vector<std::array<NodeId, width>>& changed,
                     const NewNumbers& numbers, Mesh& part, NodeTable& table,
                     std::vector<std::array<NodeId, width>>& old) {
  const auto column = [&](std::size_t k) {
    std::vector<std::int64_t> nodes;
    nodes.reserve(changed.size());
    for (const auto& cell : changed) nodes.push_back(numbers[cell[k].value()]);
    return move.back(nodes);
  };
  old.resize(move.leaving().size());
  set_cells(
      part, column, [&](GlobalNodeId node) { return table.local(node, {}); }, old);
}

template <class T>
void append(std::vector<T> more, std::vector<T>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

PartOrder space_filling_order(const Communicator& comm, const Mesh& mesh) {
  std::vector<std::int64_t> nodes = nodes_along_curve(comm, mesh);
  const NewNumbers numbers = numbers_along(comm, mesh, nodes);
  return order_along(comm, mesh, std::move(nodes), numbers);
}

PartOrder own_order(const Communicator& comm, const Mesh& mesh) {
  const auto share = [&](std::int64_t count) {
    const EvenShare own(comm, comm.sum(count));
    std::vector<std::int64_t> numbers(own.size());
    for (std::int64_t i = 0; i < own.size(); ++i) numbers[i] = own.begin + i;
    return numbers;
  };
  return {share(mesh.owned_nodes), share(std::ssize(mesh.triangles)), share(std::ssize(mesh.quads))};
}

PartOrder order_for_parts(const Communicator& comm, const Mesh& mesh) {
  std::vector<std::int64_t> nodes = nodes_along_curve(comm, mesh);
  const NewNumbers numbers = numbers_along(comm, mesh, nodes);
  const std::int64_t of_curve = comm.sum(spread(mesh, numbers)),
                     own = comm.sum(spread(mesh, own_numbers(mesh)));
  return 4 * own <= 5 * of_curve ? own_order(comm, mesh) : order_along(comm, mesh, std::move(nodes), numbers);
}

ReorderedMesh::ReorderedMesh(const Communicator& comm, const Mesh& mesh, PartOrder order)
    : comm_{comm},
      nodes_{comm, mesh.first_node, order.nodes},
      triangles_{comm, comm.exclusive_sum(std::ssize(mesh.triangles)), order.triangles},
      quads_{comm, comm.exclusive_sum(std::ssize(mesh.quads)), order.quads},
      old_nodes_{std::move(order.nodes)} {}

Mesh ReorderedMesh::mesh(const Mesh& old) const {
  const NewNumbers numbers = new_numbers(comm_, old, nodes_, nodes_.size());
  PartBuilder builder(comm_, nodes_.forth(std::span(old.points).first(old.owned_nodes)));
  Mesh& part = builder.part();
  move_cells(triangles_, old.triangles, numbers, builder, part.triangles);
  move_cells(quads_, old.quads, numbers, builder, part.quads);
  for (const BoundaryEdges& boundary : old.boundaries) {
    BoundaryEdges& moved = part.boundaries.emplace_back(boundary);
    for (auto& edge : moved.edges) edge = builder.local(numbered(edge, numbers));
  }
  part.strips = old.strips;
  for (StripLayers& strip : part.strips) strip.nodes = numbers_of(comm_, old, numbers, strip.nodes);
  part.pairs = old.pairs;
  part.named_nodes = old.named_nodes;
  for (NamedNode& named : part.named_nodes) named.node = numbers_of(comm_, old, numbers, {named.node})[0];
  return builder.finish(comm_);
}

MeshBlocks ReorderedMesh::blocks(const MeshBlocks& old) const {
  if (old.names.empty()) return {};
  return {old.names, triangles_.forth(old.of_triangles), quads_.forth(old.of_quads)};
}

Field ReorderedMesh::field(const Field& old) const {
  Field field{old.names, nodes_.forth(old.values, old.width()), old.constants, {old.cells.names, {}}};
  const std::size_t width = old.cells.width(), middle = triangles_.leaving().size() * width;
  if (width == 0) return field;
  const std::span<const double> values(old.cells.values);
  field.cells.values = triangles_.forth(values.first(middle), width);
  append(quads_.forth(values.subspan(middle), width), field.cells.values);
  return field;
}

Mesh ReorderedMesh::take(Mesh& old) const {
  Mesh reordered = mesh(old);
  std::exchange(old.points, {});
  std::exchange(old.triangles, {});
  std::exchange(old.quads, {});
  return reordered;
}

void ReorderedMesh::put_back(const Mesh& changed, Mesh& old) const {
  old.points.resize(old.owned_nodes + old.ghosts.size());
  put_cells_back(changed, old);
  for (double Point::*coordinate : {&Point::x, &Point::y}) {  // one after the other, for less memory
    std::vector<double> values;
    values.reserve(changed.owned_nodes);
    for (std::int32_t i = 0; i < changed.owned_nodes; ++i) values.push_back(changed.points[i].*coordinate);
    values = nodes_.back(values);
    for (std::size_t i = 0; i < values.size(); ++i) old.points[i].*coordinate = values[i];
  }
  NodeExchange(comm_, NodeOwners(comm_, old.first_node), old.owned_nodes, old.ghosts).update(old.points);
}

void ReorderedMesh::put_cells_back(const Mesh& changed, Mesh& old) const {
  NewNumbers numbers;
  numbers.reserve(changed.points.size());
  numbers = old_nodes_;
  numbers.resize(changed.points.size());
  NodeExchange(comm_, NodeOwners(comm_, changed.first_node), changed.owned_nodes, changed.ghosts)
      .update(numbers);
  NodeTable table(old);
  move_cells_back(triangles_, changed.triangles, numbers, old, table, old.triangles);
  move_cells_back(quads_, changed.quads, numbers, old, table, old.quads);
}

Field ReorderedMesh::field_back(const Field& changed) const {
  Field field{changed.names,
              nodes_.back(changed.values, changed.width()),
              changed.constants,
              {changed.cells.names, {}}};
  const std::size_t width = changed.cells.width(), middle = triangles_.size() * width;
  if (width == 0) return field;
  const std::span<const double> values(changed.cells.values);
  field.cells.values = triangles_.back(values.first(middle), width);
  append(quads_.back(values.subspan(middle), width), field.cells.values);
  return field;
}

}  // namespace quadloop
