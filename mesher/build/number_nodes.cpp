#include "mesher/build/number_nodes.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/forest/leaf_finder.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t unused = -1, used = -2;

/// Sites of the nodes that leaves own in addition to their cut nodes, in the order of their numbers; the
/// first three only at the root's lower or left side.
constexpr std::array owned_sites{Site::south_west, Site::south_east,   Site::north_west,
                                 Site::north_east, Site::right_middle, Site::top_middle};

constexpr std::uint8_t bit_of(Site site) {
  constexpr std::array<std::uint8_t, grid_sites.size()> bits{1, 2, 8, 4, 0, 16, 32, 0};
  return bits[index_of(site)];
}
static_assert(bit_of(Site::north_west) == 1 << 2 && bit_of(Site::top_middle) == 1 << 5);

/// Number of elements of each set of owned sites; a population count instruction is not available everywhere.
constexpr auto sizes_of_sets = [] {
  std::array<std::uint8_t, 1 << owned_sites.size()> sizes{};
  for (std::size_t set = 0; set < sizes.size(); ++set)
    sizes[set] = static_cast<std::uint8_t>(std::popcount(set));
  return sizes;
}();

/// Whether the leaf has enough nodes for sorting to pay off: few are searched linearly.
bool has_many(const CutForest::Entry& entry) { return entry.end.nodes - entry.begin.nodes > 32; }

}  // namespace

NodeNumbering::NodeNumbering(const Communicator& comm, const TreeGrid& grid, const LeafGraph& graph,
                             const CutForest& cut)
    : grid_{&grid},
      graph_{&graph},
      cut_{&cut},
      used_sites_(cut.states.size(), 0),
      first_(cut.states.size()),
      listed_(cut.nodes.size(), unused) {
  sort_listed();
  use_nodes_of_cells();
  const Exchange exchange(comm, ranks_wanted());
  const auto asked = exchange.deliver(wanted_);
  for (const Request& request : asked) use_local(home_of(request), request.position);
  number_owned();
  place_moved();
  first_node_ = comm.exclusive_sum(owned_);
  fetch_ghosts(exchange, asked);
}

NodeNumbering::Home NodeNumbering::corner_home(LeafId owner, GridPoint p) const {
  const Quadrant& o = graph_->leaf(owner);
  const bool at_right = o.x + o.size() == p.x, at_top = o.y + o.size() == p.y;
  return {owner, at_right && at_top ? Site::north_east : at_top ? Site::top_middle : Site::right_middle};
}

NodeNumbering::Home NodeNumbering::home_of_site(LeafId leaf, Site site) const {
  const LeafGraph::Around& around = graph_->around(leaf);
  const Quadrant& q = graph_->leaf(leaf);
  constexpr auto none = LeafGraph::none;
  switch (site) {
    case Site::south_west:
      if (around.south_west != none) return corner_home(around.south_west, q.at(site));
      if (around.west != none)
        return {around.west_half != none ? around.west_half : around.west, Site::south_east};
      if (around.south != none)
        return {around.south_half != none ? around.south_half : around.south, Site::north_west};
      return {leaf, Site::south_west};
    case Site::south_east:
      return around.south != none ? corner_home(around.south, q.at(site)) : Home{leaf, Site::south_east};
    case Site::north_west:
      return around.west != none ? corner_home(around.west, q.at(site)) : Home{leaf, Site::north_west};
    case Site::bottom_middle: return {around.south_half, Site::north_east};
    case Site::right_middle: return {leaf, Site::right_middle};
    case Site::top_middle: return {leaf, Site::top_middle};
    case Site::left_middle: return {around.west_half, Site::north_east};
    default: return {leaf, Site::north_east};
  }
}

NodeNumbering::Home NodeNumbering::home_of_cut_node(LeafId leaf, const CutLeaf::Node& node) const {
  if (is_on_grid(node.site)) return home_of_site(leaf, node.site);
  const LeafGraph::Around& around = graph_->around(leaf);
  const Quadrant& q = graph_->leaf(leaf);
  LeafId owner = leaf;
  if (node.site == Site::on_bottom) {
    const bool left_half =
        around.south_half != LeafGraph::none && node.position.x < grid_->x(q.x + q.size() / 2);
    owner = left_half ? around.south_half : around.south;
  } else if (node.site == Site::on_left) {
    const bool lower_half =
        around.west_half != LeafGraph::none && node.position.y < grid_->y(q.y + q.size() / 2);
    owner = lower_half ? around.west_half : around.west;
  }
  return {owner != LeafGraph::none ? owner : leaf, Site::inside};
}

