#include "mesher/build/number_nodes.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t unused = -1, used = -2;

}  // namespace

NodeNumbering::NodeNumbering(const Communicator& comm, const Lattice& lattice, const LeafGraph& graph,
                             const CutForest& cut)
    : lattice_{&lattice},
      graph_{&graph},
      cut_{&cut},
      inner_slots_(cut.states.size(), {unused, unused, unused}),
      listed_slots_(cut.nodes.size(), unused) {
  for (std::int32_t leaf = graph.local_begin(); leaf < graph.local_end(); ++leaf) {
    if (graph.leaf(leaf).x == 0 || graph.leaf(leaf).y == 0)
      border_slots_.push_back({leaf, {unused, unused, unused}});
  }
  mark_used();
  const Exchange exchange(comm, ranks_wanted());
  const auto asked = exchange.deliver(wanted_);
  for (const Request& request : asked) slot_of(request) = used;
  number_owned();
  place_moved();
  first_node_ = comm.exclusive_sum(owned_);
  fetch_copies(exchange, asked);
}

NodeNumbering::Home NodeNumbering::corner_home(std::int32_t owner, std::int64_t x, std::int64_t y) const {
  const Quadrant& o = graph_->leaf(owner);
  const bool at_right = o.x + o.size() == x, at_top = o.y + o.size() == y;
  return {owner, at_right && at_top ? north_east : at_top ? top_middle : right_middle, {}};
}

NodeNumbering::Home NodeNumbering::home_of_place(std::int32_t leaf, int place) const {
  const LeafGraph::Around& around = graph_->around(leaf);
  const Quadrant& q = graph_->leaf(leaf);
  constexpr auto none = LeafGraph::none;
  switch (place) {
    case 0:
      if (around.south_west != none) return corner_home(around.south_west, q.x, q.y);
      if (around.west != none)
        return {around.west_half != none ? around.west_half : around.west, south_east, {}};
      if (around.south != none)
        return {around.south_half != none ? around.south_half : around.south, north_west, {}};
      return {leaf, south_west, {}};
    case 1:
      return around.south != none ? corner_home(around.south, q.x + q.size(), q.y)
                                  : Home{leaf, south_east, {}};
    case 3:
      return around.west != none ? corner_home(around.west, q.x, q.y + q.size()) : Home{leaf, north_west, {}};
    case 4: return {around.south_half, north_east, {}};
    case 5: return {leaf, right_middle, {}};
    case 6: return {leaf, top_middle, {}};
    case 7: return {around.west_half, north_east, {}};
    default: return {leaf, north_east, {}};
  }
}

NodeNumbering::Home NodeNumbering::home_of_cut_node(std::int32_t leaf, const CutLeaf::Node& node) const {
  if (node.place < 8) return home_of_place(leaf, node.place);
  const LeafGraph::Around& around = graph_->around(leaf);
  const Quadrant& q = graph_->leaf(leaf);
  std::int32_t owner = leaf;
  if (node.place == 8) {
    const bool left_half =
        around.south_half != LeafGraph::none && node.position.x < lattice_->x(q.x + q.size() / 2);
    owner = left_half ? around.south_half : around.south;
  } else if (node.place == 11) {
    const bool lower_half =
        around.west_half != LeafGraph::none && node.position.y < lattice_->y(q.y + q.size() / 2);
    owner = lower_half ? around.west_half : around.west;
  }
  return {owner != LeafGraph::none ? owner : leaf, listed, node.position};
}

std::int32_t NodeNumbering::listed_node(std::int32_t leaf, Point position) const {
  const std::int32_t entry = cut_->entry_of[static_cast<std::size_t>(leaf - graph_->local_begin())];
  QUADLOOP_REQUIRE(entry >= 0, "a leaf that is not cut owns a node of the outline");
  const CutForest::Entry& e = cut_->entries[static_cast<std::size_t>(entry)];
  for (std::int32_t n = e.begin.nodes; n < e.end.nodes; ++n) {
    if (cut_->nodes[static_cast<std::size_t>(n)].position == position) return n;
  }
  throw Fault("two leaves disagree on a node of their common side");
}

