#include "mesher/build/number_nodes.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/forest/leaf_finder.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t unused = -1, used = -2;

/// What leaves own beside their cut nodes, in the order of its numbers: leaves on the root's lower or left
/// side the former too.
constexpr std::array border_sites{Site::south_west, Site::south_east, Site::north_west};
constexpr std::array owned_sites{Site::north_east, Site::right_middle, Site::top_middle};

std::size_t index_in(const std::array<Site, 3>& sites, Site site) {
  return std::find(sites.begin(), sites.end(), site) - sites.begin();
}

}  // namespace

NodeNumbering::NodeNumbering(const Communicator& comm, const Lattice& lattice, const LeafGraph& graph,
                             const CutForest& cut)
    : lattice_{&lattice}, graph_{&graph}, cut_{&cut} {
  for (const LeafId leaf : graph.local()) {
    if (graph.leaf(leaf).x == 0 || graph.leaf(leaf).y == 0) border_leaves_.push_back(leaf);
  }
  slots_.assign(border_slot(border_leaves_.size()) + cut.nodes.size(), unused);
  use_nodes_of_cells();
  const Exchange exchange(comm, ranks_wanted());
  const auto asked = exchange.deliver(wanted_);
  for (const Request& request : asked) slot_at(home_of(request)) = used;
  number_owned();
  place_moved();
  first_node_ = comm.exclusive_sum(owned_);
  fetch_copies(exchange, asked);
}

NodeNumbering::Home NodeNumbering::corner_home(LeafId owner, LatticePoint p) const {
  const Quadrant& o = graph_->leaf(owner);
  const bool at_right = o.x + o.size() == p.x, at_top = o.y + o.size() == p.y;
  return {owner, at_right && at_top ? Site::north_east : at_top ? Site::top_middle : Site::right_middle, {}};
}

NodeNumbering::Home NodeNumbering::home_of_site(LeafId leaf, Site site) const {
  const LeafGraph::Around& around = graph_->around(leaf);
  const Quadrant& q = graph_->leaf(leaf);
  constexpr auto none = LeafGraph::none;
  switch (site) {
    case Site::south_west:
      if (around.south_west != none) return corner_home(around.south_west, q.at(site));
      if (around.west != none)
        return {around.west_half != none ? around.west_half : around.west, Site::south_east, {}};
      if (around.south != none)
        return {around.south_half != none ? around.south_half : around.south, Site::north_west, {}};
      return {leaf, Site::south_west, {}};
    case Site::south_east:
      return around.south != none ? corner_home(around.south, q.at(site)) : Home{leaf, Site::south_east, {}};
    case Site::north_west:
      return around.west != none ? corner_home(around.west, q.at(site)) : Home{leaf, Site::north_west, {}};
    case Site::bottom_middle: return {around.south_half, Site::north_east, {}};
    case Site::right_middle: return {leaf, Site::right_middle, {}};
    case Site::top_middle: return {leaf, Site::top_middle, {}};
    case Site::left_middle: return {around.west_half, Site::north_east, {}};
    default: return {leaf, Site::north_east, {}};
  }
}

NodeNumbering::Home NodeNumbering::home_of_cut_node(LeafId leaf, const CutLeaf::Node& node) const {
  if (is_on_lattice(node.site)) return home_of_site(leaf, node.site);
  const LeafGraph::Around& around = graph_->around(leaf);
  const Quadrant& q = graph_->leaf(leaf);
  LeafId owner = leaf;
  if (node.site == Site::on_bottom) {
    const bool left_half =
        around.south_half != LeafGraph::none && node.position.x < lattice_->x(q.x + q.size() / 2);
    owner = left_half ? around.south_half : around.south;
  } else if (node.site == Site::on_left) {
    const bool lower_half =
        around.west_half != LeafGraph::none && node.position.y < lattice_->y(q.y + q.size() / 2);
    owner = lower_half ? around.west_half : around.west;
  }
  return {owner != LeafGraph::none ? owner : leaf, Site::inside, node.position};
}

std::int32_t NodeNumbering::listed_node(LeafId leaf, Point position) const {
  const std::int32_t entry = cut_->entry_of[graph_->local_index(leaf)];
  QUADLOOP_REQUIRE(entry >= 0, "a leaf that is not cut owns a node of the outline");
  const CutForest::Entry& e = cut_->entries[entry];
  for (std::int32_t n = e.begin.nodes; n < e.end.nodes; ++n) {
    if (cut_->nodes[n].position == position) return n;
  }
  throw Fault("two leaves disagree on a node of their common side");
}

std::size_t NodeNumbering::listed_slot(std::int32_t node) const {
  return border_slot(border_leaves_.size()) + node;
}

std::size_t NodeNumbering::slot_of(const Home& home) const {
  if (home.site == Site::inside) return listed_slot(listed_node(home.leaf, home.position));
  const std::size_t owned = index_in(owned_sites, home.site);
  if (owned < owned_sites.size()) return std::size_t{3} * graph_->local_index(home.leaf) + owned;
  const auto at = std::lower_bound(border_leaves_.begin(), border_leaves_.end(), home.leaf);
  QUADLOOP_REQUIRE(at != border_leaves_.end() && *at == home.leaf,
                   "a leaf off the root's border owns a lower corner");
  return border_slot(at - border_leaves_.begin()) + index_in(border_sites, home.site);
}

void NodeNumbering::use(const Home& home) {
  if (graph_->is_local(home.leaf)) {
    slot_at(home) = used;
  } else {
    wanted_.push_back(request_of(home));
  }
}

/// Whether the leaf is a local inside one: that uses all nodes that it owns, and sees to them itself.
bool NodeNumbering::uses_its_own(LeafId leaf) const {
  return graph_->is_local(leaf) && cut_->states[graph_->local_index(leaf)] == CutForest::State::inside;
}