/// Sorts the nodes of leaves with many nodes by position.
void NodeNumbering::sort_listed() {
  for (const CutForest::Entry& e : cut_->entries) {
    if (!has_many(e)) continue;
    by_position_.resize(cut_->nodes.size());
    const auto own = std::span(by_position_).subspan(e.begin.nodes, e.end.nodes - e.begin.nodes);
    std::iota(own.begin(), own.end(), e.begin.nodes);
    std::ranges::sort(own, {}, [&](std::int32_t n) { return std::pair(cut_->nodes[n].position, n); });
  }
}

std::int32_t NodeNumbering::listed_node(LeafId leaf, Point position) const {
  const std::int32_t entry = cut_->entry_of[graph_->local_index(leaf)];
  QUADLOOP_REQUIRE(entry >= 0, "a leaf that is not cut owns a node of the outline", position.x, position.y);
  const CutForest::Entry& e = cut_->entries[entry];
  std::int32_t node = e.begin.nodes;
  if (has_many(e)) {
    const auto own = std::span(by_position_).subspan(e.begin.nodes, e.end.nodes - e.begin.nodes);
    const auto at =
        std::ranges::lower_bound(own, position, {}, [&](std::int32_t n) { return cut_->nodes[n].position; });
    node = at != own.end() ? *at : e.end.nodes;
  } else {
    while (node < e.end.nodes && cut_->nodes[node].position != position) ++node;
  }
  QUADLOOP_REQUIRE(node < e.end.nodes && cut_->nodes[node].position == position,
                   "two leaves disagree on a node of their common side");
  return node;
}

void NodeNumbering::use(Home home, Point position) {
  if (graph_->is_local(home.leaf)) {
    use_local(home, position);
  } else {
    wanted_.push_back(request_of(home, position));
  }
}

void NodeNumbering::use_local(Home home, Point position) {
  if (home.site == Site::inside) {
    listed_[listed_node(home.leaf, position)] = used;
  } else {
    used_sites_[graph_->local_index(home.leaf)] |= bit_of(home.site);
  }
}

/// Flags a leaf's node of CutForest::nodes as used.
void NodeNumbering::use_cut(LeafId leaf, std::int32_t node) {
  if (listed_[node] == used) return;
  const Home home = home_of_cut_node(leaf, cut_->nodes[node]);
  if (home.leaf == leaf && home.site == Site::inside) {
    listed_[node] = used;
  } else {
    use(home, cut_->nodes[node].position);
  }
}

/// Whether the leaf is a local inner one, which uses all nodes that it owns and registers them itself.
bool NodeNumbering::uses_its_own(LeafId leaf) const {
  return graph_->is_local(leaf) && cut_->states[graph_->local_index(leaf)] == CutForest::State::inside;
}

