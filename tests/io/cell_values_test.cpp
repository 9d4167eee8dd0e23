// Values of cells go through every format that has a place for them: the same bytes on any number of ranks,
// and the same values back.
#include <gtest/gtest.h>

#include "io/formats.hpp"
#include "io/mesh_file.hpp"
#include "io/solution_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;
using test::world;

/// Two variables for each cell, beside those at the nodes or alone.
Field cell_solution(const Mesh& mesh, bool with_nodal) {
  Field solution = with_nodal ? test::sample_solution(mesh) : Field{};
  solution.constants.clear();
  solution.cells.names = {"pressure", "x_velocity"};
  const std::size_t cells = mesh.triangles.size() + mesh.quads.size();
  for (std::size_t cell = 0; cell < cells; ++cell) {
    solution.cells.values.push_back(1 + static_cast<double>(cell) / 3);
    solution.cells.values.push_back(-1e7 / (static_cast<double>(cell) + 7));
  }
  return solution;
}

void write_all(const Communicator& comm, const Mesh& mesh, const Field& solution, const std::string& path) {
  OutputSet outputs(comm);
  write_mesh(outputs, mesh, path, &solution);
  outputs.commit();
}

class CellValuesIn : public testing::TestWithParam<std::string> {};

TEST_P(CellValuesIn, ComeBackFromAnyNumberOfRanks) {
  const Mesh whole = test::sample_mesh(300);
  const MeshOrder order = own_order(whole);
  const Mesh part = scatter_mesh(world(), whole, order);
  for (const bool with_nodal : {true, false}) {
    const TemporaryFolder folder;
    const Field solution = cell_solution(whole, with_nodal);
    const std::string many = folder.file("many." + GetParam()), one = folder.file("one." + GetParam());
    write_all(world(), part, scatter_field(world(), solution, part, order), many);
    if (!world().is_root()) continue;
    write_all(Communicator(MPI_COMM_SELF), whole, solution, one);
    if (GetParam() != "cgns") {
      EXPECT_TRUE(test::bytes_of(many) == test::bytes_of(one));
    }
    const LoadedSolution loaded = read_solution(many);
    EXPECT_EQ(loaded.solution.names, solution.names);
    EXPECT_EQ(loaded.solution.values, solution.values);
    EXPECT_EQ(loaded.solution.cells.names, solution.cells.names);
    EXPECT_EQ(loaded.solution.cells.values, solution.cells.values);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, CellValuesIn, testing::Values("mesh", "qmesh", "vtu", "cgns"));

TEST(CellValues, StayWithTheirCellsWhereBlocksAreSorted) {
  const TemporaryFolder folder;
  if (!world().is_root()) return;
  LoadedMesh loaded{test::sample_mesh(2), 2, {0, 0, 1, 1}, {0, 1}, {"left", "right"}, {}, {}};
  loaded.solution = cell_solution(loaded.mesh, false);
  const Communicator alone(MPI_COMM_SELF);
  for (const std::string suffix : {"vtu", "mesh"}) {
    OutputSet outputs(alone);
    write_mesh(outputs, loaded, folder.file("blocks." + suffix));
    outputs.commit();
    const LoadedMesh back = read_mesh(folder.file("blocks." + suffix));
    EXPECT_EQ(back.triangle_to_block, loaded.triangle_to_block);
    ASSERT_TRUE(back.solution);
    EXPECT_EQ(back.solution->cells.values, loaded.solution->cells.values);
  }
}

TEST(CellValues, GoWithCellsThatAReaderSorts) {
  const TemporaryFolder folder;
  if (!world().is_root()) return;
  LoadedMesh loaded{test::sample_mesh(2), 2, {1, 0, 1, 0}, {1, 0}, {"left", "right"}, {}, {}};
  loaded.solution = Field{{}, {}, {}, {{"q"}, {0, 1, 2, 3, 4, 5}}};
  const Communicator alone(MPI_COMM_SELF);
  OutputSet mixed(alone);
  write_mesh(mixed, loaded, folder.file("mixed.vtu"));
  mixed.commit();
  const LoadedMesh back = read_mesh(folder.file("mixed.vtu"));
  EXPECT_EQ(back.triangle_to_block, (std::vector<std::int32_t>{0, 0, 1, 1}));
  ASSERT_TRUE(back.solution);
  EXPECT_EQ(back.solution->cells.values, (std::vector<double>{1, 3, 0, 2, 5, 4}));
}

TEST(CellValues, ThatAreNotFiniteAreRefusedWithTheirCell) {
  const TemporaryFolder folder;
  if (!world().is_root()) return;
  const Mesh mesh = test::sample_mesh(2);
  Field solution = cell_solution(mesh, false);
  solution.cells.values[5] = 1e200;
  write_all(Communicator(MPI_COMM_SELF), mesh, solution, folder.file("large.mesh"));
  try {
    read_solution(folder.file("large.mesh"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("x_velocity is beyond 1e+150 at cell 3"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace quadloop::io
