#include "mesher/layers/add_strips.hpp"

#include <algorithm>
#include <map>

#include "mesher/base/error.hpp"
#include "mesher/layers/zipper.hpp"

namespace quadloop {

namespace {

/// An edge of a strip's front, known to all ranks.
struct FrontEdge {
  std::array<GlobalNodeId, 2> nodes;
  std::array<Point, 2> points;
  std::int32_t rank = 0, leaf = 0;  ///< that have it
};

/// One strip with the nodes on its front, the same on all ranks.
class FilledStrip {
 public:
  FilledStrip(const LayerStrip& strip, std::vector<FrontEdge> front)
      : strip_{strip}, front_{std::move(front)} {
    for (const FrontEdge& edge : front_) nodes_.push_back(edge.points[0]);
    nodes_.push_back(front_.back().points[1]);
    cut_at_ends();
    zip(true);
    zip(false);
    close_ends();
    anchor_columns();
  }

  const LayerStrip& strip() const { return strip_; }
  const std::vector<FrontEdge>& front() const { return front_; }
  std::size_t columns() const { return strip_.columns.size(); }
  std::size_t rows() const { return strip_.columns[0].size() - 1; }
  /// The column's nodes from one row on and before another are the strip's own: of a wake's first column
  /// those on the base alone.
  std::size_t own_begin(std::size_t column) const { return is_root(column) ? strip_.layers + 1 : 0; }
  std::size_t own_end(std::size_t column) const {
    return is_root(column) ? std::max(own_begin(column), rows() - strip_.layers) : rows() + 1;
  }
  bool is_root(std::size_t column) const { return strip_.root && column == 0; }
  /// The edge whose first node the column's nodes stand behind.
  std::int32_t anchor(std::size_t column) const { return anchor_[column]; }

  /// A node of the strip: by its column and its row from the right; or one of the front.
  struct Corner {
    bool on_front = false;
    std::size_t column = 0, row = 0;  ///< or the number of the front's node
  };
  struct Triangle {
    std::int32_t edge = 0;  ///< of the front, with which it goes
    std::array<Corner, 3> corners;
  };
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  std::size_t middle() const { return rows() / 2; }
  Point at(const Corner& c) const { return c.on_front ? nodes_[c.column] : strip_.columns[c.column][c.row]; }

  /// The front's nodes beside the right and the left, cut where they face the line's ends.
  void cut_at_ends();
  std::size_t facing(std::size_t from, std::size_t to, std::size_t column, bool left) const;
  std::size_t number_of(std::size_t corner) const {
    const auto found = std::ranges::find(nodes_, strip_.front[strip_.corners[corner]]);
    QUADLOOP_REQUIRE(found != nodes_.end(), "corners of fronts are nodes");
    return found - nodes_.begin();
  }

  std::vector<Corner> inner_side(bool left) const;
  std::vector<Corner> outer_side(bool left) const;
  void zip(bool left);
  void close_ends();
  void add_triangle(std::int32_t edge, const Corner& a, const Corner& b, const Corner& c) {
    triangles_.push_back({edge, {a, b, c}});
  }
  void anchor_columns();