void NodeNumbering::use_nodes_of_inside(LeafId leaf) {
  const LeafGraph::Around& around = graph_->around(leaf);
  std::uint8_t& own = used_sites_[graph_->local_index(leaf)];
  own |= bit_of(Site::north_east);
  if (around.finer.contains(Side::right)) own |= bit_of(Site::right_middle);
  if (around.finer.contains(Side::top)) own |= bit_of(Site::top_middle);
  if (!uses_its_own(around.south_west)) use(home_of_site(leaf, Site::south_west));
  if (!uses_its_own(around.south)) use(home_of_site(leaf, Site::south_east));
  if (!uses_its_own(around.west)) use(home_of_site(leaf, Site::north_west));
  if (around.finer.contains(Side::bottom) && !uses_its_own(around.south_half))
    use(home_of_site(leaf, Site::bottom_middle));
  if (around.finer.contains(Side::left) && !uses_its_own(around.west_half))
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
    const auto use_node = [&](std::int32_t n) { use_cut(leaf, begin.nodes + n); };
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

void NodeNumbering::number_owned() {
  std::size_t count = std::count(listed_.begin(), listed_.end(), used);
  for (const std::uint8_t sites : used_sites_) count += sizes_of_sets[sites];
  points_.reserve(count + wanted_.size());
  for (const LeafId leaf : graph_->local()) {
    const std::size_t local = graph_->local_index(leaf);
    const Quadrant& q = graph_->leaf(leaf);
    first_[local] = size32(points_);
    for (unsigned sites = used_sites_[local]; sites != 0; sites &= sites - 1)
      points_.push_back(grid_->corner(q.at(owned_sites[std::countr_zero(sites)])));
    const std::int32_t entry = cut_->entry_of[local];
    if (entry < 0) continue;
    const CutForest::Entry& e = cut_->entries[entry];
    for (std::int32_t n = e.begin.nodes; n < e.end.nodes; ++n) {
      if (listed_[n] != used) continue;
      listed_[n] = size32(points_);
      points_.push_back(cut_->nodes[n].position);
    }
  }
  owned_ = size32(points_);
}

/// Moves the snapped corners from their grid positions.
void NodeNumbering::place_moved() {
  LeafFinder finder(*graph_);
  for (const auto& [corner, position] : cut_->moved) {
    const bool on_left = corner.x == 0, on_bottom = corner.y == 0;
    const LeafId owner =
        finder.leaf_at(on_left ? corner.x : corner.x - 1, on_bottom ? corner.y : corner.y - 1);
    if (!graph_->is_local(owner)) continue;
    const Home home = on_left && on_bottom ? Home{owner, Site::south_west}
                      : on_bottom          ? Home{owner, Site::south_east}
                      : on_left            ? Home{owner, Site::north_west}
                                           : corner_home(owner, corner);
    const bool is_node = (used_sites_[graph_->local_index(owner)] & bit_of(home.site)) != 0;
    if (is_node) points_[number_at_site(home)] = position;
  }
}

void NodeNumbering::fetch_ghosts(const Exchange& exchange, const std::vector<Request>& asked) {
  struct Answer {
    std::int64_t number;
    Point position;
  };
  std::vector<Answer> answers;
  for (const Request& request : asked) {
    const std::int32_t node = number_at(home_of(request), request.position);
    answers.push_back({first_node_ + node, points_[node]});
  }
  for (const Answer& answer : exchange.answer(answers)) {
    ghosts_.push_back(GlobalNodeId{answer.number});
    points_.push_back(answer.position);
  }
}

/// Returns the number of a local node.
std::int32_t NodeNumbering::number_at(Home home, Point position) const {
  return home.site == Site::inside ? listed_[listed_node(home.leaf, position)] : number_at_site(home);
}

/// Returns the number of a local node that is not listed.
std::int32_t NodeNumbering::number_at_site(Home home) const {
  const std::size_t local = graph_->local_index(home.leaf);
  const int before = used_sites_[local] & (bit_of(home.site) - 1);
  return first_[local] + sizes_of_sets[before];
}

NodeId NodeNumbering::find(Home home, Point position) const {
  if (graph_->is_local(home.leaf)) return NodeId{number_at(home, position)};
  const auto at = std::lower_bound(wanted_.begin(), wanted_.end(), request_of(home, position));
  return NodeId{owned_ + static_cast<std::int32_t>(at - wanted_.begin())};
}

bool NodeNumbering::owns_one(LeafId leaf) const {
  return graph_->is_local(leaf) && sizes_of_sets[used_sites_[graph_->local_index(leaf)]] == 1;
}

NodeNumbering::SiteNodes NodeNumbering::of_leaf(LeafId leaf) const {
  SiteNodes nodes;
  const LeafGraph::Around& around = graph_->around(leaf);
  const auto set = [&](Site site) { nodes[index_of(site)] = find(home_of_site(leaf, site)); };
  const auto set_corner = [&](Site site, LeafId owner) {
    if (owns_one(owner)) {
      nodes[index_of(site)] = NodeId{first_[graph_->local_index(owner)]};
    } else {
      set(site);
    }
  };
  set_corner(Site::south_west, around.south_west);
  set_corner(Site::south_east, around.south);
  set_corner(Site::north_east, leaf);
  set_corner(Site::north_west, around.west);
  if (around.finer.empty()) return nodes;
  for (const Side side : all_sides) {
    if (around.finer.contains(side)) set(middle_of(side));
  }
  return nodes;
}

NodeId NodeNumbering::of_cut(LeafId leaf, std::int32_t node) const {
  const CutLeaf::Node& n = cut_->nodes[node];
  const Home home = home_of_cut_node(leaf, n);
  return home.leaf == leaf && home.site == Site::inside ? NodeId{listed_[node]} : find(home, n.position);
}

void NodeNumbering::fill(Mesh& mesh) && {
  mesh.points = std::move(points_);
  mesh.first_node = first_node_;
  mesh.owned_nodes = owned_;
  mesh.ghosts = std::move(ghosts_);
}

}  // namespace quadloop
