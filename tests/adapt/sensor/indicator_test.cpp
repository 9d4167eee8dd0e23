// Indicators of leaves: worked out by hand, by brute force from their definition, and the same bits on any
// number of ranks.
#include "adapt/sensor/indicator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "adapt/sensor/interpolation_error.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/layered_strip.hpp"
#include "tests/mesh/two_blocks.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::field_of;
using test::world;
using Leaves = std::vector<LeafRecord>;
using Values = std::vector<double>;

constexpr Indicator all_kinds[] = {Indicator::difference, Indicator::gradient, Indicator::hessian};

double wave(std::int64_t, Point p) { return std::sin(7 * p.x) * std::cos(5 * p.y) + 0.3 * p.x; }
double noise(std::int64_t node, Point) { return 1e5 * test::scattered(9, node, 0); }

/// A square of one leaf beside a square of two triangles, which are two leaves; a leaf without cells between
/// them.
///     3---4---5
///     |   | / |
///     0---1---2
Mesh two_squares() {
  const auto node = [](std::int32_t number) { return NodeId{number}; };
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  mesh.owned_nodes = 6;
  mesh.quads = {{node(0), node(1), node(4), node(3)}};
  mesh.triangles = {{node(1), node(2), node(5)}, {node(1), node(5), node(4)}};
  return mesh;
}

Leaves leaves_of_two_squares() {
  return {test::leaf_with(0, 1), {}, test::leaf_with(1, 0), test::leaf_with(1, 0)};
}

/// What all leaves of two_squares get from fields given node by node.
Values of_two_squares(const std::vector<Values>& fields_by_node, Indicator kind) {
  const Mesh mesh = two_squares(), part = test::Pieces(mesh, own_order(mesh)).part;
  Field field;
  for (std::size_t k = 0; k < fields_by_node.size(); ++k) field.names.push_back("q" + std::to_string(k));
  for (std::int32_t node = 0; node < part.owned_nodes; ++node) {
    for (const Values& by_node : fields_by_node) field.values.push_back(by_node[part.first_node + node]);
  }
  const Leaves own = test::share_of(leaves_of_two_squares(), test::Sharing::uneven);
  return test::joined(world(), leaf_indicator(world(), part, own, field, kind));
}

TEST(Indicator, DifferenceIsTheLargestChangeOfAnEdge) {
  EXPECT_EQ(of_two_squares({{0, 1, 4, 0, 1, 2}}, Indicator::difference), (Values{0.25, 0, 0.75, 0.25}));
  EXPECT_EQ(of_two_squares({{4, 4, 4, 4, 4, 0}}, Indicator::difference), (Values{0, 0, 1, 1}));
  EXPECT_EQ(of_two_squares({{0, 3, 3, 0, 3, 3}}, Indicator::difference), (Values{1, 0, 0, 0}));
}

TEST(Indicator, GradientIsTheChangeByLength) {
  EXPECT_EQ(of_two_squares({{4, 2, 2, 4, 0, 4}}, Indicator::gradient), (Values{1, 0, 0.5, 1}));
  EXPECT_EQ(of_two_squares({{0, 0, 1, 0, 1, 2}}, Indicator::gradient),
            (Values{0.5, 0, 2 * 0.5 / std::sqrt(2.0), 2 * 0.5 / std::sqrt(2.0)}));
}

TEST(Indicator, TakesTheLargestOfSeveralVariables) {
  const Values up{0, 10, 10, 0, 10, 10}, peak{0, 0, 1, 0, 0, 0}, still{7, 7, 7, 7, 7, 7};
  EXPECT_EQ(of_two_squares({peak, up}, Indicator::difference), (Values{1, 0, 1, 0}));
  EXPECT_EQ(of_two_squares({up, still, peak}, Indicator::difference), (Values{1, 0, 1, 0}));
  EXPECT_EQ(of_two_squares({still}, Indicator::difference), (Values{0, 0, 0, 0}));
  EXPECT_EQ(of_two_squares({}, Indicator::difference), (Values{0, 0, 0, 0}));
}

