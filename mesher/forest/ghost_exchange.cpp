#include "mesher/forest/ghost_exchange.hpp"

namespace quadloop {

namespace {

std::vector<CopyExchange::Copy> ghosts_of(const LeafGraph& graph) {
  std::vector<CopyExchange::Copy> ghosts;
  for (const LeafId leaf : graph.all()) {
    if (!graph.is_local(leaf))
      ghosts.push_back({leaf.value(), graph.owner_of(leaf).rank, graph.owner_of(leaf).index});
  }
  return ghosts;
}

}  // namespace

GhostExchange::GhostExchange(const Communicator& comm, const LeafGraph& graph)
    : CopyExchange(comm, ghosts_of(graph), graph.local_begin()) {}

}  // namespace quadloop
