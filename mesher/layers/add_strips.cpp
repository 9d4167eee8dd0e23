#include "mesher/layers/add_strips.hpp"

#include <algorithm>
#include <map>

#include "mesher/base/error.hpp"
#include "mesher/layers/filled_strip.hpp"

namespace quadloop {

namespace {

class StripBuilder {
 public:
  StripBuilder(const Communicator& comm, const LayerFront& front,
               const std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide, Mesh& mesh,
               std::vector<LeafRecord>& leaves)
      : comm_{comm}, front_{front}, edge_leaves_{edge_leaves}, mesh_{mesh}, owners_{comm, mesh.first_node} {
    find_fronts();
    grown_.emplace(comm, nodes_behind(), divide, mesh, leaves);
    exchange_numbers();
  }

  void build() {
    for (std::size_t b = 0; b < mesh_.boundaries.size(); ++b) {
      if (b == boundary()) continue;
      const auto& edges = mesh_.boundaries[b].edges;
      for (std::size_t e = 0; e < edges.size(); ++e) grown_->keep_edge(b, edge_leaves_[b][e], edges[e]);
    }
    for (std::size_t s = 0; s < strips_.size(); ++s) add_cells(s);
    grown_->put_together([&](NodeId node, std::vector<Point>& points) {
      const auto [begin, end] = behind_.equal_range(mesh_.global(node));
      for (auto it = begin; it != end; ++it) {
        const std::vector<Point> own = strips_[it->second.strip].own_points(it->second.column);
        points.insert(points.end(), own.begin(), own.end());
      }
    });
    mesh_.boundaries.pop_back();
    for (std::size_t s = 0; s < strips_.size(); ++s) mesh_.strips.push_back(layers_of(s));
  }

 private:
  struct Column {
    std::size_t strip = 0, column = 0;
  };

  std::size_t boundary() const { return front_.strip_boundary().value(); }
  void find_fronts();
  static std::vector<FrontEdge> front_of(const LayerStrip& strip,
                                         const std::map<GlobalNodeId, FrontEdge>& by_first,
                                         const std::map<Point, const FrontEdge*>& by_place);
  std::vector<std::int32_t> nodes_behind();
  void exchange_numbers();
  GrownNode node(std::size_t strip, const FilledStrip::Corner& c) const;
  GrownNode base_node(std::size_t strip, std::size_t line, std::size_t place) const;
  static GlobalNodeId wall_node(const FilledStrip& strip, bool left, std::int32_t ring);
  StripLayers layers_of(std::size_t s) const;
  void add_base(std::size_t s);
  void add_cells(std::size_t s);