  const LayerStrip& strip_;
  std::vector<FrontEdge> front_;
  std::vector<Point> nodes_;  ///< of the front, one more than edges
  /// Of the front's nodes the last one on the left and the first one on the right, at the end; of a free line
  /// the last one on the right and the first one on the left, at the beginning.
  std::size_t end_left_ = 0, end_right_ = 0, begin_right_ = 0, begin_left_ = 0;
  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> anchor_;
};

/// The last node on one side of the line, of those between two corners that face an end.
std::size_t FilledStrip::facing(std::size_t from, std::size_t to, std::size_t column, bool left) const {
  const std::vector<Point>& across = strip_.columns[column];
  const Point middle_of = across[middle()], axis = across.back() - across.front();
  std::size_t found = from;
  for (std::size_t k = from; k != to; from < to ? ++k : --k) {
    const double side = dot(nodes_[k] - middle_of, axis);
    if (left ? side >= 0 : side <= 0) found = k;
  }
  return found;
}

void FilledStrip::cut_at_ends() {
  const std::size_t last = columns() - 1, left = number_of(0), right = number_of(1);
  end_left_ = facing(left, right, last, true);
  end_right_ = facing(right, left, last, false);
  if (strip_.root) return;
  begin_right_ = facing(number_of(2), nodes_.size() - 1, 0, false);
  begin_left_ = facing(nodes_.size() - 1, number_of(2), 0, true);
}

/// The strip's own outline on one side, from the beginning to the middle of the end.
std::vector<FilledStrip::Corner> FilledStrip::inner_side(bool left) const {
  const auto row = [&](std::size_t from_middle) {
    return left ? middle() + from_middle : middle() - from_middle;
  };
  std::vector<Corner> side;
  for (std::size_t r = 0; !strip_.root && r < middle(); ++r) side.push_back({false, 0, row(r)});
  for (std::size_t k = 0; k < columns(); ++k) side.push_back({false, k, row(middle())});
  for (std::size_t r = middle(); r > 0; --r) side.push_back({false, columns() - 1, row(r - 1)});
  return side;
}

/// The front's nodes on one side, in the same direction.
std::vector<FilledStrip::Corner> FilledStrip::outer_side(bool left) const {
  std::vector<Corner> side;
  if (left) {
    for (std::size_t k = begin_left_; !strip_.root && k + 1 < nodes_.size(); ++k)
      side.push_back({true, k, 0});
    for (std::size_t k = 0; k <= end_left_; ++k) side.push_back({true, k, 0});
  } else {
    for (std::size_t k = strip_.root ? nodes_.size() - 1 : begin_right_; k >= end_right_; --k)
      side.push_back({true, k, 0});
  }
  return side;
}

void FilledStrip::zip(bool left) {
  const std::vector<Corner> inner = inner_side(left), outer = outer_side(left);
  std::vector<Point> first, second;
  for (const Corner& c : inner) first.push_back(at(c));
  for (const Corner& c : outer) second.push_back(at(c));
  const auto edges = static_cast<std::int32_t>(front_.size());
  for (const ZipperTriangle& t : zipper(first, second, left)) {
    const Corner a = inner[t.first], b = outer[t.second];
    const auto node = static_cast<std::int32_t>(b.column);
    const Corner c = t.on_first ? inner[t.first + 1] : outer[t.second + 1];
    const std::int32_t other = t.on_first ? node : static_cast<std::int32_t>(c.column);
    const std::int32_t edge = std::min(left || t.on_first ? node : other, edges - 1);
    add_triangle(edge, a, left ? c : b, left ? b : c);
  }
}

/// Between the two sides, where the front has edges that face an end.
void FilledStrip::close_ends() {
  for (std::size_t k = end_left_; k < end_right_; ++k)
    add_triangle(static_cast<std::int32_t>(k), {false, columns() - 1, middle()}, {true, k + 1, 0},
                 {true, k, 0});
  if (strip_.root) return;
  for (std::size_t k = begin_right_; k < begin_left_; ++k)
    add_triangle(static_cast<std::int32_t>(k), {false, 0, middle()}, {true, k + 1, 0}, {true, k, 0});
}

/// Each column with the first triangle on the left that has its last node.
void FilledStrip::anchor_columns() {
  constexpr std::int32_t none = -1;
  anchor_.assign(columns(), none);
  if (strip_.root) anchor_[0] = 0;
  for (const Triangle& t : triangles_) {
    for (const Corner& c : t.corners) {
      if (!c.on_front && c.row == rows() && anchor_[c.column] == none) anchor_[c.column] = t.edge;
    }
  }
}

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
        const FilledStrip& strip = strips_[it->second.strip];
        const std::size_t k = it->second.column;
        const std::vector<Point>& column = strip.strip().columns[k];
        points.insert(points.end(), column.begin() + strip.own_begin(k), column.begin() + strip.own_end(k));
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
  std::vector<FrontEdge> front_from(Point begin, const std::map<GlobalNodeId, FrontEdge>& by_first,
                                    const std::vector<FrontEdge>& edges) const;
  std::vector<std::int32_t> nodes_behind();
  void exchange_numbers();
  GrownNode node(std::size_t strip, const FilledStrip::Corner& c) const;
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
  std::multimap<GlobalNodeId, Column> behind_;     ///< by the number before
  std::map<GlobalNodeId, GrownNode> grown_nodes_;  ///< of fronts and of walls' columns at roots, by the
                                                   ///< number before
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
  for (const FrontEdge& edge : all) by_first.emplace(edge.nodes[0], edge);
  strips_.reserve(front_.strips.size());
  for (const LayerStrip& strip : front_.strips) {
    const Point begin = strip.root ? strip.root->left : strip.front[strip.corners[3]];
    strips_.emplace_back(strip, front_from(begin, by_first, all));
  }
}

/// One after another, as far as there are any or the first one comes again.
std::vector<FrontEdge> StripBuilder::front_from(Point begin,
                                                const std::map<GlobalNodeId, FrontEdge>& by_first,
                                                const std::vector<FrontEdge>& edges) const {
  const auto first = std::ranges::find(edges, begin, [](const FrontEdge& e) { return e.points[0]; });
  QUADLOOP_REQUIRE(first != edges.end(), "the fronts of strips begin at nodes");
  std::vector<FrontEdge> front{*first};
  for (auto next = by_first.find(first->nodes[1]); next != by_first.end() && next->first != first->nodes[0];
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
        added[owners_.local(node).value()] +=
            static_cast<std::int32_t>(strip.own_end(k) - strip.own_begin(k));
    }
  }
  return added;
}

