// Names in `.vtkhdf` files; what is in them is compared with `.vtu` files in tests/app/vtkhdf_test.py.
#include "io/vtu/vtkhdf_file.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <string>
#include <vector>

#include "io/formats.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop::io {
namespace {

using Names = std::vector<std::string>;

TEST(VtkHdfFile, NamesOfVariablesAreLinksOfTheirOwn) {
  EXPECT_EQ(vtkhdf_variable_names({"density", "d/dx", "d_dx", ".", "boundary", "block", "boundary"}),
            (Names{"density", "d_dx", "d_dx_2", "._2", "boundary_2", "block_2", "boundary_3"}));
  EXPECT_EQ(vtkhdf_variable_names({}), Names{});
}

/// Times would differ, and so would numbers of open objects in the file.
TEST(VtkHdfFile, ASecondFileHasTheSameBytes) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::sample_mesh(5);
  const Field solution = test::sample_solution(mesh);
  const Communicator alone(MPI_COMM_SELF);
  for (const char* name : {"a.vtkhdf", "b.vtkhdf"}) {
    OutputSet outputs(alone);
    write_vtkhdf(outputs, MeshStream(alone, mesh, &solution), folder.file(name));
    outputs.commit();
  }
  const std::string bytes = test::bytes_of(folder.file("a.vtkhdf"));
  EXPECT_EQ(bytes.substr(0, 4), "\x89HDF");
  EXPECT_TRUE(bytes == test::bytes_of(folder.file("b.vtkhdf")));
}

}  // namespace
}  // namespace quadloop::io
