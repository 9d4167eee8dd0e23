#include "adapt/euler/colouring.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "mesher/base/error.hpp"

namespace quadloop::euler {

namespace {

constexpr std::int8_t waiting = -1;

/// Scatters the numbers, so that no long chain of nodes waits one for the next (the finaliser of SplitMix64; Steele, Lea and Flood 2014).
std::uint64_t priority(std::int64_t number) {
  auto z = static_cast<std::uint64_t>(number) + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

class Colourer {
 public:
  explicit Colourer(const DualMesh& mesh) : mesh_{mesh}, neighbours_(static_cast<std::size_t>(mesh.owned_nodes())), colours_(mesh.nodes(), waiting) {
    for (std::size_t node = 0; node < mesh.nodes(); ++node) priorities_.push_back(priority(mesh.global(static_cast<std::int32_t>(node))));
    for (const DualEdge& edge : mesh.edges()) {
      if (mesh.is_owned(edge.low)) neighbours_[static_cast<std::size_t>(edge.low)].push_back(edge.high);
      if (mesh.is_owned(edge.high)) neighbours_[static_cast<std::size_t>(edge.high)].push_back(edge.low);
    }
    order_.resize(neighbours_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return priorities_[a] > priorities_[b]; });
  }

  std::vector<std::int8_t> run(const Communicator& comm) {
    do {
      std::erase_if(order_, [&](std::size_t node) { return choose(node); });
      mesh_.exchange().update(colours_);
    } while (comm.any(!order_.empty()));
    return std::move(colours_);
  }

 private:
  bool choose(std::size_t node) {
    std::uint64_t taken = 0;
    for (const std::int32_t other : neighbours_[node]) {
      const auto neighbour = static_cast<std::size_t>(other);
      if (priorities_[neighbour] < priorities_[node]) continue;
      if (colours_[neighbour] == waiting) return false;
      taken |= std::uint64_t{1} << colours_[neighbour];
    }
    QUADLOOP_REQUIRE(~taken != 0, "a node has fewer than 64 neighbours of different colours");
    colours_[node] = static_cast<std::int8_t>(std::countr_one(taken));
    return true;
  }

  const DualMesh& mesh_;
  std::vector<std::vector<std::int32_t>> neighbours_;
  std::vector<std::uint64_t> priorities_;
  std::vector<std::size_t> order_;  ///< the owned nodes that still wait, the first to choose first
  std::vector<std::int8_t> colours_;
};

}  // namespace

NodeColours colour_nodes(const Communicator& comm, const DualMesh& mesh) {
  NodeColours result{Colourer(mesh).run(comm), 0};
  std::int8_t largest = waiting;
  for (const std::int8_t colour : result.colour_of) largest = std::max(largest, colour);
  result.count = static_cast<int>(comm.maximum(std::int64_t{largest})) + 1;
  return result;
}

}  // namespace quadloop::euler
