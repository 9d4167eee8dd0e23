// The norm of the error on moved nodes, and the places where it was least.
#include "adapt/r_adaptation/transferred_norm.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "generate/generate.hpp"
#include "tests/adapt/remesh/square_input.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

Mesh squares(double size) { return generate_mesh(world(), test::square_input(size)).result.mesh; }

/// Second derivatives along x that grow towards x = 0.
std::vector<Symmetric> bends_on(const Mesh& mesh) {
  std::vector<Symmetric> bends;
  for (const Point& p : mesh.points) bends.push_back({100 * std::exp(-5 * p.x), 0, 1e-3});
  return bends;
}

/// The same cells with their columns nearer to x = 0, or farther from it.
Mesh moved(Mesh mesh, double power) {
  for (Point& p : mesh.points) p.x = std::pow(p.x, power);
  return mesh;
}

TEST(NormByBends, IsThatOfQuadraticsOnSquares) {
  const Mesh mesh = squares(0.125);
  const std::vector<Symmetric> bends(mesh.points.size(), Symmetric{2, 0, 0});  // of x^2
  for (const double p : {1.0, 2.0, 10.0})
    EXPECT_NEAR(norm_by_bends(world(), mesh, bends, p), 2.0 / 64 / 12, 1e-12);
}

TEST(BestPlaces, AreThoseOfTheLeastNorm) {
  const Mesh solved = squares(0.0625), first = squares(0.125);
  const Field bends = rows_of(bends_on(solved), solved.owned_nodes);
  BestPlaces best(world(), solved, bends, 2, first);
  EXPECT_EQ(best.least(), best.first());
  best.look_at(moved(first, 0.7));
  EXPECT_EQ(best.places(), first.points) << "worse ones do not count";
  best.look_at(moved(first, 1.5));
  EXPECT_LT(best.least(), 0.8 * best.first());
  const double least = best.least();
  best.look_at(moved(first, 4));
  EXPECT_EQ(best.places(), moved(first, 1.5).points);
  EXPECT_EQ(best.least(), least);
}

}  // namespace
}  // namespace quadloop::adapt
