// Meshes of curved domains: nodes lie on the curves in cut, smoothed, layered and Delaunay meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "generate/digests.hpp"
#include "generate/generate.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

const EllipticArc ellipse{{0.1, 0.05}, {0.4, 0.1}, {-0.05, 0.2}, 0, 2 * std::numbers::pi};

/// The ellipse's equation, 0 on it; its gradient is of the order of 1 / 0.2.
double off_ellipse(Point p) {
  const Point d = p - ellipse.centre;
  const double whole = cross(ellipse.major, ellipse.minor);
  const double u = cross(d, ellipse.minor) / whole, v = cross(ellipse.major, d) / whole;
  return std::abs(u * u + v * v - 1);
}

MeshInput ellipse_in_box(bool layers) {
  Chain box{"box", false, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, "box"};
  Chain body{"body", true, {ellipse.point_at(0)}, "body"};
  append_arc(body, ellipse, body.points.front());
  body.points.pop_back();
  body.open = false;
  AssembleOptions options;
  options.rules.resize(1);
  options.rules[0].pattern = "body";
  options.rules[0].spacing = 0.03;
  if (layers) {
    LayerSpec& spec = options.rules[0].layers.emplace();
    spec.first = 1e-4;
    spec.growth = spec.growth_to = 1.3;
    spec.count = 12;
  }
  Warnings warnings;
  MeshInput input{assemble({box, body}, options, warnings), {}, {}, 0};
  input.mesh.size.min = 0.015;
  input.mesh.size.max = 0.25;
  input.digest = case_digest(input.mesh);
  return input;
}

/// Number of edges of the body; all their nodes are on the ellipse.
int expect_on_ellipse(const Mesh& whole) {
  int edges = 0;
  for (const BoundaryEdges& boundary : whole.boundaries) {
    if (boundary.name != "body") continue;
    for (const auto& edge : boundary.edges) {
      ++edges;
      EXPECT_LT(off_ellipse(whole.point(edge[0])), 1e-13);
    }
  }
  return edges;
}

TEST(Curves, NodesLieOnAnEllipse) {
  for (const bool layers : {false, true}) {
    for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
      for (const int sweeps : {0, 10}) {
        MeshInput input = ellipse_in_box(layers);
        input.mesh.type = type;
        input.smooth.sweeps = sweeps;
        const GeneratedMesh made = generate_mesh(world(), input);
        const Mesh whole = gather_whole(world(), made.result.mesh);
        if (world().is_root()) {
          EXPECT_GT(expect_on_ellipse(whole), 50);
          EXPECT_TRUE(validate(whole).empty());
          EXPECT_EQ(is_delaunay(whole), type == MeshType::delaunay && !layers);
        }
      }
    }
  }
}

TEST(Curves, LayersKeepTheirHeightsOnACurve) {
  const MeshInput input = ellipse_in_box(true);
  const GeneratedMesh made = generate_mesh(world(), input);
  ASSERT_EQ(made.layers.size(), 1U);
  EXPECT_GT(made.layers[0].share_least, 0.98);
  EXPECT_NEAR(made.layers[0].first_least, 1e-4, 2e-6);
}

}  // namespace
}  // namespace quadloop
