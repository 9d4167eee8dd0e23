#include "mesher/build/cell_halo.hpp"

namespace quadloop {

CellHalo::CellHalo(const Communicator& comm, const LeafGraph& graph, const std::vector<char>& of_interest,
                   std::function<void(std::int32_t, std::vector<FreeTriangle>&)> triangles_of)
    : comm_{comm}, graph_{graph}, of_interest_{of_interest}, triangles_of_{std::move(triangles_of)} {
  if (comm.size() == 1) return;
  for (std::int32_t leaf = 0; leaf < graph.size(); ++leaf) {
    if (graph.is_local(leaf) || of_interest[static_cast<std::size_t>(leaf)] == 0) continue;
    for_touching_leaves(graph, leaf, [&](std::int32_t other) {
      if (graph.is_local(other) && of_interest[static_cast<std::size_t>(other)] != 0)
        links_.push_back({place_of(other), place_of(leaf)});
    });
  }
  find_frontier();
}

/// The leaves of interest that touch one.
void CellHalo::link(std::int32_t leaf, std::vector<Link>& links) const {
  for_touching_leaves(graph_, leaf, [&](std::int32_t other) {
    if (of_interest_[static_cast<std::size_t>(other)] != 0)
      links.push_back({place_of(leaf), place_of(other)});
  });
}

void CellHalo::find_frontier() {
  frontier_.clear();
  rim_.clear();
  for (const Link& l : links_) {
    if (l.to.rank == comm_.rank() || fetched_.contains(l.to)) continue;
    frontier_.insert(l.to);
    rim_.insert(l.from);
  }
}

void CellHalo::grow() {
  std::vector<std::vector<std::int32_t>> wanted(static_cast<std::size_t>(comm_.size()));
  for (const LeafPlace& leaf : frontier_) wanted[static_cast<std::size_t>(leaf.rank)].push_back(leaf.index);
  std::vector<std::vector<FreeTriangle>> cells(wanted.size());
  std::vector<std::vector<Link>> links(wanted.size());
  const auto asked = comm_.exchange(wanted);
  for (std::size_t rank = 0; rank < asked.size(); ++rank) {
    for (const std::int32_t index : asked[rank]) {
      triangles_of_(graph_.from_local(index), cells[rank]);
      link(graph_.from_local(index), links[rank]);
    }
  }
  for (const auto& from_rank : comm_.exchange(cells))
    triangles_.insert(triangles_.end(), from_rank.begin(), from_rank.end());
  for (const auto& from_rank : comm_.exchange(links))
    links_.insert(links_.end(), from_rank.begin(), from_rank.end());
  fetched_.insert(frontier_.begin(), frontier_.end());
  find_frontier();
}

bool CellHalo::at_rim(const LeafPlace& leaf) const { return rim_.contains(leaf); }

}  // namespace quadloop
