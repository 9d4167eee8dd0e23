#include "mesher/delaunay/restore/star_halo.hpp"

#include <algorithm>

namespace quadloop {

namespace {

constexpr std::int32_t unnumbered = -1;

}  // namespace

StarHalo::StarHalo(const Communicator& comm, const NodeOwners& owners, const Mesh& mesh,
                   const NodeFlags& core, const Known& known, const std::vector<GlobalEdge>& of_lines)
    : comm_{comm},
      owners_{owners},
      mesh_{mesh},
      known_{known},
      of_lines_{of_lines},
      number_of_owned_(mesh.owned_nodes, unnumbered) {
  gather_stars(core);
}

/// Sends each triangle to the owners of its nodes.
void StarHalo::gather_stars(const NodeFlags& core) {
  const std::int64_t first = comm_.exclusive_sum(std::ssize(mesh_.triangles));
  std::vector<std::int32_t> region;
  for (std::int32_t i = 0; i < std::ssize(mesh_.triangles); ++i) {
    if (any_flagged(core, mesh_.triangles[i])) region.push_back(i);
  }
  triangles_.reserve(region.size());
  numbers_.reserve(region.size());
  nodes_.reserve(region.size());
  points_.reserve(region.size());
  Outbox<Travelling> to_owners;
  for (const std::int32_t i : region) {
    const auto& triangle = mesh_.triangles[i];
    Triangle nodes;
    for (std::size_t k = 0; k < 3; ++k) nodes[k] = number_node(triangle[k], core);
    const std::int32_t block = known_.triangle_to_block.empty() ? 0 : known_.triangle_to_block[i];
    const bool all_own = std::ranges::all_of(triangle, [&](NodeId node) { return mesh_.owns(node); });
    if (all_own) add(nodes, first + i, block);
    if (!all_own) share(nodes, first + i, block, to_owners);
  }
  for (const Travelling& triangle : to_owners.deliver(comm_)) add(triangle);
}

std::int32_t StarHalo::number_node(GlobalNodeId node, Point point, char core, char moved) {
  const bool is_own = owns(node);
  std::int32_t& number = is_own ? number_of_owned_[node.value() - mesh_.first_node]
                                : number_of_other_.try_emplace(node, unnumbered).first->second;
  if (number != unnumbered) return number;
  number = size32(nodes_);
  nodes_.push_back(node);
  points_.push_back(point);
  core_.push_back(core);
  if (!known_.moved.empty()) moved_.push_back(moved);
  stars_.push_back(is_own ? Star::here : Star::unknown);
  return number;
}

/// Handles one of this rank's triangles.
void StarHalo::share(const Triangle& nodes, std::int64_t number, std::int32_t block,
                     Outbox<Travelling>& to_owners) {
  if (has_owned(nodes)) add(nodes, number, block);
  std::array<int, 3> ranks{};
  for (std::size_t k = 0; k < 3; ++k) {
    ranks[k] = owns(nodes[k]) ? comm_.rank() : owners_.rank_of(global(nodes[k]));
    const auto end = ranks.begin() + k;
    if (ranks[k] != comm_.rank() && std::find(ranks.begin(), end, ranks[k]) == end)
      to_owners.add(ranks[k], travelling(nodes, number, block));
  }
}

void StarHalo::add(const Triangle& nodes, std::int64_t number, std::int32_t block) {
  triangles_.push_back(nodes);
  numbers_.push_back(number);
  if (!known_.triangle_to_block.empty()) blocks_.push_back(block);
  for (const std::int32_t node : nodes) {
    if (stars_[node] != Star::unknown) continue;
    stars_[node] = Star::missing;
    frontier_.push_back(node);
  }
}

void StarHalo::add(const Travelling& triangle) {
  Triangle nodes;
  for (std::size_t k = 0; k < 3; ++k)
    nodes[k] = number_node(triangle.nodes[k], triangle.points[k], triangle.core[k], triangle.moved[k]);
  add(nodes, triangle.number, triangle.block);
}

StarHalo::Travelling StarHalo::travelling(const Triangle& nodes, std::int64_t number,
                                          std::int32_t block) const {
  Travelling t{number, {}, {}, block, {}, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    t.nodes[k] = global(nodes[k]);
    t.points[k] = points_[nodes[k]];
    t.core[k] = core_[nodes[k]];
    t.moved[k] = known_.moved.empty() ? 1 : moved_[nodes[k]];
  }
  return t;
}

/// Returns the triangles around these nodes, which this rank owns, each once.
void StarHalo::answer(int rank, std::span<const GlobalNodeId> nodes, Outbox<Travelling>& answers) const {
  std::vector<char> asked(nodes_.size(), 0);
  for (const GlobalNodeId node : nodes) {
    const std::int32_t number = number_of_owned_[owners_.local(node).value()];
    if (number != unnumbered) asked[number] = 1;
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto& t = triangles_[i];
    const auto is_asked = [&](std::int32_t node) { return asked[node] != 0; };
    if (std::any_of(t.begin(), t.end(), is_asked))
      answers.add(rank, travelling(t, numbers_[i], blocks_.empty() ? 0 : blocks_[i]));
  }
}

void StarHalo::grow(bool wanted) {
  std::vector<GlobalNodeId> nodes;
  std::vector<int> owners;
  if (wanted) {
    for (const std::int32_t node : frontier_) {
      nodes.push_back(global(node));
      owners.push_back(owners_.rank_of(nodes.back()));
      stars_[node] = Star::here;
    }
    frontier_.clear();
  }
  const Exchange questions(comm_, owners);
  nodes = questions.deliver(nodes);
  Outbox<Travelling> answers;
  for (const Exchange::Source& asking : questions.sources())
    answer(asking.rank, std::span(nodes).subspan(asking.begin, asking.size()), answers);
  for (const Travelling& t : answers.deliver(comm_)) {
    const bool is_around_own = std::any_of(t.nodes.begin(), t.nodes.end(), [&](GlobalNodeId node) {
      return owners_.rank_of(node) == comm_.rank();
    });
    if (!is_around_own && fetched_.insert(t.number).second) add(t);
  }
}

std::vector<Flipper::Ends> StarHalo::kept_edges() const {
  const auto number_of = [&](GlobalNodeId node) {
    if (owns(node)) return number_of_owned_[node.value() - mesh_.first_node];
    const auto found = number_of_other_.find(node);
    return found == number_of_other_.end() ? unnumbered : found->second;
  };
  std::vector<Flipper::Ends> edges;
  for (const auto& [from, to] : of_lines_) {
    const std::int32_t a = number_of(from), b = number_of(to);
    if (a != unnumbered && b != unnumbered) edges.push_back({std::min(a, b), std::max(a, b)});
  }
  std::ranges::sort(edges);
  return edges;
}

bool StarHalo::at_rim(std::size_t triangle) const {
  const Triangle& nodes = triangles_[triangle];
  return !complete() &&
         std::count_if(nodes.begin(), nodes.end(), [&](std::int32_t node) { return !is_known(node); }) > 1;
}

}  // namespace quadloop
