#include "mesher/forest/ghost_exchange.hpp"

namespace quadloop {

GhostExchange::GhostExchange(const Communicator& comm, const LeafGraph& graph)
    : comm_{comm}, graph_{graph}, ghosts_(static_cast<std::size_t>(comm.size())) {
  std::vector<std::vector<std::int32_t>> wanted(ghosts_.size());
  for (std::int32_t leaf = 0; leaf < graph.size(); ++leaf) {
    if (graph.is_local(leaf)) continue;
    const LeafGraph::Place place = graph.place_of(leaf);
    ghosts_[static_cast<std::size_t>(place.rank)].push_back(leaf);
    wanted[static_cast<std::size_t>(place.rank)].push_back(place.index);
  }
  asked_ = comm.exchange(wanted);
}

}  // namespace quadloop