TEST(Indicator, HessianIsTheChangeOfTheGradientAlongAnEdge) {
  test::Grid strip{3, {3, 3}};
  Mesh mesh = strip.mesh();
  mesh.triangles.clear();
  mesh.quads.clear();
  for (std::int32_t i = 0; i < 3; ++i)
    mesh.quads.push_back({NodeId{i}, NodeId{i + 1}, NodeId{i + 5}, NodeId{i + 4}});
  const Mesh part = test::Pieces(mesh, own_order(mesh)).part;
  // x^2 at 0, 1, 2, 3 has range 9, cell gradients 1, 3, 5, nodal ones 1, 2, 4, 5. Nodes of no cell are not to
  // matter: 0.
  const Field field =
      field_of(part, "q", [](std::int64_t node, Point p) { return node < 8 ? p.x * p.x : 0; });
  const Leaves leaves{test::leaf_with(0, 1), test::leaf_with(0, 1), test::leaf_with(0, 1)};
  const Values found = test::joined(
      world(),
      leaf_indicator(world(), part, test::share_of(leaves, test::Sharing::even), field, Indicator::hessian));
  const Values expected{1.0 / 9, 2.0 / 9, 1.0 / 9};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-15);
}

TEST(Indicator, LinearFieldsHaveNoHessianAndOneGradient) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    const Leaves own = test::share_of(test::leaves_of(pieces.whole, 4), test::Sharing::uneven);
    for (const double level : {0.0, 1e5}) {
      const Field linear =
          field_of(pieces.part, "q", [&](std::int64_t, Point p) { return level + 3 * p.x - 2 * p.y; });
      for (const double value : leaf_indicator(world(), pieces.part, own, linear, Indicator::hessian))
        EXPECT_EQ(value, 0);
      for (const double value : leaf_indicator(world(), pieces.part, own, linear, Indicator::gradient))
        EXPECT_LE(value, std::sqrt(13.0) / 5 * (1 + 1e-9));
    }
  });
}

/// What all leaves of two_squares get from a variable of its cells: two triangles, then the quad.
Values of_cells_of_two_squares(const Values& cells, Indicator kind) {
  const Mesh mesh = two_squares(), part = test::Pieces(mesh, own_order(mesh)).part;
  const Field field = scatter_field(world(), {{}, {}, {}, {{"q"}, cells}}, part, own_order(mesh));
  const Leaves own = test::share_of(leaves_of_two_squares(), test::Sharing::uneven);
  return test::joined(world(), leaf_indicator(world(), part, own, field, kind));
}

TEST(Indicator, OfCellsIsTheLargestJumpToANeighbour) {
  EXPECT_EQ(of_cells_of_two_squares({0, 4, 1}, Indicator::difference), (Values{0.75, 0, 1, 1}));
  EXPECT_EQ(of_cells_of_two_squares({2, 2, 2}, Indicator::difference), (Values{0, 0, 0, 0}));
  EXPECT_EQ(of_cells_of_two_squares({0, 0, 8}, Indicator::difference), (Values{1, 0, 0, 1}));
  const Values slopes = of_cells_of_two_squares({0, 0, 8}, Indicator::gradient);
  const double distance = length(Point{4.0 / 3, 2.0 / 3} - Point{0.5, 0.5});
  EXPECT_NEAR(slopes[0], 1 / distance, 1e-14);
  EXPECT_EQ(slopes[0], slopes[3]);
  EXPECT_EQ(of_cells_of_two_squares({0, 4, 1}, Indicator::hessian), (Values{0, 0, 0, 0}));
}

/// The sensors of a function's values at the centroids.
Values of_cells(const test::Pieces& pieces, const std::function<double(Point)>& value, Indicator kind) {
  Field field{{}, {}, {}, {{"q"}, {}}};
  for (const CellShape& shape : cell_shapes(pieces.part)) field.cells.values.push_back(value(shape.centroid));
  const Leaves own = test::share_of(test::leaves_of(pieces.whole, 4), test::Sharing::uneven);
  return test::joined(world(), leaf_indicator(world(), pieces.part, own, field, kind));
}

