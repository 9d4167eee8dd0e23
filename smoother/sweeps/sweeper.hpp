#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "smoother/outline/boundary_slide.hpp"
#include "smoother/sweeps/coloured_sweeps.hpp"

namespace quadloop::smoother {

/// Visits nodes sweep by sweep, colour by colour: the nodes of cells above a threshold and their neighbours,
/// if something near has moved since their last visit.
class Sweeper {
 public:
  /// After this many sweeps, which give most of the gain, nodes are skipped if no near cell is above the
  /// threshold any more.
  static constexpr int open_sweeps = 2;

  /// Which nodes are visited, and how.
  struct Rule {
    Method method;
    Objective objective;
    double threshold;
    bool tangled;           ///< there may be stars with inverted corners; visits create none
    bool angles = true;     ///< a move must not reduce the smallest angle
    double even_up_to = 0;  ///< largest corner cost of a star in which edges along boundaries stay even
  };
  /// `stars` are those of the nodes that may move, `bad` flags the nodes of cells above the threshold;
  /// `stale` as in ColouredSweeps. Mesh, stars, slide and `stale` must outlive it. *Collective.*
  Sweeper(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars, BoundarySlide& slide,
          const Rule& rule, const NodeFlags& bad, NodeFlags& stale);

  /// Returns the number of nodes moved over all ranks. *Collective.*
  std::int64_t sweep();

 private:
  NodeId node(std::size_t i) const { return stars_.nodes()[i]; }
  std::vector<std::int32_t> update_bad();
  std::vector<std::int32_t> doubtful_among(const std::vector<std::int32_t>& changed);
  std::vector<std::int32_t> stars_near(const std::vector<NodeId>& turned_bad) const;
  bool is_near_bad(std::size_t i) const;
  std::optional<Point> better_place(std::size_t i);

  const Communicator& comm_;
  const HaloMesh& mesh_;
  const NodeStars& stars_;
  BoundarySlide& slide_;
  Rule rule_;
  std::unique_ptr<NodeSolver> solver_;
  bool any_quads_;  ///< on any rank
  ColouredSweeps sweeps_;
  NodeFlags bad_;                          ///< free nodes of cells above the threshold, ghost copies included
  std::vector<std::int32_t> passed_over_;  ///< skipped stars, whose flags may be out of date
  Star star_;
  int done_ = 0;  ///< number of sweeps, the present one included
};

}  // namespace quadloop::smoother
