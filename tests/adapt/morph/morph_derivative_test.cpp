// The derivative of a morph against differences, its transpose against itself, and its bits over ranks.
#include "adapt/morph/morph_derivative.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <functional>

#include "adapt/morph/morph_mesh.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/layered_strip.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;
using PointMap = std::function<Point(Point)>;

Mesh spread(const Communicator& comm, const Mesh& whole) {
  return scatter_mesh(comm, whole, test::shuffled_order(whole, 5));
}

/// The outline of a mesh, each of its points somewhere else.
Geometry outline_moved(const Communicator& comm, const Mesh& mesh, const PointMap& to) {
  std::vector<Chain> chains = chains_of(outline_of(comm, mesh).geometry);
  for (Chain& chain : chains) {
    for (Point& p : chain.points) p = to(p);
  }
  Warnings warnings;
  return assemble(chains, {}, warnings);
}

/// A bent bottom.
Point bent(Point p, double scale) {
  return p.y == 0 ? Point{p.x + 0.01 * scale * std::sin(p.x), 0.05 * p.x * (scale - p.x) / scale} : p;
}

/// What the points of the outline before it was bent do: another one than that.
Point direction_at(Point p) {
  return p.y == 0 ? Point{0.3 * std::cos(2 * p.x), std::sin(p.x + 0.4)} : Point{};
}

std::vector<Point> directions(const Geometry& outline) {
  std::vector<Point> all;
  for (const Point& p : outline.points()) all.push_back(direction_at(p));
  return all;
}

/// Some number for each owned node, the same on any ranks.
std::vector<Point> scattered_at(const Mesh& mesh) {
  std::vector<Point> all;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const std::int64_t number = mesh.global(NodeId{i}).value();
    all.push_back({test::scattered(3, number, 0), test::scattered(3, number, 1)});
  }
  return all;
}

struct Sample {
  Mesh whole;
  double scale;  ///< the bottom's length
};

std::vector<Sample> samples() {
  std::vector<Sample> all{{test::Grid{14}.mesh(), 1}};
  for (const bool triangles : {false, true}) {
    test::LayeredStrip strip;
    strip.columns = 12;
    strip.triangles = triangles;
    all.push_back({strip.mesh(), 12});
  }
  return all;
}

TEST(MorphDerivative, VelocitiesAreWhatDifferencesSay) {
  for (const auto& [whole, scale] : samples()) {
    const Mesh first = spread(world(), whole);
    const Geometry old = outline_moved(world(), first, [](Point p) { return p; });
    const auto moved = [&](double step) {
      Mesh mesh = first;
      const Geometry to =
          outline_moved(world(), mesh, [&](Point p) { return bent(p, scale) + step * direction_at(p); });
      EXPECT_FALSE(morph_mesh(world(), mesh, {to, "to.geom", &old}).smoothed);
      return mesh.points;
    };
    const Geometry to = outline_moved(world(), first, [&](Point p) { return bent(p, scale); });
    const OutlineChange change{to, "to.geom", &old};
    const std::vector<Point> velocity = MorphDerivative(world(), first, change).velocity(directions(old));
    const double h = 1e-5;
    const std::vector<Point> back = moved(-h), ahead = moved(h);
    double fastest = 0;
    for (std::int32_t i = 0; i < first.owned_nodes; ++i) {
      const Point difference = (1 / (2 * h)) * (ahead[i] - back[i]);
      EXPECT_LT(length(velocity[i] - difference), 1e-8) << first.points[i].x << ", " << first.points[i].y;
      fastest = std::max(fastest, length(velocity[i]));
    }
    EXPECT_GT(world().maximum(fastest), 0.9);
  }
}

TEST(MorphDerivative, GradientsAreTheTranspose) {
  for (const auto& [whole, scale] : samples()) {
    const Mesh mesh = spread(world(), whole);
    const Geometry old = outline_moved(world(), mesh, [](Point p) { return p; });
    const Geometry to = outline_moved(world(), mesh, [&](Point p) { return bent(p, scale); });
    const OutlineChange change{to, "to.geom", &old};
    const MorphDerivative derivative(world(), mesh, change);
    const std::vector<Point> direction = directions(old), of_nodes = scattered_at(mesh),
                             velocity = derivative.velocity(direction),
                             of_points = derivative.gradient(of_nodes);
    std::vector<double> gains;
    for (std::size_t i = 0; i < velocity.size(); ++i) gains.push_back(dot(velocity[i], of_nodes[i]));
    double gain = 0;
    for (std::size_t v = 0; v < direction.size(); ++v) gain += dot(direction[v], of_points[v]);
    EXPECT_NEAR(gain, reproducible_sum(world(), gains), 1e-12 * static_cast<double>(whole.points.size()));
    EXPECT_GT(std::abs(gain), 0.01);
  }
}

TEST(MorphDerivative, HasTheSameBitsOnAnyNumberOfRanks) {
  const Communicator alone(MPI_COMM_SELF);
  for (const auto& [whole, scale] : samples()) {
    const auto gradient = [&](const Communicator& comm) {
      const Mesh mesh = spread(comm, whole);
      const Geometry old = outline_moved(comm, mesh, [](Point p) { return p; });
      const Geometry to = outline_moved(comm, mesh, [&](Point p) { return bent(p, scale); });
      const OutlineChange change{to, "to.geom", &old};
      return MorphDerivative(comm, mesh, change).gradient(scattered_at(mesh));
    };
    EXPECT_EQ(gradient(world()), gradient(alone));
  }
}

/// Nothing moves yet: what is to move is told by the boundaries that the new outline has.
TEST(MorphDerivative, HoldsWhereNothingHasMovedYet) {
  const Mesh first = spread(world(), test::Grid{14}.mesh());
  const Geometry old = outline_moved(world(), first, [](Point p) { return p; });
  const OutlineChange change{old, "old.geom", &old};
  const std::vector<Point> velocity = MorphDerivative(world(), first, change).velocity(directions(old));
  Mesh ahead = first;
  const double h = 1e-6;
  const Geometry to = outline_moved(world(), first, [&](Point p) { return p + h * direction_at(p); });
  morph_mesh(world(), ahead, {to, "to.geom", &old});
  for (std::int32_t i = 0; i < first.owned_nodes; ++i)
    EXPECT_LT(length((1 / h) * (ahead.points[i] - first.points[i]) - velocity[i]), 1e-4);
}

TEST(MorphDerivative, WantsPointsThatStandForEachOther) {
  const Mesh mesh = spread(world(), test::Grid{6}.mesh());
  const Geometry same = outline_moved(world(), mesh, [](Point p) { return p; });
  const OutlineChange change{same, "same.geom"};
  EXPECT_THROW(MorphDerivative(world(), mesh, change), InputError);
}

}  // namespace
}  // namespace quadloop::adapt
