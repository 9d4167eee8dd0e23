#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <vector>

#include "mesher/forest/ghost_exchange.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A leaf by its owner and its number there.
struct LeafPlace {
  std::int32_t rank = 0, index = 0;
  friend auto operator<=>(const LeafPlace&, const LeafPlace&) = default;
};

/// A triangle that names its nodes over all ranks.
struct FreeTriangle {
  LeafPlace leaf;
  std::array<std::int64_t, 3> nodes{};
  std::array<Point, 3> points;
};

/// Other ranks' cells, as triangles, in rings of leaves around this rank's; only leaves of interest count,
/// and only rings of such leaves.
class CellHalo {
 public:
  /// `of_interest` flags the local leaves and the ghosts. `triangles_of(leaf, out)` appends the triangles of
  /// a local leaf. Both must outlive the halo. *Collective.*
  CellHalo(const Communicator& comm, const LeafGraph& graph, const std::vector<char>& of_interest,
           std::function<void(std::int32_t, std::vector<FreeTriangle>&)> triangles_of);

  /// Fetches the next ring. *Collective.*
  void grow();

  /// All that was fetched.
  std::span<const FreeTriangle> triangles() const { return triangles_; }
  /// Whether leaves beyond this one (this rank's, or one fetched) have not been fetched.
  bool at_rim(const LeafPlace& leaf) const;
  bool complete() const { return frontier_.empty(); }

 private:
  struct Link {
    LeafPlace from, to;
    friend auto operator<=>(const Link&, const Link&) = default;
  };
  LeafPlace place_of(std::int32_t leaf) const {
    return {graph_.place_of(leaf).rank, graph_.place_of(leaf).index};
  }
  void link(std::int32_t leaf, std::vector<Link>& links) const;
  void find_frontier();

  const Communicator& comm_;
  const LeafGraph& graph_;
  const std::vector<char>& of_interest_;
  std::function<void(std::int32_t, std::vector<FreeTriangle>&)> triangles_of_;
  std::vector<FreeTriangle> triangles_;
  std::vector<Link> links_;  ///< from this rank's leaves and fetched ones to those that touch them
  std::set<LeafPlace> fetched_, frontier_, rim_;
};

}  // namespace quadloop
