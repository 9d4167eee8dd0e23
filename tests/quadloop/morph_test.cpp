// Morph: closed and open lines, blocks, other numbers of points, derivatives in both directions.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "quadloop/quadloop.hpp"
#include "tests/quadloop/mesh_of_text.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::mesh_of_text, test::world;
using Points = std::vector<Point>;

const Points corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, moved{{0, 0}, {1.2, 0.1}, {1, 1}, {0, 1}};

MorphGeometry side(const Points& points) { return MorphGeometry({{"side", points}}); }

/// The closest a node of a boundary lies to a point, over all ranks.
double distance_to(const Mesh& mesh, const std::string& boundary, Point p) {
  double least = 1e9;
  for (const BoundaryEdges& edges : mesh.boundaries) {
    if (edges.name != boundary) continue;
    for (const auto& [a, b] : edges.edges)
      least = std::min({least, length(mesh.point(a) - p), length(mesh.point(b) - p)});
  }
  return world().minimum(least);
}

/// The message of the InputError of a morph; empty if there is none.
std::string fault_of(const Mesh& mesh, const MorphGeometry& from, const MorphGeometry& to) {
  return test::refusal_text([&] { const Morph morph(world(), mesh, from, to); });
}

TEST(Morph, MovesAMeshWithDerivativesInBothDirections) {
  const Mesh mesh = mesh_of_text(test::unit_square);
  const Morph morph(world(), mesh, side(corners), side(moved));
  EXPECT_FALSE(morph.report().smoothed);
  EXPECT_NEAR(morph.report().largest_move, std::hypot(0.2, 0.1), 1e-12);
  EXPECT_TRUE(check(world(), *morph.mesh()).empty());
  const Points velocity = morph.push_forward({{{}, {1, 0}, {}, {}}});
  ASSERT_EQ(velocity.size(), static_cast<std::size_t>(mesh.owned_nodes));
  std::vector<double> products;
  Points gradient;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    gradient.push_back({morph.mesh()->points[i].y, 1});
    products.push_back(dot(gradient.back(), velocity[i]));
  }
  const std::vector<Points> back = morph.pull_back(gradient);
  EXPECT_NEAR(back.at(0).at(1).x, reproducible_sum(world(), products), 1e-9);
  EXPECT_GT(back.at(0).at(1).x, 1);
  EXPECT_THROW(morph.push_forward({{{}, {1, 0}, {}}}), InputError);
  EXPECT_THROW(morph.push_forward({}), InputError);
  EXPECT_THROW(morph.pull_back(Points(3)), InputError);
}

TEST(Morph, NamesThePossibleShareOfAChange) {
  const Mesh mesh = mesh_of_text(test::unit_square);
  const double quality = Morph(world(), mesh, side(corners), side(moved)).report().worst_after;
  EXPECT_LT(quality, 0.95);
  try {
    const Morph too_bad(world(), mesh, side(corners), side(moved), 0.5 * (quality + 1));
    ADD_FAILURE() << "accepted";
  } catch (const TooFar& error) {
    EXPECT_GT(error.share, 0.2);
    EXPECT_LT(error.share, 0.9) << "of the change";
  }
  EXPECT_NE(
      fault_of(mesh, MorphGeometry({{"hole", corners}}), MorphGeometry({{"hole", moved}})).find("none of"),
      std::string::npos);
}

TEST(Morph, PointsOfAnotherNumberCorrespondByArcLength) {
  const Mesh mesh = mesh_of_text(test::unit_square);
  Points finer;
  for (std::size_t k = 0; k < moved.size(); ++k)
    finer.insert(finer.end(), {moved[k], 0.5 * (moved[k] + moved[(k + 1) % moved.size()])});
  const Morph by_points(world(), mesh, side(corners), side(moved));
  for (const MorphGeometry& from : {MorphGeometry(), side(corners)}) {
    const Morph by_arc(world(), mesh, from, side(finer));
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
      EXPECT_LT(length(by_arc.mesh()->points[i] - by_points.mesh()->points[i]), 1e-12);
    for (int times = 0; times < 2; ++times) {
      const std::string said = test::refusal_text([&] { by_arc.push_forward({finer}); });
      EXPECT_NE(said.find("as many points"), std::string::npos) << said;
    }
  }
}