TEST(Indicator, OfCellsHasTheSameBitsOnAnyNumberOfRanks) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    Field field{{}, {}, {}, {{"q"}, {}}};
    for (const CellShape& shape : cell_shapes(pieces.whole))
      field.cells.values.push_back(wave(0, shape.centroid));
    const Communicator alone(MPI_COMM_SELF);
    for (const Indicator kind : all_kinds) {
      const Values whole = leaf_indicator(alone, pieces.whole, test::leaves_of(pieces.whole, 4), field, kind);
      EXPECT_EQ(of_cells(
                    pieces, [](Point p) { return wave(0, p); }, kind),
                whole);
    }
  });
}

TEST(Indicator, OfCellsSeesNoHessianInALinearFunction) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    for (const double value : of_cells(
             pieces, [](Point p) { return 3 * p.x - p.y; }, Indicator::hessian))
      EXPECT_LT(value, 1e-11);
  });
}

TEST(Indicator, DoesNotKnowUnits) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    const Leaves own = test::share_of(test::leaves_of(pieces.whole, 4), test::Sharing::even);
    const auto indicator = [&](double factor, Indicator kind) {
      const Field field =
          field_of(pieces.part, "q", [&](std::int64_t node, Point p) { return factor * wave(node, p); });
      return leaf_indicator(world(), pieces.part, own, field, kind);
    };
    for (const Indicator kind : all_kinds) EXPECT_EQ(indicator(1, kind), indicator(0x1p20, kind));
  });
}

TEST(Indicator, IsTheSameOnAnyNumberOfRanks) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    const Leaves leaves = test::leaves_of(pieces.whole, 4);
    const auto fields_of = [](const Mesh& mesh) {
      return test::joined_fields(field_of(mesh, "a", wave), field_of(mesh, "b", noise));
    };
    for (const Indicator kind : all_kinds) {
      const Values whole =
          leaf_indicator(Communicator(MPI_COMM_SELF), pieces.whole, leaves, fields_of(pieces.whole), kind);
      EXPECT_GT(*std::max_element(whole.begin(), whole.end()), 0);
      for (const test::Sharing sharing : test::all_sharings) {
        const Leaves own = test::share_of(leaves, sharing);
        EXPECT_EQ(leaf_indicator(world(), pieces.part, own, fields_of(pieces.part), kind),
                  test::share_of(whole, sharing));
      }
    }
  });
}

TEST(Indicator, RefusesWhatIsNotFinite) {
  const Mesh mesh = two_squares(), part = test::Pieces(mesh, own_order(mesh)).part;
  const Leaves own = test::share_of(leaves_of_two_squares(), test::Sharing::even);
  const double bad = std::numeric_limits<double>::quiet_NaN();
  const Field fields = test::joined_fields(
      field_of(part, "density", wave),
      field_of(part, "pressure", [&](std::int64_t node, Point) { return node == 4 ? bad : 1; }));
  try {
    leaf_indicator(world(), part, own, fields, Indicator::difference);
    FAIL() << "nothing was refused";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("variable 'pressure': node 5 at (1, 1)", 0), 0U)
        << error.what();
  }
}

TEST(LeafErrors, AreTheLargestAtTheLeafsNodes) {
  const Mesh mesh = two_squares(), part = test::Pieces(mesh, own_order(mesh)).part;
  const Leaves own = test::share_of(leaves_of_two_squares(), test::Sharing::uneven);
  const auto errors = [&](const Values& by_node) {
    const Field field = field_of(part, "e", [&](std::int64_t node, Point) { return by_node[node]; });
    return test::joined(world(), leaf_errors(world(), part, own, field));
  };
  EXPECT_EQ(errors({5, 1, 2, 1, 3, 0}), (Values{5, 0, 2, 3}));
  EXPECT_EQ(errors({0, 0, 0, 0, 0, 1e-9}), (Values{0, 0, 1e-9, 1e-9}));
  EXPECT_THROW(errors({0, 0, 0, 0, -1e-9, 0}), InputError);
}

