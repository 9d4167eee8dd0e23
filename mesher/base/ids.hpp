#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

#include "mesher/base/error.hpp"

namespace quadloop {

/// The number of an entity, with its own type, so that nodes and quadtree cells (leaves), or local and global
/// numbers, cannot be mixed up. A default-constructed id is invalid.
template <class Tag, class Rep>
class Id {
 public:
  using rep = Rep;

  constexpr Id() = default;
  constexpr explicit Id(Rep value) : value_{value} {}

  constexpr Rep value() const { return value_; }
  constexpr bool valid() const { return value_ >= 0; }
  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  Rep value_ = -1;
};

/// A mesh node, numbered on this rank: owned nodes, then ghosts.
using NodeId = Id<struct NodeTag, std::int32_t>;
/// A mesh node, numbered over all ranks, from 0.
using GlobalNodeId = Id<struct GlobalNodeTag, std::int64_t>;
/// A leaf of a LeafGraph: this rank's or a ghost.
using LeafId = Id<struct LeafTag, std::int32_t>;
/// A named boundary.
using BoundaryId = Id<struct BoundaryTag, std::int32_t>;

/// Returns the number of entries as a 32-bit id count. Throws Fault if it does not fit.
template <class List>
constexpr std::int32_t size32(const List& list) {
  const std::size_t size = list.size();
  QUADLOOP_REQUIRE(size <= std::numeric_limits<std::int32_t>::max(), "more entries than ids on one rank",
                   size);
  return static_cast<std::int32_t>(size);
}

}  // namespace quadloop

template <class Tag, class Rep>
struct std::hash<quadloop::Id<Tag, Rep>> {
  std::size_t operator()(quadloop::Id<Tag, Rep> id) const { return std::hash<Rep>{}(id.value()); }
};
