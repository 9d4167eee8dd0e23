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
  void find_bad();
  void count_bad_near(NodeId node);
  bool visit(std::size_t i);
  std::optional<Point> better_place(NodeId n, Point p);
  void say_moved(NodeId n);
  void share_moves();

  const Communicator& comm_;
  HaloMesh& mesh_;
  const NodeStars& stars_;
  const BoundarySlide& slide_;
  Objective objective_;
  double threshold_;
  std::unique_ptr<NodeSolver> solver_;
  std::vector<std::vector<std::size_t>> by_colour_;
  NodeFlags bad_;              ///< nodes of cells above the threshold, other ranks' too
  NodeFlags moved_;            ///< those that have moved in this colour
  std::vector<NodeId> moves_;  ///< the same, this rank's
  std::vector<std::int32_t>
      bad_near_;             ///< of each free node: itself and its neighbours, as often as they are met
  std::vector<char> stale_;  ///< of each free node: whether something near has moved since its last visit
  std::vector<char> unmeasured_;  ///< ... since it was last found bad or not
  Star star_;
};

}  // namespace quadloop
