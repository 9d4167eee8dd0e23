#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesher/geometry/point.hpp"
#include "smoother/objective/objective.hpp"
#include "smoother/objective/star_kernels.hpp"

namespace quadloop::smoother {

/// Cotangent of 28 degrees: the lower limit of angles when cells are fitted to layers or nodes slide along
/// the geometry.
constexpr double cotangent_of_28 = 1.8807264653463318;

/// The costs of a node's star for several positions of the node, evaluated together.
template <int places>
struct StarCost {
  using Values = Eigen::Array<double, places, 1>;
  Values objective;                     ///< cost of the node; meaningless where the star is not valid
  Values largest_defect;                ///< square root of the largest corner cost
  Values largest_cotangent;             ///< cotangent of the smallest cell angle
  Eigen::Array<bool, places, 1> valid;  ///< true if no corner is inverted
};

/// A star with its node at one position: its cost by Objective::power, and the sum of the cubed corner
/// defects with its derivatives up to second order.
struct StarModel {
  StarCost<1> cost;
  double cubes = 0;
  Point gradient;                 ///< of that sum
  double xx = 0, xy = 0, yy = 0;  ///< second derivatives of that sum
  double reference = 0;           ///< Star::reference
};

/// All corners whose shape depends on one node.
class Star {
 public:
  static constexpr int batch = StarKernels::batch;
  using Batch = Eigen::Array<double, batch, 1>;

  /// Sets the corners: `corner(c)` for c = 0, 1, ... below `count`.
  template <class CornerOf>
  void assign(std::size_t count, const CornerOf& corner) {
    corners_.resize(count);
    for (std::size_t c = 0; c < count; ++c) corners_[c] = corner(c);
  }
  void add(const StarCorner& corner) { corners_.push_back(corner); }
  const std::vector<StarCorner>& corners() const { return corners_; }
  bool empty() const { return corners_.empty(); }
  /// Excludes angles: from now on largest_cotangent is below all others. For anisotropic targets, which have
  /// small angles.
  void leave_out_angles() { angles_count_ = false; }

  StarCost<batch> cost(const Batch& x, const Batch& y, Objective objective) const;
  StarCost<1> cost(Point p, Objective objective) const;

  /// The node's cost by the objective, at most the number of corners, and its gradient. The star must be
  /// valid at p.
  double cost_and_gradient(Point p, Objective objective, Point& gradient) const;
  /// The cost has the same bits as cost(p, Objective::power); the rest is meaningful if the star is valid at
  /// p.
  StarModel model(Point p) const;

  /// The largest corner cost with the node at p, Eq. 3.2; 1 or more if a corner is inverted.
  double worst_cost(Point p) const;

  /// Eq. 3.4 with the node at p, for valid and invalid stars; J is divided by `reference`, an area.
  double nodal_cost(Point p, double reference) const;

  /// The sum of -J over inverted corners, divided by `reference`; zero if the star is valid.
  double inversion(Point p, double reference) const;
  /// Flags the corners that are not inverted.
  std::vector<char> sound_corners(Point p) const;

  /// The mean squared length of the edges from p, by which J is divided.
  double reference(Point p) const;

 private:
  template <int places>
  StarCost<places> cost_of(const StarSums<places>& sums, Objective objective) const;
  double power_and_gradient(Point p, Point& gradient) const;
  double thesis_and_gradient(Point p, Point& gradient) const;

  std::vector<StarCorner> corners_;
  bool angles_count_ = true;
};

/// Eq. 3.4 from the largest and the mean corner cost: a blend of the two up to 1. Above 1 (a corner is
/// inverted) (1 - J)^2 with the smallest J of all, which is the largest cost squared (Eq. 3.2).
double nodal_cost(double largest, double mean);

}  // namespace quadloop::smoother
