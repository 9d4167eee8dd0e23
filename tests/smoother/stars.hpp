#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "smoother/objective/star.hpp"

namespace quadloop::test {

using Random = std::mt19937_64;

/// Between two limits, the same numbers with any standard library.
double uniform(Random& random, double low, double high);
Point random_direction(Random& random);

/// Which cells lie round the node.
enum class Cells { triangles, quads, mixed };

/// The star of a node at the origin, valid there, of four to eight neighbours. `stretched`: with targets that
/// differ from cell to cell.
smoother::Star random_star(Random& random, Cells cells, bool stretched = false);

/// The triangles between the origin, or any node inside, and the sides of a polygon, counter-clockwise.
smoother::Star fan_of(const std::vector<Point>& polygon);
std::vector<Point> regular_polygon(int corners, Point centre = {}, double radius = 1);

/// Four unit quads round the origin.
smoother::Star quad_patch();

/// Adds the three corners of a quad p, a, b, c that hang on p, with the targets of a stretched quad: its
/// edges from p.
void add_quad(smoother::Star& star, Point a, Point b, Point c, Point w1, Point w2);

/// The smallest angle of the star's cells in degrees, and the largest of its corners' costs, one by one.
double smallest_degrees(const smoother::Star& star, Point p);
double largest_cost(const smoother::Star& star, Point p);
std::vector<double> corner_costs(const smoother::Star& star, Point p);

}  // namespace quadloop::test
