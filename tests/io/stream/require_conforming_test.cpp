// Which plane meshes a format of faces takes.
#include "io/stream/require_conforming.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop {
namespace {

bool is_taken(const Mesh& mesh, std::int64_t between = 0) {
  const Communicator alone(MPI_COMM_SELF);
  try {
    require_conforming(alone, mesh, edge_cells(alone, mesh), between, "m");
    return true;
  } catch (const OutputError&) {
    return false;
  }
}

TEST(RequireConforming, TakesEachEdgeOnce) {
  const Mesh mesh = test::sample_mesh(3);
  EXPECT_TRUE(is_taken(mesh));
  Mesh open = mesh, stray = mesh, between = mesh;
  open.boundaries[0].edges.pop_back();
  EXPECT_FALSE(is_taken(open));
  std::swap(stray.boundaries[0].edges[0][0], stray.boundaries[0].edges[0][1]);
  EXPECT_FALSE(is_taken(stray));
  between.boundaries.push_back({"between", "interface", {{mesh.quads[0][2], mesh.quads[0][3]}}});
  EXPECT_FALSE(is_taken(between));
  EXPECT_TRUE(is_taken(between, 1));
}

}  // namespace
}  // namespace quadloop
