// Each face once, with the cells on its two sides: those that an extruded mesh streams on several ranks are
// those that are found in the same mesh, held; also where a file numbers cells in another way.
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <tuple>

#include "io/mesh_file.hpp"
#include "io/stream/extruded_faces.hpp"
#include "io/stream/held_faces.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// Owner, neighbour, and the nodes in ascending order.
using Face = std::tuple<std::int64_t, std::int64_t, std::vector<std::int64_t>>;

/// Of this rank's part of the sample, in three layers.
ExtrudedMesh extruded_sample(const Mesh& part) { return extruded(part, {0, 0.5, 1, 3}, ExtrusionAxis::z); }

std::vector<Face> written(const ExtrudedFaces& faces, const std::string& path) {
  OutputSet outputs(world());
  TextOutput file(outputs, path);
  faces.write_internal(file, 6,
                       [](TextRows& text, const auto& nodes, std::int64_t owner, std::int64_t neighbour) {
                         text.put(owner, ' ');
                         text.put(neighbour, ' ');
                         for (std::size_t k = 0; k < nodes.size(); ++k)
                           text.put(nodes[k], k + 1 < nodes.size() ? ' ' : '\n');
                       });
  file.close();
  outputs.commit();
  std::vector<Face> found;
  std::ifstream text(path);
  for (std::string line; std::getline(text, line);) {
    std::istringstream row(line);
    auto& [owner, neighbour, nodes] = found.emplace_back();
    row >> owner >> neighbour;
    for (std::int64_t node = 0; row >> node;) nodes.push_back(node);
    std::ranges::sort(nodes);
  }
  return found;
}

/// The inner faces of the whole mesh, held.
std::vector<Face> held(const std::string& path) {
  const Mesh whole = test::sample_mesh(3);
  const Communicator alone(MPI_COMM_SELF);
  OutputSet outputs(alone);
  write_mesh(outputs, extruded_sample(whole), path);
  outputs.commit();
  const std::optional<FileMesh> mesh = test::read_solid(path);
  const HeldFaces faces(*mesh, path);
  std::vector<Face> found;
  for (const HeldFaces::Inner& face : faces.internal()) {
    auto& [owner, neighbour, nodes] =
        found.emplace_back(face.owner, face.neighbour, std::vector<std::int64_t>{});
    for (const std::int32_t node : faces.nodes(face)) {
      if (node != FileBoundary::no_node) nodes.push_back(node);
    }
    std::ranges::sort(nodes);
  }
  return found;
}

TEST(CellFaces, OfAnExtrudedMeshAreThoseOfTheHeldOne) {
  const test::TemporaryFolder folder;
  const Mesh whole = test::sample_mesh(3);
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  const ExtrudedMesh mesh = extruded_sample(part);
  const ExtrudedFaces faces(world(), mesh);
  const std::vector<Face> found = written(faces, folder.file("faces"));
  if (!world().is_root()) return;
  const std::vector<Face> wanted = held(folder.file("a.vtu"));
  EXPECT_TRUE(std::ranges::is_sorted(wanted));
  EXPECT_EQ(std::ssize(wanted), faces.internal());
  EXPECT_EQ(found, wanted);
}

TEST(CellFaces, HaveTheNumbersOfAFileThatNumbersCellsInAnotherWay) {
  const test::TemporaryFolder folder;
  const Mesh whole = test::sample_mesh(3);
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  const ExtrudedMesh mesh = extruded_sample(part);
  constexpr std::int64_t last = 8;  // six triangles, three quads
  const CellOwners owners(world(), part);
  std::vector<std::int64_t> numbers;
  for (std::int64_t cell = 0; cell < std::ssize(part.triangles) + std::ssize(part.quads); ++cell)
    numbers.push_back(last - owners.number(cell));
  const ExtrudedFaces faces(world(), mesh, numbers);
  const std::vector<Face> found = written(faces, folder.file("faces"));
  std::vector<std::int64_t> beside;
  faces.sides_with_owners().run([](std::size_t) {},
                                [&](std::span<const BoundaryStream::Edge> edges) {
                                  for (const BoundaryStream::Edge& edge : edges) beside.push_back(edge[1]);
                                });
  if (!world().is_root()) return;
  std::vector<Face> wanted = held(folder.file("a.vtu"));
  const auto turned = [](std::int64_t cell) { return 3 * (last - cell / 3) + cell % 3; };
  for (auto& [owner, neighbour, nodes] : wanted) {
    owner = turned(owner);
    neighbour = turned(neighbour);
  }
  EXPECT_EQ(found, wanted);
  ASSERT_FALSE(beside.empty());
  for (const std::int64_t cell : beside) EXPECT_TRUE(cell >= 0 && cell <= last);
  EXPECT_EQ(beside.front(), 2);  // below lie the quads, in another way 2, 1 and 0
}

}  // namespace
}  // namespace quadloop
