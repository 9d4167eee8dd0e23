// The plane mesh of a 3D one that is one cell thick: on each axis, from either face, and what is none.
#include "io/model/plane_of_mesh3d.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "tests/mesh/node.hpp"

namespace quadloop::io {
namespace {

using test::node;

/// A unit square with a triangle on its right, drawn out from `low` to `high` across an axis; nodes of the
/// back from 0, those of the front from 5. The back and the front are empty.
FileMesh house(char across, double low = -0.5, double high = 0.25) {
  FileMesh mesh;
  for (const double along : {low, high}) {
    for (const auto& [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {1.5, 0.5}}) {
      mesh.points.push_back(across == 'z'   ? Point3{u, v, along}
                            : across == 'x' ? Point3{along, u, v}
                                            : Point3{u, -along, v});
    }
  }
  mesh.hexahedra = {{0, 1, 2, 3, 5, 6, 7, 8}};
  mesh.prisms = {{1, 4, 2, 6, 9, 7}};
  mesh.boundaries = {{"front", "symmetry", {{5, 6, 7, 8}, {6, 9, 7, FileBoundary::no_node}}, true},
                     {"wall", "wall", {{0, 1, 6, 5}, {1, 4, 9, 6}}},
                     {"rest", "none", {{3, 0, 5, 8}, {2, 3, 8, 7}, {4, 2, 7, 9}}},
                     {"back", "symmetry", {{3, 2, 1, 0}, {2, 4, 1, FileBoundary::no_node}}, true}};
  return mesh;
}

void expect_house(const Mesh& mesh) {
  EXPECT_EQ(mesh.points, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1.5, 0.5}}));
  EXPECT_EQ(mesh.owned_nodes, 5);
  ASSERT_EQ(mesh.quads.size(), 1U);
  EXPECT_EQ(mesh.quads[0], (std::array{node(0), node(1), node(2), node(3)}));
  ASSERT_EQ(mesh.triangles.size(), 1U);
  EXPECT_EQ(mesh.triangles[0], (std::array{node(1), node(4), node(2)}));
  ASSERT_EQ(mesh.boundaries.size(), 2U);
  EXPECT_EQ(mesh.boundaries[0].name, "wall");
  EXPECT_EQ(mesh.boundaries[0].condition, BoundaryCondition::wall);
  using Edges = std::vector<std::array<NodeId, 2>>;
  EXPECT_EQ(mesh.boundaries[0].edges, (Edges{{node(0), node(1)}, {node(1), node(4)}}));
  EXPECT_EQ(mesh.boundaries[1].edges, (Edges{{node(3), node(0)}, {node(2), node(3)}, {node(4), node(2)}}));
}

TEST(PlaneOfMesh3d, LiesAcrossAnyAxis) {
  for (const char across : {'x', 'y', 'z'}) {
    SCOPED_TRACE(across);
    expect_house(plane_of_mesh3d(house(across), "m").mesh);
  }
}

TEST(PlaneOfMesh3d, TakesTheSolutionOfTheBack) {
  FileMesh mesh3d = house('z');
  mesh3d.solution.emplace();
  mesh3d.solution->names = {"p"};
  for (int i = 0; i < 10; ++i) mesh3d.solution->values.push_back(i);
  EXPECT_EQ(plane_of_mesh3d(mesh3d, "m").solution->values, (std::vector<double>{0, 1, 2, 3, 4}));
}

TEST(PlaneOfMesh3d, SidesMayRunEitherWay) {
  FileMesh mesh3d = house('z');
  std::ranges::reverse(mesh3d.boundaries[1].faces[0]);
  mesh3d.boundaries[3].faces[0] = {0, 1, 2, 3};  // the back as seen from inside: its own first node stays
  const Mesh mesh = plane_of_mesh3d(mesh3d, "m").mesh;
  EXPECT_EQ(mesh.boundaries[0].edges[0], (std::array{node(0), node(1)}));
  EXPECT_EQ(mesh.quads[0], (std::array{node(0), node(1), node(2), node(3)}));
}

void expect_refusal(const FileMesh& mesh3d, const std::string& says) {
  try {
    plane_of_mesh3d(mesh3d, "m");
    ADD_FAILURE() << "not refused: " << says;
  } catch (const InputError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find(says), std::string::npos) << refusal.what();
    EXPECT_EQ(std::string(refusal.what()).find("m: "), 0U);
  }
}

TEST(PlaneOfMesh3d, RefusesWhatIsNoPlane) {
  EXPECT_TRUE(is_one_cell_thick(house('z')));
  FileMesh mesh3d = house('z');
  mesh3d.boundaries[0].is_empty = false;
  expect_refusal(mesh3d, "does not have two faces on such patches");
  mesh3d.boundaries[3].is_empty = false;
  EXPECT_FALSE(is_one_cell_thick(mesh3d));
  mesh3d = house('z');
  mesh3d.points[9].x += 1e-3;
  expect_refusal(mesh3d, "is not extruded along z");
  mesh3d.points[9].x = 1.5 + 1e-8;  // as writers of few digits leave it
  EXPECT_NO_THROW(plane_of_mesh3d(mesh3d, "m"));
  mesh3d = house('z');
  mesh3d.boundaries[1].is_empty = true;
  expect_refusal(mesh3d, "has more than two faces on such patches");
}

}  // namespace
}  // namespace quadloop::io
