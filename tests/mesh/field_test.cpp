// A field's rows and columns, its variables by any name, and its ways between the root, owners and copies.
#include "mesher/mesh/field.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mesher/base/error.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

double value_at(Point p, std::size_t variable) {
  return 1000.0 * static_cast<double>(variable) + 10 * p.x + p.y;
}

/// A row for each of the mesh's first nodes.
Field field_at(const Mesh& mesh, std::size_t nodes) {
  Field field{{"rho", "u", "p"}, {}, {7, 0.25}};
  for (std::size_t i = 0; i < nodes; ++i) {
    for (std::size_t k = 0; k < field.width(); ++k) field.values.push_back(value_at(mesh.points[i], k));
  }
  return field;
}

TEST(Field, AColumnIsOneVariableAtEachNode) {
  Field field{{"a", "b"}, {1, 2, 3, 4, 5, 6}, {}};
  field.row(NodeId{2})[1] = -6;
  EXPECT_EQ(field.column(1), (std::vector<double>{2, 4, -6}));
  EXPECT_TRUE((Field{{"a"}, {}, {}}).column(0).empty());
  EXPECT_THROW(field.column(2), Fault);
}

TEST(Field, GetsMoreColumnsBehindItsOwn) {
  Field field{{"a"}, {1, 2}, {7}};
  append_columns(field, std::vector<std::string>{"b", "c"}, std::vector<double>{3, 4, 5, 6});
  EXPECT_EQ(field.names, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(field.values, (std::vector<double>{1, 3, 4, 2, 5, 6}));
  EXPECT_EQ(field.constants, (std::vector<double>{7}));
  Field empty;
  append_columns(empty, std::vector<std::string>{"b"}, std::vector<double>{3, 4});
  EXPECT_EQ(empty.column(0), (std::vector<double>{3, 4}));
}

TEST(Field, SelectedVariablesAreFoundByUsualNames) {
  const Field field{{"Density", "VelocityX", "Pressure"}, {1, 2, 3, 4, 5, 6}, {9}};
  const std::vector<std::string> wanted{"p", "rho"};
  const Field chosen = selected(field, wanted, "here");
  EXPECT_EQ(chosen.names, (std::vector<std::string>{"Pressure", "Density"}));
  EXPECT_EQ(chosen.values, (std::vector<double>{3, 1, 6, 4}));
  EXPECT_EQ(chosen.constants, field.constants);
  EXPECT_TRUE(selected(field, {}, "here").values.empty());
  const std::vector<std::string> unknown{"mach"};
  EXPECT_THROW(selected(field, unknown, "here"), InputError);
  EXPECT_THROW(selected({}, unknown, "here"), InputError);
}

TEST(Field, GhostsGetTheirOwnersRows) {
  const test::Grid grid{7};
  const Mesh whole = grid.mesh(), mesh = scatter_mesh(world(), whole, test::shuffled_order(whole, 5));
  const Field expected = field_at(mesh, mesh.points.size());
  Field owned = field_at(mesh, static_cast<std::size_t>(mesh.owned_nodes));
  EXPECT_EQ(with_ghosts(world(), mesh, owned).values, expected.values);
  owned.values.resize(expected.values.size(), std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(with_ghosts(world(), mesh, owned).values, expected.values);
}

TEST(Field, IsScatteredWithItsMeshAndGathered) {
  for (const std::int32_t n : {1, 2, 7}) {  // four nodes are fewer than five ranks
    const Mesh whole = test::Grid{n}.mesh();
    for (const MeshOrder& order :
         {own_order(whole), space_filling_order(whole), test::shuffled_order(whole, 3)}) {
      const Mesh part = scatter_mesh(world(), whole, order);
      const Field of_whole = field_at(whole, whole.points.size());
      const Field field = scatter_field(world(), world().is_root() ? of_whole : Field{}, part, order);
      EXPECT_EQ(field.names, of_whole.names);
      EXPECT_EQ(field.constants, of_whole.constants);
      EXPECT_EQ(field.values, field_at(part, static_cast<std::size_t>(part.owned_nodes)).values);
      const Field back = gather_field(world(), field, part, order);
      EXPECT_EQ(back.values, world().is_root() ? of_whole.values : std::vector<double>{});
    }
  }
}

TEST(Field, OfCellsIsScatteredWithItsMeshAndGathered) {
  const Mesh whole = test::Grid{7}.mesh();
  for (const MeshOrder& order :
       {own_order(whole), space_filling_order(whole), test::shuffled_order(whole, 3)}) {
    const Mesh part = scatter_mesh(world(), whole, order);
    Field of_whole{{}, {}, {}, {{"a", "b"}, {}}};
    const std::size_t cells = whole.triangles.size() + whole.quads.size();
    for (std::size_t i = 0; i < 2 * cells; ++i) of_whole.cells.values.push_back(static_cast<double>(i));
    const Field field = scatter_field(world(), world().is_root() ? of_whole : Field{}, part, order);
    EXPECT_EQ(field.cells.names, of_whole.cells.names);
    ASSERT_EQ(field.cells.values.size(), 2 * (part.triangles.size() + part.quads.size()));
    if (!part.triangles.empty()) {
      EXPECT_LT(field.cells.values[0] / 2, static_cast<double>(whole.triangles.size()));
    }
    const Field back = gather_field(world(), field, part, order);
    EXPECT_EQ(back.cells.values, world().is_root() ? of_whole.cells.values : std::vector<double>{});
  }
}

TEST(Field, SelectsVariablesOfCellsWhereNodesHaveNone) {
  const Field field{{"rho"}, {1, 2}, {}, {{"rho", "p", "T"}, {3, 4, 5, 6, 7, 8}}};
  const std::vector<std::string> wanted{"pressure", "density"};
  const Field chosen = selected(field, wanted, "here");
  EXPECT_EQ(chosen.names, (std::vector<std::string>{"rho"}));
  EXPECT_EQ(chosen.values, (std::vector<double>{1, 2}));
  EXPECT_EQ(chosen.cells.names, (std::vector<std::string>{"p"}));
  EXPECT_EQ(chosen.cells.values, (std::vector<double>{4, 7}));
  const std::vector<std::string> unknown{"mach"};
  EXPECT_THROW(selected(field, unknown, "here"), InputError);
}

TEST(Field, WithoutVariablesThereIsNothingToScatter) {
  const Mesh whole = test::Grid{3}.mesh();
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  const Field field = scatter_field(world(), {}, part, own_order(whole));
  EXPECT_TRUE(field.names.empty());
  EXPECT_TRUE(field.values.empty());
  EXPECT_TRUE(with_ghosts(world(), part, field).values.empty());
}

}  // namespace
}  // namespace quadloop