void NodeNumbering::use_nodes_of_inside(LeafId leaf) {
  const LeafGraph::Around& around = graph_->around(leaf);
  slot_at({leaf, Site::north_east, {}}) = used;
  if (graph_->has_hanging(leaf, Side::right)) slot_at({leaf, Site::right_middle, {}}) = used;
  if (graph_->has_hanging(leaf, Side::top)) slot_at({leaf, Site::top_middle, {}}) = used;
  if (!uses_its_own(around.south_west)) use(home_of_site(leaf, Site::south_west));
  if (!uses_its_own(around.south)) use(home_of_site(leaf, Site::south_east));
  if (!uses_its_own(around.west)) use(home_of_site(leaf, Site::north_west));
  if (graph_->has_hanging(leaf, Side::bottom) && !uses_its_own(around.south_half))
    use(home_of_site(leaf, Site::bottom_middle));
  if (graph_->has_hanging(leaf, Side::left) && !uses_its_own(around.west_half))
    use(home_of_site(leaf, Site::left_middle));
}

void NodeNumbering::use_nodes_of_cells() {
  for (const LeafId leaf : graph_->local()) {
    const std::size_t local = graph_->local_index(leaf);
    if (cut_->states[local] == CutForest::State::outside) continue;
    if (cut_->states[local] == CutForest::State::inside) {
      use_nodes_of_inside(leaf);
      continue;
    }
    const std::size_t entry = cut_->entry_of[local];
    const CutForest::Offsets &begin = cut_->entries[entry].begin, &end = cut_->entries[entry].end;
    const auto use_node = [&](std::int32_t n) { use(home_of_cut_node(leaf, cut_->nodes[begin.nodes + n])); };
    for (const auto& triangle : CutForest::part(cut_->triangles, begin.triangles, end.triangles))
      std::for_each(triangle.begin(), triangle.end(), use_node);
    for (const auto& quad : CutForest::part(cut_->quads, begin.quads, end.quads))
      std::for_each(quad.begin(), quad.end(), use_node);
    for (const auto& edge : CutForest::part(cut_->outline, begin.outline, end.outline)) {
      use_node(edge.from);
      use_node(edge.to);
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

void NodeNumbering::number_slot(std::size_t slot, Point position) {
  if (slots_[slot] != used) return;
  slots_[slot] = owned_++;
  points_.push_back(position);
}

void NodeNumbering::number_owned() {
  points_.reserve(std::count(slots_.begin(), slots_.end(), used) + cut_->nodes.size());
  std::size_t border = 0;
  for (const LeafId leaf : graph_->local()) {
    const Quadrant& q = graph_->leaf(leaf);
    const auto number = [&](std::size_t first, const std::array<Site, 3>& sites) {
      for (std::size_t i = 0; i < sites.size(); ++i) {
        if (slots_[first + i] == used) number_slot(first + i, lattice_->corner(q.at(sites[i])));
      }
    };
    if (border < border_leaves_.size() && border_leaves_[border] == leaf)
      number(border_slot(border++), border_sites);
    number(3 * static_cast<std::size_t>(graph_->local_index(leaf)), owned_sites);
    const std::int32_t entry = cut_->entry_of[graph_->local_index(leaf)];
    if (entry < 0) continue;
    const CutForest::Entry& e = cut_->entries[entry];
    for (std::int32_t n = e.begin.nodes; n < e.end.nodes; ++n)
      number_slot(listed_slot(n), cut_->nodes[n].position);
  }
}

/// Snapped corners are not where the lattice has them.
void NodeNumbering::place_moved() {
  LeafFinder finder(*graph_);
  for (const CutForest::Moved& m : cut_->moved) {
    const auto [before, below, after, left] = finder.leaves_round(m.corner);
    Home home{after, Site::south_west, {}};
    if (m.corner.x > 0 && m.corner.y > 0) {
      if (before == LeafGraph::none) continue;
      home = corner_home(before, m.corner);
    } else if (m.corner.x > 0) {
      home = {left, Site::south_east, {}};
    } else if (m.corner.y > 0) {
      home = {below, Site::north_west, {}};
    }
    if (!graph_->is_local(home.leaf)) continue;
    const std::int32_t node = slot_at(home);
    if (node >= 0) points_[node] = m.position;
  }
}

void NodeNumbering::fetch_copies(const Exchange& exchange, const std::vector<Request>& asked) {
  struct Answer {
    std::int64_t number;
    Point position;
  };
  std::vector<Answer> answers;
  for (const Request& request : asked) {
    const std::int32_t node = slot_at(home_of(request));
    answers.push_back({first_node_ + node, points_[node]});
  }
  for (const Answer& answer : exchange.answer(answers)) {
    copies_.push_back(GlobalNodeId{answer.number});
    points_.push_back(answer.position);
  }
}

NodeId NodeNumbering::find(const Home& home) const {
  if (graph_->is_local(home.leaf)) return NodeId{slots_[slot_of(home)]};
  const auto at = std::lower_bound(wanted_.begin(), wanted_.end(), request_of(home));
  return NodeId{owned_ + static_cast<std::int32_t>(at - wanted_.begin())};
}

NodeId NodeNumbering::of_leaf(LeafId leaf, Site site) const { return find(home_of_site(leaf, site)); }

NodeId NodeNumbering::of_cut(LeafId leaf, std::int32_t node) const {
  return find(home_of_cut_node(leaf, cut_->nodes[node]));
}

void NodeNumbering::fill(Mesh& mesh) && {
  mesh.points = std::move(points_);
  mesh.first_node = first_node_;
  mesh.owned_nodes = owned_;
  mesh.copies = std::move(copies_);
}

}  // namespace quadloop
