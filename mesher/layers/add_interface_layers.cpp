#include "mesher/layers/add_interface_layers.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>

#include "mesher/layers/filled_interface.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

namespace {

/// An edge of an interface or of the front above it, known to all ranks.
struct InterfaceEdge {
  BoundaryId boundary;
  std::array<GlobalNodeId, 2> nodes;
  std::array<Point, 2> points;
  std::int32_t rank = 0, leaf = 0;  ///< that own it
};

class InterfaceBuilder {
 public:
  InterfaceBuilder(const Communicator& comm, const LayerFront& front,
                   std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide, Mesh& mesh,
                   std::vector<LeafRecord>& leaves)
      : comm_{comm},
        front_{front},
        line_{front.line},
        edge_leaves_{edge_leaves},
        mesh_{mesh},
        owners_{comm, mesh.first_node},
        own_block_(line_.geometry().boundaries().size(), -1),
        other_block_(line_.geometry().boundaries().size(), -1) {
    find_own_blocks();
    fill();
    grown_.emplace(comm, nodes_behind(), divide, mesh, leaves);
    exchange_numbers();
  }

  void build() {
    for (std::size_t b = 0; b < mesh_.boundaries.size(); ++b) keep_edges(b);
    for (std::size_t f = 0; f < filled_.size(); ++f) {
      add_cells(f);
      if (!filled_[f].part().closed) add_ends(f);
    }
    grown_->put_together([&](NodeId node, std::vector<Point>& points) {
      const auto [begin, end] = behind_.equal_range(mesh_.global(node));
      for (auto it = begin; it != end; ++it) {
        const std::vector<Point>& own = column(it->second).points;
        points.insert(points.end(), own.begin(), own.end());
      }
    });
    edge_leaves_ = grown_->edge_leaves();
    edge_leaves_.pop_back();
    mesh_.boundaries.pop_back();
    for (const BoundaryId b : own_block_.ids()) {
      if (own_block_[b] >= 0) mesh_.boundaries[b.value()].between_blocks = true;
    }
  }

 private:
  struct ColumnNumber {
    std::size_t part = 0, column = 0;
  };

  const FilledInterface::Column& column(const ColumnNumber& c) const {
    return filled_[c.part].columns()[c.column];
  }
  void find_own_blocks();
  std::vector<InterfaceEdge> gathered_edges() const;
  void fill();
  std::vector<std::int32_t> nodes_behind();
  void exchange_numbers();
  void keep_edges(std::size_t b);
  void add_cells(std::size_t f);
  void add_ends(std::size_t f);
  GrownNode node(std::size_t f, const FilledInterface::Corner& corner) const;

  const Communicator& comm_;
  const LayerFront& front_;
  const WallLine& line_;
  std::vector<std::vector<std::int32_t>>& edge_leaves_;
  Mesh& mesh_;
  NodeOwners owners_;
  /// For each boundary of the geometry the block whose columns stand on it, and the block on the other side;
  /// -1: none.
  IdVector<BoundaryId, std::int32_t> own_block_, other_block_;
  std::vector<FilledInterface> filled_;
  std::multimap<GlobalNodeId, ColumnNumber> behind_;  ///< by the foot's number before layers are added
  std::map<GlobalNodeId, GrownNode> grown_nodes_;     ///< by the number before layers are added
  std::vector<std::vector<GlobalNodeId>> first_of_column_;
  std::optional<GrownMesh> grown_;
};

void InterfaceBuilder::find_own_blocks() {
  const Geometry& g = line_.geometry();
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (!line_.has_layers(s) || !line_.is_interface(s)) continue;
    own_block_[g.boundary_of(s)] = g.block_of(s);
    other_block_[g.boundary_of(s)] = g.block_of(g.twin(s));
  }
}

