#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "smoother/node_stars.hpp"
#include "smoother/outline/boundary_slide.hpp"

namespace quadloop {

/// Visits the nodes sweep by sweep, colour by colour: those of cells above a threshold and their neighbours,
/// where something near has moved since.
class Sweeper {
 public:
  /// `stars` are those of the nodes that may move. Mesh, stars and slide must outlive it. *Collective.*
  Sweeper(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars, const BoundarySlide& slide,
          Method method, Objective objective, double threshold);

  /// Returns the number of nodes moved over all ranks. *Collective.*
  std::int64_t sweep();

 private:
  NodeId node(std::size_t i) const { return stars_.nodes()[i]; }
  bool is_stale(std::size_t i) const;
  void find_bad();
  bool is_active(std::size_t i) const;
  bool visit(std::size_t i);
  std::optional<Point> better_place(NodeId n, Point p);
  void share_moves();

  const Communicator& comm_;
  HaloMesh& mesh_;
  const NodeStars& stars_;
  const BoundarySlide& slide_;
  Objective objective_;
  double threshold_;
  std::unique_ptr<NodeSolver> solver_;
  std::vector<std::vector<std::size_t>> by_colour_;
  IdVector<NodeId, std::int32_t> moved_at_;  ///< the clock when each node moved last
  std::vector<std::int32_t> visited_at_;     ///< the clock when each free node was visited last
  NodeFlags bad_;
  std::int32_t clock_ = 0;
  Star star_;
};

}  // namespace quadloop
