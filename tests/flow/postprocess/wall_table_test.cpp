// Values along walls: every row is where it belongs, on any number of ranks.
#include "flow/postprocess/wall_table.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::world;

FreeStream stream_of_speed_2() { return {1, 1, 2, 0, 1.5, 0, 1}; }

/// Pressure coefficient x + 10 y; Mach number 2 where the density is 1.5 and the pressure 1.
Field flow_on(const Mesh& mesh) {
  Field flow{{"density", "x_velocity", "y_velocity", "pressure", "wall_shear"}, {}, {}};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const Point at = mesh.points[i];
    const double pressure = 1 + 2 * (at.x + 10 * at.y);
    flow.values.insert(flow.values.end(), {1.5 * pressure, 2, 0, pressure, 0.5});
  }
  return flow;
}

std::string table_of(const Mesh& whole, const MeshOrder& order, const FreeStream& relative_to,
                     const std::vector<std::string>& walls) {
  const Mesh mesh = scatter_mesh(world(), whole, order);
  return wall_table(world(), mesh, flow_on(mesh), relative_to, walls);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(WallTable, HasTheFlowAtEachNodeInTheOrderOfTheWalk) {
  const Mesh whole = test::Grid{2}.mesh();
  const std::string table = table_of(whole, own_order(whole), stream_of_speed_2(), {"wall"});
  if (!world().is_root()) {
    EXPECT_TRUE(table.empty());
    return;
  }
  EXPECT_EQ(table,
            "boundary,s,x,y,Cp,Mach\n"
            "wall,0,0,0,0,2\n"
            "wall,0.5,0.5,0,0.5,2\n"
            "wall,1,1,0,1,2\n"
            "wall,1.5,1,0.5,6,2\n"
            "wall,2,1,1,11,2\n");
}

TEST(WallTable, OfAViscousFlowHasFrictionAndTheFirstHeight) {
  const Mesh whole = test::Grid{4, {1, 2}}.mesh();
  FreeStream viscous = stream_of_speed_2();
  viscous.viscosity = 0.01;
  const std::vector<std::string> lines = lines_of(table_of(whole, own_order(whole), viscous, {"wall"}));
  if (!world().is_root()) return;
  EXPECT_EQ(lines.at(0), "boundary,s,x,y,Cp,Mach,Cf,y+");
  std::istringstream row(lines.at(2));  // the first inner node of the south side
  std::vector<std::string> words;
  for (std::string word; std::getline(row, word, ',');) words.push_back(word);
  ASSERT_EQ(words.size(), 8U);
  EXPECT_EQ(std::stod(words[6]), 0.25);
  const double density = 1.5 * (1 + 2 * 0.25);
  EXPECT_NEAR(std::stod(words[7]), 0.5 * std::sqrt(density * 0.5) / 0.01, 1e-9);
}

TEST(WallTable, IsTheSameHoweverTheMeshIsSpread) {
  const test::Grid grid{9};
  Mesh whole = grid.mesh();
  test::jitter(grid, 0.2, 3, whole);
  FreeStream viscous = stream_of_speed_2();
  viscous.viscosity = 0.01;
  EXPECT_EQ(table_of(whole, space_filling_order(whole), viscous, {"far", "wall"}),
            table_of(whole, test::shuffled_order(whole, 8), viscous, {"far", "wall"}));
}

TEST(WallTable, QuotesNamesThatWouldDivideARow) {
  Mesh whole = test::Grid{1}.mesh();
  whole.boundaries[0].name = "a,\"b\"";
  const std::string table =
      table_of(whole, own_order(whole), stream_of_speed_2(), {whole.boundaries[0].name});
  EXPECT_EQ(table.find("\"a,\"\"b\"\"\",0,") != std::string::npos, world().is_root()) << table;
}

TEST(WallTable, OfNoWallIsItsHead) {
  const Mesh whole = test::Grid{2}.mesh();
  const std::string table = table_of(whole, own_order(whole), stream_of_speed_2(), {});
  EXPECT_EQ(table, world().is_root() ? "boundary,s,x,y,Cp,Mach\n" : "");
}

}  // namespace
}  // namespace quadloop::flow