/// Of the fronts' nodes to all ranks, and by them those of the columns behind.
void StripBuilder::exchange_numbers() {
  struct Renumbered {
    GlobalNodeId before;
    GrownNode node;
  };
  std::vector<Renumbered> own;
  const auto tell = [&](GlobalNodeId node) {
    if (owners_.rank_of(node) == comm_.rank()) own.push_back({node, grown_->node(owners_.local(node))});
  };
  for (const FilledStrip& strip : strips_) {
    for (const FrontEdge& edge : strip.front()) tell(edge.nodes[0]);
    if (!strip.strip().root) continue;
    tell(strip.front().back().nodes[1]);
    for (std::int32_t ring = 0; ring < strip.strip().layers; ++ring) {
      tell(wall_node(strip, true, ring));
      if (ring > 0 || strip.strip().core > 0) tell(wall_node(strip, false, ring));
    }
  }
  for (const Renumbered& r : comm_.all_gather_values(std::span<const Renumbered>(own)))
    grown_nodes_.emplace(r.before, r.node);
  for (const FilledStrip& strip : strips_) first_of_column_.emplace_back(strip.columns());
  GlobalNodeId before;
  std::int64_t next = 0;
  for (const auto& [node, column] : behind_) {
    if (node != before) next = grown_nodes_.at(node).id.value() + 1;
    before = node;
    first_of_column_[column.strip][column.column] = GlobalNodeId{next};
    const FilledStrip& strip = strips_[column.strip];
    next += static_cast<std::int64_t>(strip.own_end(column.column) - strip.own_begin(column.column));
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

/// The number before of a node in the wall's column on one side of a wake: they stand behind that on the
/// front, from the wall on; at a sharp edge the left one alone has the wall's node.
GlobalNodeId StripBuilder::wall_node(const FilledStrip& strip, bool left, std::int32_t ring) {
  const GlobalNodeId top = left ? strip.front().front().nodes[0] : strip.front().back().nodes[1];
  if (ring == strip.strip().layers) return top;
  return GlobalNodeId{top.value() + (left || strip.strip().core > 0 ? 1 + ring : ring)};
}

/// As the mesh keeps it.
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

/// The wall's edges behind a blunt edge.
void StripBuilder::add_base(std::size_t s) {
  const FilledStrip& strip = strips_[s];
  const FrontEdge& edge = strip.front()[strip.anchor(0)];
  if (strip.strip().core == 0 || edge.rank != comm_.rank()) return;
  const BoundaryId wall = strip.strip().root->base_boundary;
  for (std::size_t row = strip.rows() - strip.strip().layers;
       row > static_cast<std::size_t>(strip.strip().layers); --row)
    grown_->add_edge(wall.value(), edge.leaf, node(s, {false, 0, row}), node(s, {false, 0, row - 1}));
}

void StripBuilder::add_cells(std::size_t s) {
  const FilledStrip& strip = strips_[s];
  grown_->begin_cells_of(strip.strip().place + strip.strip().name + ", ",
                         "lead it in gentler bends, or ask for thinner layers");
  const auto has = [&](std::int32_t edge) { return strip.front()[edge].rank == comm_.rank(); };
  for (std::size_t k = 0; k + 1 < strip.columns(); ++k) {
    const FrontEdge& edge = strip.front()[strip.anchor(k + 1)];
    if (edge.rank != comm_.rank()) continue;
    for (std::size_t row = 0; row < strip.rows(); ++row) {
      grown_->add_cell(edge.leaf, std::array{node(s, {false, k, row}), node(s, {false, k + 1, row}),
                                             node(s, {false, k + 1, row + 1}), node(s, {false, k, row + 1})});
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