TEST(Morph, InnerLinesMoveWithTheirPieces) {
  const Points old_line{{0.2, 0.5}, {0.5, 0.5}, {0.8, 0.5}}, new_line{{0.2, 0.5}, {0.5, 0.55}, {0.8, 0.5}};
  const Mesh mesh = mesh_of_text(test::unit_square +
                                 "[[line]]\nname = \"cut\"\npath = [[0.2, 0.5], [0.5, 0.5], [0.8, 0.5]]\n");
  const auto geometry = [](const Points& line) {
    return MorphGeometry({{"side", corners}, {"cut", line, true}});
  };
  const Morph morph(world(), mesh, geometry(old_line), geometry(new_line));
  EXPECT_TRUE(check(world(), *morph.mesh()).empty());
  EXPECT_LT(distance_to(*morph.mesh(), "cut", {0.5, 0.55}), 0.03);
  EXPECT_LT(distance_to(*morph.mesh(), "cut", {0.2, 0.5}), 1e-12);
  EXPECT_GT(distance_to(mesh, "cut", {0.5, 0.55}), 0.04);
  EXPECT_THROW(morph.push_forward({corners, old_line}), InputError);
  EXPECT_NE(fault_of(mesh, geometry(old_line), side(corners)).find("its pieces are not those of"),
            std::string::npos);
}

TEST(Morph, BlocksThatEndOnTheBoundaryMoveWithTheirPieces) {
  const Mesh mesh = mesh_of_text(test::square_of_blocks);
  ASSERT_EQ(mesh.blocks.names.size(), 2U);
  const auto geometry = [](Point middle) {
    return MorphGeometry({{"left", {{0.5, 1}, {0, 1}, {0, 0}, {0.5, 0}}, true},
                          {"right", {{0.5, 0}, {1, 0}, {1, 1}, {0.5, 1}}, true},
                          {"between", {{0.5, 0}, middle, {0.5, 1}}, true}});
  };
  const Morph morph(world(), mesh, geometry({0.5, 0.5}), geometry({0.56, 0.5}));
  EXPECT_TRUE(check(world(), *morph.mesh()).empty());
  EXPECT_LT(distance_to(*morph.mesh(), "between", {0.56, 0.5}), 0.06);
  EXPECT_LT(distance_to(*morph.mesh(), "left", {0.5, 0}), 1e-12);
  EXPECT_EQ(morph.mesh()->blocks.of_triangles, mesh.blocks.of_triangles);
  EXPECT_NE(fault_of(mesh, MorphGeometry(), geometry({0.56, 0.5})).find("with the same pieces"),
            std::string::npos);
}

TEST(Morph, ReadsGeometryFiles) {
  const test::TemporaryFolder folder;
  folder.write("new.geom", "1\nside\n4\n0 0\n1.2 0.1\n1 1\n0 1\n");
  const MorphGeometry file(world(), folder.file("new.geom"));
  ASSERT_EQ(file.lines().size(), 1U);
  EXPECT_EQ(file.lines()[0].points, moved);
  const Mesh mesh = mesh_of_text(test::unit_square);
  EXPECT_EQ(Morph(world(), mesh, side(corners), file).mesh()->points,
            Morph(world(), mesh, side(corners), side(moved)).mesh()->points);
  EXPECT_THROW(MorphGeometry(world(), folder.file("none.geom")), InputError);
  EXPECT_THROW(MorphGeometry({{"side", {{0, 0}, {NAN, 0}, {0, 1}}}}), InputError);
  EXPECT_NE(fault_of(mesh, side(corners), MorphGeometry({{"side", corners, true}})), "") << "an open line";
}

}  // namespace
}  // namespace quadloop
