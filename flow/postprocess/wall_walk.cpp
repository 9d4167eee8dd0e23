#include "flow/postprocess/wall_walk.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace quadloop::flow {

namespace {

/// Edges that start at a node, the first of them last.
using Leaving = std::map<std::int64_t, std::vector<std::size_t>>;

Leaving leaving_edges(const std::vector<WallEdge>& edges) {
  Leaving leaving;
  for (std::size_t e = edges.size(); e-- > 0;) leaving[edges[e].from.number].push_back(e);
  return leaving;
}

/// Follows unvisited edges from a node as far as possible.
std::vector<WallNode> chain_from(const std::vector<WallEdge>& edges, const WallNode& first,
                                 Leaving& leaving) {
  std::vector<WallNode> chain{first};
  for (auto at = leaving.find(first.number); at != leaving.end() && !at->second.empty();
       at = leaving.find(chain.back().number)) {
    const std::size_t edge = at->second.back();
    at->second.pop_back();
    chain.push_back(edges[edge].to);
    if (chain.back().number == first.number) break;
  }
  return chain;
}

void turn_to_trailing_edge(std::vector<WallNode>& loop) {
  loop.pop_back();
  const auto first = std::min_element(loop.begin(), loop.end(), [](const WallNode& a, const WallNode& b) {
    return a.at.x != b.at.x ? a.at.x > b.at.x : a.at.y < b.at.y;
  });
  std::rotate(loop.begin(), first, loop.end());
  loop.push_back(loop.front());
}

}  // namespace

std::vector<std::vector<WallNode>> walk(const std::vector<WallEdge>& edges) {
  std::map<std::int64_t, int> surplus;  // number of edges that start at a node minus those that end there
  for (const WallEdge& edge : edges) {
    ++surplus[edge.from.number];
    --surplus[edge.to.number];
  }
  Leaving leaving = leaving_edges(edges);
  std::vector<std::pair<std::size_t, std::vector<WallNode>>> chains;
  for (const bool open : {true, false}) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (open && surplus[edges[e].from.number] <= 0) continue;
      std::vector<std::size_t>& rest = leaving[edges[e].from.number];
      if (rest.empty() || rest.back() != e) continue;
      chains.emplace_back(e, chain_from(edges, edges[e].from, leaving));
    }
  }
  std::stable_sort(chains.begin(), chains.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::vector<WallNode>> walked;
  for (auto& [edge, chain] : chains) {
    if (chain.size() > 1 && chain.front().number == chain.back().number) turn_to_trailing_edge(chain);
    walked.push_back(std::move(chain));
  }
  return walked;
}

}  // namespace quadloop::flow
