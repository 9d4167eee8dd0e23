#include "mesher/forest/leaf_exchange.hpp"

namespace quadloop {

namespace {

std::vector<GhostExchange::Copy> ghosts_of(const LeafGraph& graph) {
  std::vector<GhostExchange::Copy> ghosts;
  for (const LeafId leaf : graph.all()) {
    if (!graph.is_local(leaf))
      ghosts.push_back({leaf.value(), graph.owner_of(leaf).rank, graph.owner_of(leaf).index});
  }
  return ghosts;
}

}  // namespace

LeafExchange::LeafExchange(const Communicator& comm, const LeafGraph& graph)
    : GhostExchange(comm, ghosts_of(graph), graph.local_begin()) {}

}  // namespace quadloop
