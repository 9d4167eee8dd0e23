#include "adapt/morph/morph_derivative.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::adapt {

namespace {

/// Derivative of the direction of an edge, in radians, with respect to the position of its end; that with
/// respect to its start is the negative.
Point turn_gradient(Point edge) { return (1 / dot(edge, edge)) * Point{-edge.y, edge.x}; }

/// Returns a motion's rate from those of position and angle, as LinearMotion is not linear in the angle.
LinearMotion rate_of(const RigidMotion& motion, Point to_rate, double angle_rate) {
  return {std::sin(motion.angle) * angle_rate, std::cos(motion.angle) * angle_rate, to_rate};
}

/// Sums of LinearMotions whose shifts are gradients of nodes, or fractions of them.
class MotionSums {
 public:
  /// For `nodes` nodes with gradients up to `largest`, at distances up to `reach`.
  MotionSums(std::size_t motions, double largest, double reach, std::int64_t nodes)
      : shifts_{2 * motions, largest, nodes}, turns_{2 * motions, 2 * reach * largest, nodes} {}

  void add(std::size_t motion, const LinearMotion& part) {
    shifts_.add(2 * motion, part.shift.x);
    shifts_.add(2 * motion + 1, part.shift.y);
    turns_.add(2 * motion, part.versed);
    turns_.add(2 * motion + 1, part.sine);
  }

  /// *Collective.*
  std::vector<LinearMotion> over(const Communicator& comm) const {
    const std::vector<double> shifts = shifts_.over(comm), turns = turns_.over(comm);
    std::vector<LinearMotion> motions;
    for (std::size_t k = 0; k < shifts.size(); k += 2)
      motions.push_back({turns[k], turns[k + 1], {shifts[k], shifts[k + 1]}});
    return motions;
  }

 private:
  ReproducibleSums shifts_, turns_;
};

}  // namespace

MorphDerivative::MorphDerivative(const Communicator& comm, const Mesh& mesh, const OutlineChange& change)
    : comm_{comm},
      motion_{comm, mesh, change},
      images_{images_of(motion_.outline(), change)},
      shares_{image_shares(motion_.outline(), change)},
      points_{change.to.points().size()},
      reach_{motion_.possible_reach(change)} {}

/// Returns the rate of each boundary node's motion.
std::vector<LinearMotion> MorphDerivative::rates(std::span<const Point> of_points) const {
  const Geometry& outline = motion_.outline().geometry;
  std::vector<Point> of_images;
  for (const auto& [first, second, share] : shares_)
    of_images.push_back(first < 0 ? Point{} : (1 - share) * of_points[first] + share * of_points[second]);
  const auto turn_rate = [&](std::int32_t v) {
    const std::int32_t next = outline.next(v);
    return dot(turn_gradient(images_[next] - images_[v]), of_images[next] - of_images[v]);
  };
  std::vector<LinearMotion> rates;
  for (const BoundaryNodeMotion& node : motion_.boundary()) {
    const double turn = (turn_rate(outline.previous(node.vertex)) + turn_rate(node.vertex)) / 2;
    rates.push_back(rate_of(node.motion, of_images[node.vertex], turn));
  }
  return rates;
}

std::vector<Point> MorphDerivative::velocity(std::span<const Point> of_points) const {
  QUADLOOP_REQUIRE(of_points.size() == points_, "each point of the outline moves somehow", of_points.size(),
                   points_);
  const std::vector<LinearMotion> of_motions = rates(of_points);
  const HaloMesh& mesh = motion_.before();
  const InverseDistance field = motion_.field(reach_, [&](std::int32_t foot) { return of_motions[foot]; });
  std::vector<Point> velocity;
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes()})) {
    const std::int32_t foot = motion_.foot(node);
    const Point p = mesh.point(node);
    velocity.push_back(foot < 0 ? field.displacement(p)
                                : of_motions[foot].displacement(p - motion_.boundary()[foot].motion.from));
  }
  return velocity;
}

/// Maps the gradient of each node to the motions that it follows, summed over all ranks.
std::vector<LinearMotion> MorphDerivative::gradient_of_motions(std::span<const Point> of_nodes) const {
  const HaloMesh& mesh = motion_.before();
  const InverseDistance field = motion_.field(reach_, [](std::int32_t) { return LinearMotion{}; });
  const std::size_t feet = motion_.boundary().size();
  double largest = 0;
  for (const Point& g : of_nodes) largest = std::max({largest, std::abs(g.x), std::abs(g.y)});
  largest = comm_.maximum(largest);
  if (largest == 0) return std::vector<LinearMotion>(feet);
  const Box& box = motion_.outline().geometry.box();
  const std::int64_t nodes = comm_.sum(std::ssize(of_nodes));
  MotionSums sums(feet + field.mean_count(), largest, box.width() + box.height(), nodes);
  for (const NodeId node : ids_below(NodeId{mesh.owned_nodes()})) {
    const std::int32_t foot = motion_.foot(node);
    const Point p = mesh.point(node), g = of_nodes[node.value()];
    if (foot >= 0)
      sums.add(foot, members_gradient(p - motion_.boundary()[foot].motion.from, g));
    else
      field.add_gradient(p, g,
                         [&](std::int32_t mean, const LinearMotion& part) { sums.add(feet + mean, part); });
  }
  std::vector<LinearMotion> gradient = sums.over(comm_);
  const std::vector<LinearMotion> of_sources = field.gradient_of_sources(std::span(gradient).subspan(feet));
  gradient.resize(feet);
  for (std::size_t s = 0; s < of_sources.size(); ++s) gradient[motion_.sources()[s].foot] += of_sources[s];
  return gradient;
}

std::vector<Point> MorphDerivative::gradient(std::span<const Point> of_nodes) const {
  const Geometry& outline = motion_.outline().geometry;
  const std::vector<LinearMotion> of_motions = gradient_of_motions(of_nodes);
  std::vector<Point> of_images(images_.size());
  const auto add_turn = [&](std::int32_t v, double gain) {
    const std::int32_t next = outline.next(v);
    const Point part = gain * turn_gradient(images_[next] - images_[v]);
    of_images[next] = of_images[next] + part;
    of_images[v] = of_images[v] - part;
  };
  for (std::size_t k = 0; k < of_motions.size(); ++k) {
    const auto& [node, motion, width, vertex] = motion_.boundary()[k];
    of_images[vertex] = of_images[vertex] + of_motions[k].shift;
    const double of_angle =
        std::sin(motion.angle) * of_motions[k].versed + std::cos(motion.angle) * of_motions[k].sine;
    add_turn(outline.previous(vertex), of_angle / 2);
    add_turn(vertex, of_angle / 2);
  }
  std::vector<Point> of_points(points_);
  for (std::size_t v = 0; v < shares_.size(); ++v) {
    const auto& [first, second, share] = shares_[v];
    if (first < 0) continue;
    of_points[first] = of_points[first] + (1 - share) * of_images[v];
    of_points[second] = of_points[second] + share * of_images[v];
  }
  return of_points;
}

}  // namespace quadloop::adapt