std::int32_t* NodeNumbering::local_slot(const Home& home) {
  if (home.slot == listed)
    return &listed_slots_[static_cast<std::size_t>(listed_node(home.leaf, home.position))];
  if (home.slot >= north_east)
    return &inner_slots_[static_cast<std::size_t>(home.leaf - graph_->local_begin())]
                        [static_cast<std::size_t>(home.slot - north_east)];
  const auto at = std::lower_bound(border_slots_.begin(), border_slots_.end(), home.leaf,
                                   [](const auto& entry, std::int32_t leaf) { return entry.first < leaf; });
  QUADLOOP_REQUIRE(at != border_slots_.end() && at->first == home.leaf,
                   "a leaf off the root's border owns a lower corner");
  return &at->second[static_cast<std::size_t>(home.slot)];
}

void NodeNumbering::mark(const Home& home) {
  if (graph_->is_local(home.leaf)) {
    *local_slot(home) = used;
  } else {
    wanted_.push_back(request_of(home));
  }
}

/// Whether the leaf is a local inside one: that uses all nodes that it owns, and sees to them itself.
bool NodeNumbering::marks_its_own(std::int32_t leaf) const {
  return graph_->is_local(leaf) &&
         cut_->states[static_cast<std::size_t>(leaf - graph_->local_begin())] == CutForest::State::inside;
}

void NodeNumbering::mark_inside(std::int32_t leaf) {
  const LeafGraph::Around& around = graph_->around(leaf);
  auto& own = inner_slots_[static_cast<std::size_t>(leaf - graph_->local_begin())];
  own[0] = used;
  if (graph_->has_hanging(leaf, LeafGraph::right)) own[1] = used;
  if (graph_->has_hanging(leaf, LeafGraph::top)) own[2] = used;
  if (!marks_its_own(around.south_west)) mark(home_of_place(leaf, 0));
  if (!marks_its_own(around.south)) mark(home_of_place(leaf, 1));
  if (!marks_its_own(around.west)) mark(home_of_place(leaf, 3));
  if (graph_->has_hanging(leaf, LeafGraph::bottom) && !marks_its_own(around.south_half))
    mark(home_of_place(leaf, 4));
  if (graph_->has_hanging(leaf, LeafGraph::left) && !marks_its_own(around.west_half))
    mark(home_of_place(leaf, 7));
}

void NodeNumbering::mark_used() {
  for (std::int32_t leaf = graph_->local_begin(); leaf < graph_->local_end(); ++leaf) {
    const auto local = static_cast<std::size_t>(leaf - graph_->local_begin());
    if (cut_->states[local] == CutForest::State::outside) continue;
    if (cut_->states[local] == CutForest::State::inside) {
      mark_inside(leaf);
      continue;
    }
    const auto entry = static_cast<std::size_t>(cut_->entry_of[local]);
    const CutForest::Mark &begin = cut_->entries[entry].begin, &end = cut_->entries[entry].end;
    const auto mark_node = [&](std::int32_t n) {
      mark(home_of_cut_node(leaf, cut_->nodes[static_cast<std::size_t>(begin.nodes + n)]));
    };
    for (const auto& triangle : CutForest::part(cut_->triangles, begin.triangles, end.triangles))
      std::for_each(triangle.begin(), triangle.end(), mark_node);
    for (const auto& quad : CutForest::part(cut_->quads, begin.quads, end.quads))
      std::for_each(quad.begin(), quad.end(), mark_node);
    for (const auto& edge : CutForest::part(cut_->outline, begin.outline, end.outline)) {
      mark_node(edge.from);
      mark_node(edge.to);
    }
  }
}

std::vector<int> NodeNumbering::ranks_wanted() {
  std::sort(wanted_.begin(), wanted_.end());
  wanted_.erase(std::unique(wanted_.begin(), wanted_.end()), wanted_.end());
  std::vector<int> ranks;
  for (const Request& request : wanted_) ranks.push_back(request.rank);
  return ranks;
}

void NodeNumbering::number_slot(std::int32_t& slot, Point position) {
  if (slot != used) return;
  slot = owned_++;
  points_.push_back(position);
}

