// The patches of an extruded mesh and how many faces they have.
#include <gtest/gtest.h>

#include "io/stream/mesh_stream.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

TEST(MeshStream, ListsBoundariesThenTheEnds) {
  const Communicator& comm = test::world();
  const Mesh part = test::share_of(test::sample_mesh(5), comm.rank(), comm.size());
  const ExtrudedMesh mesh = extruded(part, {0, 1, 2}, ExtrusionAxis::z);
  const MeshStream stream(comm, mesh);
  EXPECT_EQ(stream.patch_names(), (std::vector<std::string>{"wall", "far field", "back", "front"}));
  EXPECT_EQ(stream.side_patches(), 2);
  EXPECT_EQ(stream.patches()[0].quads, 20);
  EXPECT_EQ(stream.patches()[2].triangles, 10);
  EXPECT_EQ(stream.patch_quads(), 20 + 8 + 2 * 5);
  EXPECT_EQ(stream.counts().of(CellKind::prism), 20);
  EXPECT_EQ(stream.counts().of(CellKind::hexahedron), 10);
}

}  // namespace
}  // namespace quadloop::io