  const Communicator& comm_;
  const LayerFront& front_;
  const std::vector<std::vector<std::int32_t>>& edge_leaves_;
  Mesh& mesh_;
  NodeOwners owners_;
  std::vector<FilledStrip> strips_;
  std::multimap<GlobalNodeId, Column> behind_;     ///< by the number before strips are added
  std::map<GlobalNodeId, GrownNode> grown_nodes_;  ///< nodes of fronts and of wall columns at wake roots, by
                                                   ///< the number before strips are added
  std::vector<std::vector<GlobalNodeId>> first_of_column_;
  std::optional<GrownMesh> grown_;
};

void StripBuilder::find_fronts() {
  std::vector<FrontEdge> own;
  const auto& edges = mesh_.boundaries[boundary()].edges;
  const std::vector<std::int32_t>& leaves = edge_leaves_[boundary()];
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto& [from, to] = edges[e];
    own.push_back({{mesh_.global(from), mesh_.global(to)},
                   {mesh_.point(from), mesh_.point(to)},
                   comm_.rank(),
                   leaves[e]});
  }
  const std::vector<FrontEdge> all = comm_.all_gather_values(std::span<const FrontEdge>(own));
  std::map<GlobalNodeId, FrontEdge> by_first;
  std::map<Point, const FrontEdge*> by_place;
  for (const FrontEdge& edge : all) {
    by_first.emplace(edge.nodes[0], edge);
    by_place.emplace(edge.points[0], &edge);
  }
  strips_.reserve(front_.strips.size());
  comm_.together([&] {
    for (const LayerStrip& strip : front_.strips)
      strips_.emplace_back(strip, front_of(strip, by_first, by_place));
  });
}

/// The edges of a strip's front in order, until there is no next one or the first one recurs.
std::vector<FrontEdge> StripBuilder::front_of(const LayerStrip& strip,
                                              const std::map<GlobalNodeId, FrontEdge>& by_first,
                                              const std::map<Point, const FrontEdge*>& by_place) {
  const Point begin = strip.root ? strip.root->left : strip.front[strip.corners[3]];
  const auto first = by_place.find(begin);
  if (first == by_place.end()) refuse_narrow(strip, begin);
  std::vector<FrontEdge> front{*first->second};
  for (auto next = by_first.find(front[0].nodes[1]);
       next != by_first.end() && next->first != front[0].nodes[0];
       next = by_first.find(next->second.nodes[1]))
    front.push_back(next->second);
  return front;
}

std::vector<std::int32_t> StripBuilder::nodes_behind() {
  std::vector<std::int32_t> added(mesh_.owned_nodes, 0);
  for (std::size_t s = 0; s < strips_.size(); ++s) {
    const FilledStrip& strip = strips_[s];
    for (std::size_t k = 0; k < strip.columns(); ++k) {
      const GlobalNodeId node = strip.front()[strip.anchor(k)].nodes[0];
      behind_.emplace(node, Column{s, k});
      if (owners_.rank_of(node) == comm_.rank())
        added[owners_.local(node).value()] += static_cast<std::int32_t>(strip.own_nodes(k));
    }
  }
  return added;
}

/// Sends the new numbers of the fronts' nodes to all ranks; those of the columns' nodes follow from them.
void StripBuilder::exchange_numbers() {
  std::vector<GlobalNodeId> wanted;
  for (const FilledStrip& strip : strips_) {
    for (const FrontEdge& edge : strip.front()) wanted.push_back(edge.nodes[0]);
    if (!strip.strip().root) continue;
    wanted.push_back(strip.front().back().nodes[1]);
    for (std::int32_t ring = 0; ring < strip.strip().layers; ++ring) {
      wanted.push_back(wall_node(strip, true, ring));
      if (ring > 0 || strip.strip().core > 0) wanted.push_back(wall_node(strip, false, ring));
    }
  }
  grown_nodes_ = grown_->nodes(wanted);
  for (const FilledStrip& strip : strips_) first_of_column_.emplace_back(strip.columns());
  GlobalNodeId before;
  std::int64_t next = 0;
  for (const auto& [node, column] : behind_) {
    if (node != before) next = grown_nodes_.at(node).id.value() + 1;
    before = node;
    first_of_column_[column.strip][column.column] = GlobalNodeId{next};
    next += static_cast<std::int64_t>(strips_[column.strip].own_nodes(column.column));
  }
}

GrownNode StripBuilder::node(std::size_t s, const FilledStrip::Corner& c) const {
  const FilledStrip& strip = strips_[s];
  if (c.on_front) {
    const std::size_t edges = strip.front().size();
    const auto& nodes = strip.front()[std::min(c.column, edges - 1)].nodes;
    return grown_nodes_.at(nodes[c.column < edges ? 0 : 1]);
  }
  const Point p = strip.strip().columns[c.column][c.row];
  const std::size_t begin = strip.own_begin(c.column), end = strip.own_end(c.column);
  if (begin <= c.row && c.row < end)
    return {GlobalNodeId{first_of_column_[s][c.column].value() + static_cast<std::int64_t>(c.row - begin)},
            p};
  const auto layers = strip.strip().layers, row = static_cast<std::int32_t>(c.row);
  const std::int32_t left_ring = layers - (static_cast<std::int32_t>(strip.rows()) - row);
  const bool left = left_ring >= 0;
  return grown_nodes_.at(wall_node(strip, left, left ? left_ring : layers - row));
}

/// A node on a line of the base's layers; the last line is the middle of the first column.
GrownNode StripBuilder::base_node(std::size_t s, std::size_t line, std::size_t place) const {
  const FilledStrip& strip = strips_[s];
  const std::size_t lines = strip.strip().base_lines.size(), foot = strip.strip().layers;
  if (line == lines) return node(s, {false, 0, foot + lines + place});
  const std::vector<Point>& points = strip.strip().base_lines[line];
  if (place == 0) return node(s, {false, 0, foot + line});
  if (place + 1 == points.size()) return node(s, {false, 0, strip.rows() - foot - line});
  const std::size_t before =
      strip.own_end(0) - strip.own_begin(0) + line * strip.base_nodes_of_line() + place - 1;
  return {GlobalNodeId{first_of_column_[s][0].value() + static_cast<std::int64_t>(before)}, points[place]};
}

/// The old number of a node in the wall column on one side of a wake. These nodes are numbered after their
/// front node, from the wall outwards. At a sharp edge only the left column owns the wall node.
GlobalNodeId StripBuilder::wall_node(const FilledStrip& strip, bool left, std::int32_t ring) {
  const GlobalNodeId top = left ? strip.front().front().nodes[0] : strip.front().back().nodes[1];
  if (ring == strip.strip().layers) return top;
  return GlobalNodeId{top.value() + (left || strip.strip().core > 0 ? 1 + ring : ring)};
}

/// The layers of a strip in the form stored in the mesh.
StripLayers StripBuilder::layers_of(std::size_t s) const {
  const FilledStrip& filled = strips_[s];
  const LayerStrip& strip = filled.strip();
  StripLayers layers{strip.name,
                     {strip.layers, strip.asked},
                     strip.root.has_value(),
                     static_cast<std::int32_t>(filled.rows() + 1),
                     {}};
  const std::size_t across = filled.rows() + 1;
  for (std::size_t i = 0; i < filled.columns() * across; ++i)
    layers.nodes.push_back(node(s, {false, i / across, i % across}).id);
  return layers;
}

/// Adds the layers on the base of a blunt edge, and the boundary edges of the base.
void StripBuilder::add_base(std::size_t s) {
  const FilledStrip& strip = strips_[s];
  const FrontEdge& edge = strip.front()[strip.anchor(0)];
  if (strip.strip().core == 0 || edge.rank != comm_.rank()) return;
  const BoundaryId wall = strip.strip().root->base_boundary;
  const std::size_t lines = strip.strip().base_lines.size(), edges = strip.strip().core - 2 * lines;
  for (std::size_t place = edges; place > 0; --place)
    grown_->add_edge(wall.value(), edge.leaf, base_node(s, 0, place), base_node(s, 0, place - 1));
  for (std::size_t line = 0; line < lines; ++line) {
    for (std::size_t place = 0; place < edges; ++place)
      grown_->add_cell(edge.leaf,
                       std::array{base_node(s, line, place), base_node(s, line + 1, place),
                                  base_node(s, line + 1, place + 1), base_node(s, line, place + 1)});
  }
}

void StripBuilder::add_cells(std::size_t s) {
  const FilledStrip& strip = strips_[s];
  grown_->begin_cells_of(
      strip.strip().place + strip.strip().name + ", ",
      "use gentler bends or thinner layers, or reduce spacing.min: cells must not be wider than the layers");
  const auto has = [&](std::int32_t edge) { return strip.front()[edge].rank == comm_.rank(); };
  for (std::size_t k = 0; k + 1 < strip.columns(); ++k) {
    const FrontEdge& edge = strip.front()[strip.anchor(k + 1)];
    if (edge.rank != comm_.rank()) continue;
    for (std::size_t row = 0; row < strip.rows(); ++row) {
      const std::size_t outer = row < strip.rows() / 2 ? 0 : 2;
      grown_->add_cell(edge.leaf,
                       std::array{node(s, {false, k, row}), node(s, {false, k + 1, row}),
                                  node(s, {false, k + 1, row + 1}), node(s, {false, k, row + 1})},
                       outer);
    }
  }
  add_base(s);
  for (const auto& [edge, corners] : strip.triangles()) {
    if (!has(edge)) continue;
    grown_->add_cell(strip.front()[edge].leaf,
                     std::array{node(s, corners[0]), node(s, corners[1]), node(s, corners[2])});
  }
}

}  // namespace

void add_strips(const Communicator& comm, const LayerFront& front,
                const std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide, Mesh& mesh,
                std::vector<LeafRecord>& leaves) {
  StripBuilder(comm, front, edge_leaves, divide, mesh, leaves).build();
}

}  // namespace quadloop
