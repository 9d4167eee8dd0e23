#include "mesher/delaunay/restore/star_halo.hpp"

#include <algorithm>

namespace quadloop {

StarHalo::StarHalo(const Communicator& comm, const NodeOwners& owners, const Mesh& mesh,
                   const NodeFlags& core, const Known& known)
    : comm_{comm},
      owners_{owners},
      mesh_{mesh},
      known_{known},
      points_{mesh.points},
      copies_{mesh.copies},
      table_(mesh.first_node, mesh.owned_nodes, points_, copies_),
      core_{core},
      moved_{known.moved},
      stars_(mesh.points.size(), Star::unknown) {
  gather_stars();
}

/// Each triangle goes to the owners of its nodes.
void StarHalo::gather_stars() {
  const std::int64_t first = comm_.exclusive_sum(std::ssize(mesh_.triangles));
  const auto in_region = [&](const auto& nodes) {
    return std::any_of(nodes.begin(), nodes.end(), [&](NodeId node) { return core_[node] != 0; });
  };
  const auto count = std::count_if(mesh_.triangles.begin(), mesh_.triangles.end(), in_region);
  triangles_.reserve(count);
  numbers_.reserve(count);
  Outbox<Travelling> to_owners;
  for (std::int64_t i = 0; i < std::ssize(mesh_.triangles); ++i) {
    const auto& nodes = mesh_.triangles[i];
    if (!in_region(nodes)) continue;
    const std::int32_t block = known_.triangle_to_block.empty() ? 0 : known_.triangle_to_block[i];
    share({nodes[0].value(), nodes[1].value(), nodes[2].value()}, first + i, block, to_owners);
  }
  for (const Travelling& triangle : to_owners.deliver(comm_)) add(triangle);
}

/// One of this rank's triangles.
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
    if (owns(node) || stars_[NodeId{node}] != Star::unknown) continue;
    stars_[NodeId{node}] = Star::missing;
    frontier_.push_back(node);
  }
}

void StarHalo::add(const Travelling& triangle) {
  Triangle nodes;
  for (std::size_t k = 0; k < 3; ++k) {
    nodes[k] = table_.local(triangle.nodes[k], triangle.points[k]).value();
    if (static_cast<std::size_t>(nodes[k]) < stars_.size()) continue;
    stars_.push_back(Star::unknown);
    core_.push_back(triangle.core[k]);
    if (!moved_.empty()) moved_.push_back(triangle.moved[k]);
  }
  add(nodes, triangle.number, triangle.block);
}

StarHalo::Travelling StarHalo::travelling(const Triangle& nodes, std::int64_t number,
                                          std::int32_t block) const {
  Travelling t{number, {}, {}, block, {}, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const NodeId node{nodes[k]};
    t.nodes[k] = global(nodes[k]);
    t.points[k] = points_[nodes[k]];
    t.core[k] = core_[node];
    t.moved[k] = moved_.empty() ? 1 : moved_[node];
  }
  return t;
}

/// The triangles around these nodes, which this rank owns, each once.
void StarHalo::answer(int rank, std::span<const GlobalNodeId> nodes, Outbox<Travelling>& answers) const {
  NodeFlags asked(mesh_.owned_nodes, 0);
  for (const GlobalNodeId node : nodes) asked[owners_.local(node)] = 1;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto& t = triangles_[i];
    const auto is_asked = [&](std::int32_t node) { return owns(node) && asked[NodeId{node}] != 0; };
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
      stars_[NodeId{node}] = Star::here;
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

bool StarHalo::at_rim(std::size_t triangle) const {
  const Triangle& nodes = triangles_[triangle];
  return !complete() &&
         std::count_if(nodes.begin(), nodes.end(), [&](std::int32_t node) { return !is_known(node); }) > 1;
}

}  // namespace quadloop
