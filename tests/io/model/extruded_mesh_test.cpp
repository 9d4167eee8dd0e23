// The numbers of an extruded mesh, its names, and what becomes of a solution.
#include "io/model/extruded_mesh.hpp"

#include <gtest/gtest.h>

#include "tests/mesh/grid_mesh.hpp"

namespace quadloop::io {
namespace {

Mesh square() {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.owned_nodes = 4;
  mesh.quads = {{NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}}};
  mesh.boundaries = {{"wall", "wall", {{NodeId{0}, NodeId{1}}}}};
  return mesh;
}

TEST(ExtrudedMesh, NumbersLevelsOfANodeOneAfterAnother) {
  const Mesh plane = square();
  const ExtrudedMesh mesh = extruded(plane, {0, 1, 3}, ExtrusionAxis::z);
  EXPECT_EQ(mesh.point_rows(), 12);
  EXPECT_EQ(mesh.point(5), (Point3{1, 0, 3}));
  EXPECT_EQ(mesh.hexahedron(1), (std::array<NodeNumber, 8>{1, 4, 7, 10, 2, 5, 8, 11}));
  EXPECT_EQ(mesh.side(GlobalNodeId{0}, GlobalNodeId{1}, 0), (std::array<NodeNumber, 4>{0, 3, 4, 1}));
  EXPECT_EQ(mesh.back_face(plane.quads[0]), (std::array<NodeNumber, 4>{9, 6, 3, 0}));
  EXPECT_EQ(mesh.front_face(plane.quads[0]), (std::array<NodeNumber, 4>{2, 5, 8, 11}));
}

TEST(ExtrudedMesh, AlongYThePlaneStandsUp) {
  const Mesh plane = square();
  const ExtrudedMesh mesh = extruded(plane, {0, 1, 3}, ExtrusionAxis::y);
  EXPECT_EQ(mesh.point(9), (Point3{0, 3, 1}));   // of the node (0, 1) the level at the back
  EXPECT_EQ(mesh.point(11), (Point3{0, 0, 1}));  // and at the front
  EXPECT_EQ(mesh.height(), 3);
}

TEST(ExtrudedMesh, EndsGetNamesThatAreFree) {
  Mesh plane = square();
  plane.boundaries.push_back({"front", "none", {}});
  plane.boundaries.push_back({"front_2", "none", {}});
  const ExtrudedMesh mesh = extruded(plane, {0, 1}, ExtrusionAxis::z);
  EXPECT_EQ(mesh.front, "front_3");
  EXPECT_EQ(mesh.back, "back");
}

TEST(ExtrudedMesh, EvenHeightsEndAtTheThickness) {
  const std::vector<double> heights = even_heights(3, 0.3);
  EXPECT_EQ(heights.size(), 4);
  EXPECT_EQ(heights.front(), 0);
  EXPECT_EQ(heights.back(), 0.3);
}

TEST(ExtrudedMesh, VectorsStayInThePlane) {
  const auto names = [](const Field& field, ExtrusionAxis axis) {
    std::vector<std::string> result;
    for (const ExtrudedVariable& variable : extruded_variables(field.names, axis))
      result.push_back(variable.name + ":" + std::to_string(variable.column));
    return result;
  };
  using Names = std::vector<std::string>;
  const Field field{{"density", "u", "y_velocity"}, {}, {}};
  EXPECT_EQ(names(field, ExtrusionAxis::z),
            (Names{"density:0", "x_velocity:1", "y_velocity:2", "z_velocity:-1"}));
  EXPECT_EQ(names(field, ExtrusionAxis::y),
            (Names{"density:0", "x_velocity:1", "z_velocity:2", "y_velocity:-1"}));
  EXPECT_EQ(names({{"x_momentum", "t"}, {}, {}}, ExtrusionAxis::y), (Names{"x_momentum:0", "t:1"}));
}

}  // namespace
}  // namespace quadloop::io