void NodeNumbering::number_owned() {
  points_.reserve(cut_->states.size() + cut_->states.size() / 8 + cut_->nodes.size());
  auto border = border_slots_.begin();
  for (std::int32_t leaf = graph_->local_begin(); leaf < graph_->local_end(); ++leaf) {
    const Quadrant& q = graph_->leaf(leaf);
    const std::int64_t s = q.size();
    if (border != border_slots_.end() && border->first == leaf) {
      number_slot(border->second[south_west], lattice_->corner(q.x, q.y));
      number_slot(border->second[south_east], lattice_->corner(q.x + s, q.y));
      number_slot(border->second[north_west], lattice_->corner(q.x, q.y + s));
      ++border;
    }
    const auto local = static_cast<std::size_t>(leaf - graph_->local_begin());
    auto& inner = inner_slots_[local];
    if (inner[0] == used) number_slot(inner[0], lattice_->corner(q.x + s, q.y + s));
    if (inner[1] == used) number_slot(inner[1], lattice_->corner(q.x + s, q.y + s / 2));
    if (inner[2] == used) number_slot(inner[2], lattice_->corner(q.x + s / 2, q.y + s));
    const std::int32_t entry = cut_->entry_of[local];
    if (entry < 0) continue;
    const auto e = static_cast<std::size_t>(entry);
    for (auto n = static_cast<std::size_t>(cut_->entries[e].begin.nodes);
         n < static_cast<std::size_t>(cut_->entries[e].end.nodes); ++n) {
      number_slot(listed_slots_[n], cut_->nodes[n].position);
    }
  }
}

/// Snapped corners are not where the lattice has them.
void NodeNumbering::place_moved() {
  for (const CutForest::Moved& m : cut_->moved) {
    const std::int32_t before = graph_->leaf_at(m.x - 1, m.y - 1), below = graph_->leaf_at(m.x, m.y - 1);
    const std::int32_t left = graph_->leaf_at(m.x - 1, m.y), after = graph_->leaf_at(m.x, m.y);
    Home home{after, south_west, {}};
    if (m.x > 0 && m.y > 0) {
      if (before == LeafGraph::none) continue;
      home = corner_home(before, m.x, m.y);
    } else if (m.x > 0) {
      home = {left, south_east, {}};
    } else if (m.y > 0) {
      home = {below, north_west, {}};
    }
    if (!graph_->is_local(home.leaf)) continue;
    const std::int32_t node = *local_slot(home);
    if (node >= 0) points_[static_cast<std::size_t>(node)] = m.position;
  }
}

void NodeNumbering::fetch_copies(const Exchange& exchange, const std::vector<Request>& asked) {
  struct Answer {
    std::int64_t number;
    Point position;
  };
  std::vector<Answer> answers;
  for (const Request& request : asked) {
    const std::int32_t node = slot_of(request);
    answers.push_back({first_node_ + node, points_[static_cast<std::size_t>(node)]});
  }
  for (const Answer& answer : exchange.answer(answers)) {
    copies_.push_back(GlobalNodeId{answer.number});
    points_.push_back(answer.position);
  }
}

NodeId NodeNumbering::find(const Home& home) const {
  if (graph_->is_local(home.leaf)) return NodeId{*local_slot(home)};
  const auto at = std::lower_bound(wanted_.begin(), wanted_.end(), request_of(home));
  return NodeId{owned_ + static_cast<std::int32_t>(at - wanted_.begin())};
}

NodeId NodeNumbering::of_leaf(std::int32_t leaf, int place) const { return find(home_of_place(leaf, place)); }

NodeId NodeNumbering::of_cut(std::int32_t leaf, std::int32_t node) const {
  return find(home_of_cut_node(leaf, cut_->nodes[static_cast<std::size_t>(node)]));
}

void NodeNumbering::fill(Mesh& mesh) && {
  mesh.points = std::move(points_);
  mesh.first_node = first_node_;
  mesh.owned_nodes = owned_;
  mesh.copies = std::move(copies_);
}

}  // namespace quadloop
