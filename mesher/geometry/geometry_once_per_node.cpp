#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/parallel/node_memory.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

namespace {

/// What of a boundary has a fixed size.
struct BoundaryValues {
  double spacing = 0, corner_degrees = 0;
  BoundaryCondition condition;
  double corner_spacing = 0;
  bool has_layers = false;
  LayerSpec layers;
  bool baffle = false;
};

/// Returns the boundaries of the first rank. *Collective.*
std::vector<Boundary> broadcast_boundaries(const Communicator& comm, const std::vector<Boundary>& of_first) {
  std::vector<std::string> words;
  std::vector<BoundaryValues> values;
  for (const Boundary& b : of_first) {
    const auto& [name, spacing, corner_degrees, condition, corner_spacing, layers, layers_in, baffle] = b;
    words.insert(words.end(), {name, layers_in});
    values.push_back({spacing, corner_degrees, condition, corner_spacing, layers.has_value(),
                      layers.value_or(LayerSpec{}), baffle});
  }
  words = broadcast_words(comm, words);
  comm.broadcast(values);
  std::vector<Boundary> boundaries;
  for (std::size_t b = 0; b < values.size(); ++b) {
    const auto& [spacing, corner_degrees, condition, corner_spacing, has_layers, layers, baffle] = values[b];
    boundaries.push_back({words[2 * b], spacing, corner_degrees, condition, corner_spacing,
                          has_layers ? std::optional(layers) : std::nullopt, words[2 * b + 1], baffle});
  }
  return boundaries;
}

}  // namespace

Geometry Geometry::once_per_node(const Communicator& comm, std::optional<Geometry> of_first) {
  if (comm.size() == 1) return *std::move(of_first);
  const NodeMemory memory(comm);
  Geometry g = of_first ? *std::move(of_first) : Geometry();
  g.boundaries_ = broadcast_boundaries(comm, g.boundaries_);
  g.block_names_ = broadcast_words(comm, g.block_names_);
  struct Values {
    Box box;
    std::uint64_t digest;
  };
  std::vector<Values> values{{g.box_, comm.is_root() ? g.digest() : 0}};
  comm.broadcast(values);
  g.box_ = values.front().box;
  g.digest_ = values.front().digest;
  g.curves_ = g.curves_.once_per_node(memory);
  const auto share = [&](auto&... arrays) { ((arrays = memory.once_per_node(arrays)), ...); };
  share(g.points_, g.loop_starts_, g.segment_boundary_, g.block_of_loop_, g.returns_, g.twins_, g.spacing_,
        g.bend_, g.kept_, g.flags_);
  return g;
}

}  // namespace quadloop
