#pragma once

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <vector>

#include "mesher/cut/cut_leaf.hpp"

namespace quadloop {

/// The snap and the node of a crossing.
struct NamedCrossing {
  std::int32_t snap = -1;  ///< snap of the leaf that absorbs it
  std::int32_t node = -1;
};

/// The sides of a leaf, divided at crossings, hanging nodes and kept points between blocks.
struct DividedSides {
  explicit DividedSides(std::pmr::memory_resource* memory)
      : crossings(memory), inside(memory), outside(memory) {}
  std::pmr::vector<NamedCrossing> crossings;        ///< of the leaf's trace
  std::pmr::vector<CutLeaf::Edge> inside, outside;  ///< parts of the sides, relative to the domain
  CutLeaf::InsideHalves halves;
};

/// Divides the sides and adds their nodes to the leaf, moved by snaps. Empty if the crossings are
/// inconsistent. `memory`: for the lists, which are short.
std::optional<DividedSides> divide_sides(const Geometry& geometry, const LeafCutter::Input& input,
                                         const Interior& interior, std::pmr::memory_resource* memory,
                                         CutLeaf& leaf);

/// The side of the leaf that holds the point, without its corners, if any.
std::optional<Side> side_at(const Box& box, Point p);

}  // namespace quadloop