/// All ranks' edges of interfaces and of their fronts.
std::vector<InterfaceEdge> InterfaceBuilder::gathered_edges() const {
  std::vector<InterfaceEdge> own;
  for (std::int32_t b = 0; b < size32(mesh_.boundaries); ++b) {
    const BoundaryId boundary{b};
    if (boundary != front_.interface_boundary() && own_block_[boundary] < 0) continue;
    const auto& edges = mesh_.boundaries[b].edges;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto& [from, to] = edges[e];
      own.push_back({boundary,
                     {mesh_.global(from), mesh_.global(to)},
                     {mesh_.point(from), mesh_.point(to)},
                     comm_.rank(),
                     edge_leaves_[b][e]});
    }
  }
  return comm_.all_gather_values(std::span<const InterfaceEdge>(own));
}

/// Assigns nodes to the parts, by the stations at which their edges begin, and fills these.
void InterfaceBuilder::fill() {
  const std::vector<InterfacePart> parts = interface_parts(line_);
  std::vector<std::int32_t> part_of(line_.size(), -1);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    std::int32_t i = parts[p].begin;
    do {
      part_of[i] = static_cast<std::int32_t>(p);
      i = line_.next(i);
    } while (i != parts[p].end);
  }
  const FrontPlaces fronts = FrontPlaces::on_interface_fronts(front_),
                    walls = FrontPlaces::on_interfaces(front_);
  std::vector<std::vector<InterfaceFoot>> feet(parts.size());
  std::vector<std::vector<FrontNode>> tops(parts.size());
  std::vector<FrontNode> ends(parts.size());
  const std::vector<InterfaceEdge> edges = gathered_edges();
  for (const InterfaceEdge& edge : edges) {
    const bool is_front = edge.boundary == front_.interface_boundary();
    const auto place = [&](std::size_t k) {
      return (is_front ? fronts : walls).locate(edge.points[k], edge.boundary);
    };
    const std::size_t first = is_front ? 0 : 1, second = 1 - first;  // the other block's edges are reversed
    const FrontPlace from = place(first), to = place(second);
    const std::int32_t part = from.valid() ? part_of[from.station] : -1;
    if (part < 0) continue;
    if (is_front) {
      tops[part].push_back({edge.nodes[0], edge.points[0], from, edge.rank, edge.leaf});
      if (to.at_station() && to.station == parts[part].end && !parts[part].closed)
        ends[part] = {edge.nodes[1], edge.points[1], to, edge.rank, edge.leaf};
    } else {
      feet[part].push_back({edge.nodes[first], edge.points[first], from});
      feet[part].push_back({edge.nodes[second], edge.points[second], to});
    }
  }
  comm_.together([&] {
    for (std::size_t p = 0; p < parts.size(); ++p) {
      if (ends[p].node.valid()) tops[p].push_back(ends[p]);
      filled_.emplace_back(front_, parts[p], std::move(feet[p]), std::move(tops[p]));
    }
  });
}

std::vector<std::int32_t> InterfaceBuilder::nodes_behind() {
  std::vector<std::int32_t> added(mesh_.owned_nodes, 0);
  for (std::size_t f = 0; f < filled_.size(); ++f) {
    for (std::size_t c = 0; c < filled_[f].columns().size(); ++c) {
      const FilledInterface::Column& column = filled_[f].columns()[c];
      if (column.is_walls) continue;
      const GlobalNodeId foot = filled_[f].feet()[column.foot].node;
      behind_.emplace(foot, ColumnNumber{f, c});
      if (owners_.rank_of(foot) == comm_.rank()) added[owners_.local(foot).value()] += size32(column.points);
    }
  }
  return added;
}

/// Sends the new numbers of feet, of the front's nodes and of ordinary columns' nodes to all ranks; those of
/// the added nodes follow from them.
void InterfaceBuilder::exchange_numbers() {
  std::vector<GlobalNodeId> wanted;
  for (const FilledInterface& filled : filled_) {
    for (const InterfaceFoot& foot : filled.feet()) wanted.push_back(foot.node);
    for (const FrontNode& top : filled.tops()) wanted.push_back(top.node);
    for (const FilledInterface::Column& column : filled.columns()) {
      if (!column.is_walls) continue;
      for (int ring = 1; ring < filled.layers(); ++ring)
        wanted.push_back(GlobalNodeId{filled.tops()[column.top].node.value() + ring});
    }
  }
  grown_nodes_ = grown_->nodes(wanted);
  for (const FilledInterface& filled : filled_) first_of_column_.emplace_back(filled.columns().size());
  GlobalNodeId before;
  std::int64_t next = 0;
  for (const auto& [foot, number] : behind_) {
    if (foot != before) next = grown_nodes_.at(foot).id.value() + 1;
    before = foot;
    first_of_column_[number.part][number.column] = GlobalNodeId{next};
    next += std::ssize(column(number).points);
  }
}

