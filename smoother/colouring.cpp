#include "smoother/colouring.hpp"

#include <algorithm>
#include <numeric>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr std::int8_t waiting = -2;

/// Scatters the numbers, so that no long chain of nodes waits one for the next (the finaliser of SplitMix64; Steele, Lea and Flood 2014).
std::uint64_t priority(std::int64_t number) {
  auto z = static_cast<std::uint64_t>(number) + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

class Colourer {
 public:
  Colourer(const HaloMesh& mesh, const NodeStars& stars) : mesh_{mesh}, stars_{stars}, colours_(mesh.points().size(), Colouring::none) {
    for (const std::int32_t node : stars.nodes()) colours_[static_cast<std::size_t>(node)] = waiting;
  }

  std::vector<std::int8_t>& colours() { return colours_; }

  /// Colours the nodes that need not wait; returns how many still do. `order` shrinks to them.
  void pass(std::vector<std::size_t>& order) {
    std::erase_if(order, [&](std::size_t i) { return choose(i); });
  }

 private:
  bool choose(std::size_t i) {
    const auto node = static_cast<std::size_t>(stars_.nodes()[i]);
    const std::uint64_t own = priority(mesh_.global(stars_.nodes()[i]));
    std::uint64_t taken = 0;
    bool must_wait = false;
    stars_.for_each_neighbour(i, [&](std::int32_t other) {
      const std::int8_t colour = colours_[static_cast<std::size_t>(other)];
      if (colour == Colouring::none || static_cast<std::size_t>(other) == node || priority(mesh_.global(other)) < own) return;
      if (colour == waiting) {
        must_wait = true;
      } else {
        taken |= std::uint64_t{1} << colour;
      }
    });
    if (must_wait) return false;
    QUADLOOP_REQUIRE(~taken != 0, "a node has fewer than 64 neighbours of different colours");
    colours_[node] = static_cast<std::int8_t>(std::countr_one(taken));
    return true;
  }

  const HaloMesh& mesh_;
  const NodeStars& stars_;
  std::vector<std::int8_t> colours_;
};

}  // namespace

Colouring colour_nodes(const Communicator& comm, const HaloMesh& mesh, const NodeStars& stars) {
  Colourer colourer(mesh, stars);
  std::vector<std::size_t> order(stars.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return priority(mesh.global(stars.nodes()[a])) > priority(mesh.global(stars.nodes()[b])); });
  mesh.exchange().update(colourer.colours());
  do {
    colourer.pass(order);
    mesh.exchange().update(colourer.colours());
  } while (comm.any(!order.empty()));
  Colouring result{std::move(colourer.colours()), 0};
  const auto largest = result.colour_of.empty() ? Colouring::none : *std::max_element(result.colour_of.begin(), result.colour_of.end());
  result.count = static_cast<std::int8_t>(comm.maximum(std::int64_t{largest}) + 1);
  return result;
}

}  // namespace quadloop
