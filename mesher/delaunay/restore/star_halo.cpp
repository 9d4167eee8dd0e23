#include "mesher/delaunay/restore/star_halo.hpp"

#include <algorithm>

namespace quadloop {

StarHalo::StarHalo(const Communicator& comm, const NodeOwners& owners, std::vector<NumberedTriangle> own)
    : comm_{comm}, owners_{owners} {
  if (comm.size() == 1) {
    triangles_ = std::move(own);
    return;
  }
  gather_stars(own);
  list_spokes();
}

void StarHalo::list_spokes() {
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (const GlobalNodeId node : triangles_[t].nodes) {
      if (owns(node)) spokes_.push_back({node, t});
    }
  }
  std::sort(spokes_.begin(), spokes_.end());
}

/// Each triangle goes to the owners of its nodes.
void StarHalo::gather_stars(std::span<const NumberedTriangle> own) {
  Outbox<NumberedTriangle> to_owners;
  triangles_.reserve(own.size());
  for (const NumberedTriangle& triangle : own) {
    std::array<int, 3> ranks{};
    for (std::size_t k = 0; k < 3; ++k) ranks[k] = owners_.rank_of(triangle.nodes[k]);
    std::sort(ranks.begin(), ranks.end());
    const auto end = std::unique(ranks.begin(), ranks.end());
    for (auto rank = ranks.begin(); rank != end; ++rank) {
      if (*rank == comm_.rank()) {
        add(triangle);
      } else {
        to_owners.add(*rank, triangle);
      }
    }
  }
  for (const NumberedTriangle& triangle : to_owners.deliver(comm_)) add(triangle);
}

void StarHalo::add(const NumberedTriangle& triangle) {
  if (!numbers_.insert(triangle.number).second) return;
  triangles_.push_back(triangle);
  for (const GlobalNodeId node : triangle.nodes) {
    if (!known(node)) frontier_.insert(node);
  }
}

/// The triangles around owned nodes, each once.
std::vector<NumberedTriangle> StarHalo::around(std::span<const GlobalNodeId> nodes) const {
  std::vector<std::size_t> indices;
  for (const GlobalNodeId node : nodes) {
    auto spoke = std::lower_bound(spokes_.begin(), spokes_.end(), Spoke{node, 0});
    for (; spoke != spokes_.end() && spoke->node == node; ++spoke) indices.push_back(spoke->triangle);
  }
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  std::vector<NumberedTriangle> found;
  found.reserve(indices.size());
  for (const std::size_t i : indices) found.push_back(triangles_[i]);
  return found;
}

void StarHalo::grow(bool wanted) {
  std::vector<GlobalNodeId> nodes;
  std::vector<int> owners;
  if (wanted) {
    nodes.assign(frontier_.begin(), frontier_.end());
    for (const GlobalNodeId node : nodes) owners.push_back(owners_.rank_of(node));
    fetched_.insert(frontier_.begin(), frontier_.end());
    frontier_.clear();
  }
  const Exchange questions(comm_, owners);
  nodes = questions.deliver(nodes);
  Outbox<NumberedTriangle> answers;
  for (const Exchange::Source& asking : questions.sources()) {
    for (const NumberedTriangle& triangle : around(std::span(nodes).subspan(asking.begin, asking.size())))
      answers.add(asking.rank, triangle);
  }
  for (const NumberedTriangle& triangle : answers.deliver(comm_)) add(triangle);
}

bool StarHalo::at_rim(const NumberedTriangle& triangle) const {
  if (complete()) return false;
  return std::count_if(triangle.nodes.begin(), triangle.nodes.end(),
                       [&](GlobalNodeId node) { return !known(node); }) > 1;
}

}  // namespace quadloop