GrownNode InterfaceBuilder::node(std::size_t f, const FilledInterface::Corner& corner) const {
  const FilledInterface& filled = filled_[f];
  if (corner.on_front) return grown_nodes_.at(filled.tops()[corner.number].node);
  const FilledInterface::Column& column = filled.columns()[corner.number];
  if (corner.ring == 0) return grown_nodes_.at(filled.feet()[column.foot].node);
  if (column.is_walls)
    return grown_nodes_.at(GlobalNodeId{filled.tops()[column.top].node.value() + corner.ring});
  const int index = corner.ring - column.lowest;
  return {GlobalNodeId{first_of_column_[f][corner.number].value() + index}, column.points[index]};
}

/// Keeps all edges but those of the fronts. The lower block is to the left of an edge between two blocks.
void InterfaceBuilder::keep_edges(std::size_t b) {
  const BoundaryId boundary{static_cast<std::int32_t>(b)};
  if (boundary == front_.interface_boundary()) return;
  const bool turns = own_block_[boundary] >= 0 && own_block_[boundary] < other_block_[boundary];
  const auto& edges = mesh_.boundaries[b].edges;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    std::array<NodeId, 2> edge = edges[e];
    if (turns) std::swap(edge[0], edge[1]);
    grown_->keep_edge(b, edge_leaves_[b][e], edge);
  }
}

void InterfaceBuilder::add_cells(std::size_t f) {
  const FilledInterface& filled = filled_[f];
  grown_->begin_block(line_.geometry().block_of(line_[filled.part().begin].segment));
  for (const auto& [edge, corners] : filled.cells()) {
    const FrontNode& top = filled.tops()[edge];
    if (top.rank != comm_.rank()) continue;
    std::vector<GrownNode> nodes;
    for (const FilledInterface::Corner& corner : corners) nodes.push_back(node(f, corner));
    grown_->add_cell(top.leaf, nodes);
  }
}

/// Adds the edges of the boundaries on which the first and the last column lie, if these end the layers.
void InterfaceBuilder::add_ends(std::size_t f) {
  const FilledInterface& filled = filled_[f];
  const Geometry& g = line_.geometry();
  const auto columns = static_cast<std::int32_t>(filled.columns().size()),
             tops = static_cast<std::int32_t>(filled.tops().size());
  for (const bool first : {true, false}) {
    const std::int32_t station = first ? filled.part().begin : filled.part().end;
    if ((first ? line_.previous(station) : line_.next(station)) != WallLine::none) continue;
    const FrontNode& top = filled.tops()[first ? 0 : tops - 1];
    if (top.rank != comm_.rank()) continue;
    const std::int32_t s = line_[station].segment;
    const BoundaryId boundary = g.boundary_of(first ? g.previous(s) : g.next(s));
    for (int ring = 1; ring <= filled.layers(); ++ring) {
      const std::int32_t column = first ? 0 : columns - 1;
      const GrownNode low = node(f, {false, column, ring - 1}),
                      high = ring < filled.layers() ? node(f, {false, column, ring})
                                                    : node(f, {true, first ? 0 : tops - 1, 0});
      grown_->add_edge(boundary.value(), top.leaf, first ? high : low, first ? low : high);
    }
  }
}

}  // namespace

void add_interface_layers(const Communicator& comm, const LayerFront& front,
                          std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide,
                          Mesh& mesh, std::vector<LeafRecord>& leaves) {
  InterfaceBuilder(comm, front, edge_leaves, divide, mesh, leaves).build();
}

}  // namespace quadloop