TEST(Indicator, EdgesAcrossLayersDoNotCount) {
  for (const bool triangles : {false, true}) {
    test::LayeredStrip strip;
    strip.from = 0;
    strip.triangles = triangles;
    const Mesh mesh = strip.mesh();
    Leaves leaves;  // of each column its layers, and what is above
    for (std::int32_t k = 0; k < 2 * strip.columns; ++k)
      leaves.push_back(triangles ? test::leaf_with(2 * strip.layers, 0) : test::leaf_with(0, strip.layers));
    const auto of = [&](const auto& value, Indicator kind) {
      Field field{{"q"}, {}, {}};
      for (const Point p : mesh.points) field.values.push_back(value(p));
      return leaf_indicator(Communicator(MPI_COMM_SELF), mesh, leaves, field, kind);
    };
    const double height = strip.height(strip.rows());
    const Values across = of([](Point p) { return p.y; }, Indicator::difference);
    const Values along = of([](Point p) { return p.x; }, Indicator::difference);
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
      EXPECT_NEAR(across[leaf], leaf % 2 == 0 ? 0 : 1 / height, 1e-12) << leaf;
      EXPECT_NEAR(along[leaf], 1.0 / strip.columns, 1e-12) << leaf;
    }
  }
}

TEST(Indicator, EdgesWithinStripsDoNotCount) {
  const test::LayeredStrip grid{.columns = 4, .layers = 2, .from = 0};
  Mesh mesh = grid.mesh();
  for (BoundaryEdges& boundary : mesh.boundaries) boundary.layers = {};
  StripLayers strip{"wake", {1, 1}, false, 3, {}};
  for (std::int32_t i = 0; i <= 4; ++i) {
    for (std::int32_t j = 1; j <= 3; ++j) strip.nodes.push_back(mesh.global(grid.node(i, j)));
  }
  mesh.strips = {strip};
  const Leaves leaves(16, test::leaf_with(0, 1));  // from below, column after column
  Field field{{"q"}, {}, {}};
  for (const Point p : mesh.points) field.values.push_back(p.x);
  const Values along =
      leaf_indicator(Communicator(MPI_COMM_SELF), mesh, leaves, field, Indicator::difference);
  for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf) {
    const bool within = leaf % 4 == 1 || leaf % 4 == 2;
    EXPECT_NEAR(along[leaf], within ? 0 : 0.25, 1e-12) << leaf;
  }
}

TEST(Indicator, TheJumpAcrossAnInterfaceIsNoError) {
  Mesh whole = test::two_blocks({6, {1, 1}, false});
  const Mesh mesh = test::part_with_blocks(world(), whole, own_order(whole));
  const Leaves leaves = test::share_of(Leaves(72, test::leaf_with(1, 0)), test::Sharing::uneven);
  Field in_cells{{}, {}, {}, {{"T"}, {}}}, kink{{"T"}, {}, {}};
  for (const std::int32_t block : mesh.blocks.of_triangles) in_cells.cells.values.push_back(100.0 * block);
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node)
    kink.values.push_back(std::abs(mesh.point(NodeId{node}).x - 0.5));
  const auto largest = [&](const Mesh& of, const Field& field, Indicator kind) {
    const Values values = test::joined(world(), leaf_indicator(world(), of, leaves, field, kind));
    return *std::ranges::max_element(values);
  };
  Mesh one_block = mesh;
  one_block.blocks = {};
  for (const Indicator kind : all_kinds) {
    EXPECT_EQ(largest(mesh, in_cells, kind), 0);
    EXPECT_GT(largest(one_block, in_cells, kind), 0);
  }
  EXPECT_NEAR(largest(mesh, kink, Indicator::hessian), 0, 1e-12);
  EXPECT_GT(largest(one_block, kink, Indicator::hessian), 0.1);
  const InterpolationError error = interpolation_error(world(), mesh, kink);
  for (const double mean : error.mean) EXPECT_NEAR(mean, 0, 1e-12);
}

}  // namespace
}  // namespace quadloop::adapt
