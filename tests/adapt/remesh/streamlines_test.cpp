// Streamlines of velocity fields with known ones.
#include "adapt/remesh/streamlines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/adapt/transfer/jittered_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

using Velocity = std::function<Point(Point)>;

Field field_of(const Mesh& mesh, const Velocity& velocity, const std::string& what = "velocity") {
  Field field{{"x_" + what, "density", "y_" + what}, {}, {}};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const Point v = velocity(mesh.point(NodeId{node}));
    field.values.insert(field.values.end(), {v.x, 1.5, v.y});
  }
  return field;
}

/// The line on a jittered mesh of the square from 0 to 4, spread over the ranks of `comm`.
Streamline line_from(const Communicator& comm, const StreamlineStart& start, const Velocity& velocity,
                     const std::string& what = "velocity") {
  const Mesh part = test::jittered({.n = 24, .size = {4, 4}}, 0.2, 7).part(comm);
  const auto direction = flow_direction(comm, part, field_of(part, velocity, what));
  EXPECT_TRUE(direction);
  return streamlines(comm, part, *direction, {start, start}).back();
}

StreamlineStart start_at(Point edge, Point bisector) {
  return {.edge = edge, .bisector = bisector, .offset = 0.1, .step = 0.05, .length = 1.5};
}

TEST(Streamlines, FollowAUniformFlowBehindAGentleBeginning) {
  const double angle = 0.3;
  const Point flow{std::cos(angle), std::sin(angle)};
  for (const char* what : {"velocity", "momentum"}) {
    const Streamline line = line_from(
        world(), start_at({1, 1}, {1, 0}), [&](Point) { return 3.0 * flow; }, what);
    EXPECT_EQ(line.end, Streamline::End::complete);
    ASSERT_GT(line.points.size(), 20U);
    EXPECT_EQ(line.points[0], (Point{1, 1}));
    const Point first = line.points[1] - line.points[0];
    EXPECT_NEAR(length(first), 0.1, 1e-12);
    EXPECT_NEAR(std::atan2(first.y, first.x), angle / 2, 1e-12) << "between bisector and flow";
    double whole = 0;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const Point step = line.points[i] - line.points[i - 1];
      whole += length(step);
      if (i > 1) {
        EXPECT_NEAR(cross(step, flow), 0, 1e-12);
      }
    }
    EXPECT_NEAR(whole, 1.5, 1e-12);
  }
}

/// The largest change of the radius along a solid rotation around (2, 2).
double drift_of_rotation(double step) {
  StreamlineStart start = start_at({3, 2}, {0, 1});
  start.step = step;
  const Streamline line = line_from(world(), start, [](Point p) { return Point{2 - p.y, p.x - 2}; });
  EXPECT_EQ(line.end, Streamline::End::complete);
  const double radius = length(line.points[1] - Point{2, 2});
  double drift = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i)
    drift = std::max(drift, std::abs(length(line.points[i] - Point{2, 2}) - radius));
  return drift;
}

/// The midpoint rule keeps the radius to the third order, as the error of second order is along the circle.
TEST(Streamlines, KeepTheRadiusOfASolidRotation) {
  const double coarse = drift_of_rotation(0.1), fine = drift_of_rotation(0.05);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_GT(coarse, 1e-6) << "the steps are long enough to tell";
  EXPECT_GT(coarse, 3.5 * fine);
}

TEST(Streamlines, AreTheSameOnAnyNumberOfRanks) {
  const Velocity wavy = [](Point p) { return Point{1 + 0.3 * std::sin(3 * p.y), 0.5 * std::cos(2 * p.x)}; };
  const Streamline line = line_from(world(), start_at({1, 1}, {1, 0}), wavy),
                   alone = line_from(Communicator(MPI_COMM_SELF), start_at({1, 1}, {1, 0}), wavy);
  EXPECT_EQ(line.points, alone.points) << "to the last bit";
  EXPECT_GT(line.points.size(), 20U);
}

TEST(Streamlines, EndWhereThereIsNoFlowToFollow) {
  const Streamline leaving = line_from(world(), start_at({3.5, 1}, {1, 0}), [](Point) {
    return Point{1, 0};
  });
  EXPECT_EQ(leaving.end, Streamline::End::outside);
  EXPECT_LE(leaving.points.back().x, 4);
  EXPECT_GT(leaving.points.back().x, 3.94);
  const Streamline back = line_from(world(), start_at({1, 1}, {1, 0}), [](Point) { return Point{-1, 0.1}; });
  EXPECT_EQ(back.end, Streamline::End::no_start);
  EXPECT_EQ(back.points.size(), 1U);
  const Streamline still = line_from(world(), start_at({1, 1}, {1, 0}), [](Point) { return Point{0, 0}; });
  EXPECT_EQ(still.end, Streamline::End::no_start);
  const Streamline stopped = line_from(world(), start_at({1, 1}, {1, 0}), [](Point p) {
    return Point{2 - p.x, 0};
  });
  EXPECT_EQ(stopped.end, Streamline::End::reversed);
  EXPECT_NEAR(stopped.points.back().x, 2, 0.2);
}

TEST(Streamlines, OfASolutionInCellsUseTheMiddleOfTheirRange) {
  const Mesh part = test::jittered({.n = 24, .size = {4, 4}}, 0.2, 7).part(world());
  Field field;
  field.cells.names = {"U_x", "U_y"};
  for (std::size_t cell = 0; cell < static_cast<std::size_t>(part.cell_count()); ++cell)
    field.cells.values.insert(field.cells.values.end(), {2, 1});
  const auto direction = flow_direction(world(), part, field);
  ASSERT_TRUE(direction);
  for (std::int32_t node = 0; node < part.owned_nodes; ++node) {
    EXPECT_EQ(direction->row(NodeId{node})[0], 2);
    EXPECT_EQ(direction->row(NodeId{node})[1], 1);
  }
  EXPECT_FALSE(flow_direction(world(), part, {{"density"}, std::vector<double>(part.owned_nodes), {}}));
}

}  // namespace
}  // namespace quadloop::adapt
