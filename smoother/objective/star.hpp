#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesher/geometry/point.hpp"
#include "smoother/objective/objective.hpp"
#include "smoother/objective/star_kernels.hpp"

namespace quadloop {

/// Cotangent of 28 degrees: cells that are fitted to layers or slide along the outline keep larger angles
/// where they have them.
constexpr double cotangent_of_28 = 1.8807264653463318;

/// What a node's star would be worth with the node at each of several places, evaluated together.
template <int places>
struct StarCost {
  using Values = Eigen::Array<double, places, 1>;
  Values objective;                     ///< cost of the node; of no use where the star is not valid
  Values largest_defect;                ///< square root of the largest corner cost
  Values largest_cotangent;             ///< of the cells' angles: that of the smallest
  Eigen::Array<bool, places, 1> valid;  ///< no corner is inverted
};

/// A star with its node at one place: its worth by Objective::power, and to second order the sum of the
/// corners' defects, each to the third power.
struct StarModel {
  StarCost<1> cost;
  double cubes = 0;
  Point gradient;                 ///< of that sum
  double xx = 0, xy = 0, yy = 0;  ///< its second derivatives
  double reference = 0;           ///< Star::reference
};

/// All corners that hang on one node.
class Star {
 public:
  static constexpr int batch = StarKernels::batch;
  using Batch = Eigen::Array<double, batch, 1>;

  void clear() { corners_.clear(); }
  void add(const StarCorner& corner) { corners_.push_back(corner); }
  const std::vector<StarCorner>& corners() const { return corners_; }
  bool empty() const { return corners_.empty(); }
  /// Corners that are to be stretched have small angles: from now on largest_cotangent is below all others.
  void leave_out_angles() { angles_count_ = false; }

  StarCost<batch> cost(const Batch& x, const Batch& y, Objective objective) const;
  StarCost<1> cost(Point p, Objective objective) const;

  /// The cost of the node by the objective, at most the number of corners, and its gradient; the star must be
  /// valid at p.
  double cost_and_gradient(Point p, Objective objective, Point& gradient) const;
  /// Its cost has the bits of cost(p, Objective::power); the rest is of use where the star is valid at p.
  StarModel model(Point p) const;

  /// The largest corner cost with the node at p, Eq. 3.2; 1 or more where a corner is inverted.
  double worst_cost(Point p) const;

  /// Eq. 3.4 with the node at p, whether the star is valid there or not; J over `reference`, an area.
  double nodal_cost(Point p, double reference) const;

  /// The sum of -J over inverted corners, over `reference`; zero if the star is valid.
  double inversion(Point p, double reference) const;
  /// A flag for each corner that is not inverted.
  std::vector<char> sound_corners(Point p) const;

  /// The mean of the squared lengths of the edges from p: what J is divided by.
  double reference(Point p) const;

 private:
  template <int places>
  StarCost<places> cost_of(const StarSums<places>& sums, Objective objective) const;
  double power_and_gradient(Point p, Point& gradient) const;
  double thesis_and_gradient(Point p, Point& gradient) const;

  std::vector<StarCorner> corners_;
  bool angles_count_ = true;
};

/// Eq. 3.4 from the largest and the mean of the corners' costs. Up to 1 a blend of the two; above, where a
/// corner is inverted, (1 - J)^2 with the smallest J of all, whose corner costs 1 - J (Eq. 3.2): the largest
/// cost, squared.
double nodal_cost(double largest, double mean);

}  // namespace quadloop
