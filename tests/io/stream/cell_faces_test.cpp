// Each face once, with the cells on its two sides: those that an extruded mesh streams on several ranks are
// those that are found in the same mesh, held; also where a file numbers cells by block. Which plane meshes
// are taken.
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <tuple>

#include "io/mesh_file.hpp"
#include "io/stream/held_faces.hpp"
#include "io/stream/stream_faces.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/io/write_alone.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::world;

/// Owner, neighbour, and the nodes in ascending order.
using Face = std::tuple<std::int64_t, std::int64_t, std::vector<std::int64_t>>;

/// Of this rank's part of the sample, in three layers.
ExtrudedMesh extruded_sample(const Mesh& part) { return extruded(part, {0, 0.5, 1, 3}, ExtrusionAxis::z); }

std::vector<Face> written(const StreamFaces& faces, const std::string& path) {
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

/// The cells at all faces of patches, on rank 0.
std::vector<std::int64_t> owners_at_patches(const StreamFaces& faces, const std::string& path) {
  OutputSet outputs(world());
  TextOutput file(outputs, path);
  faces.write_patches(
      file, 1, [](std::size_t) { return std::string(); },
      [](TextRows& text, std::size_t, const auto&, std::int64_t owner, std::int64_t) {
        text.put(owner, '\n');
      });
  file.close();
  outputs.commit();
  std::ifstream text(path);
  return {std::istream_iterator<std::int64_t>(text), {}};
}

/// The inner faces of the whole mesh, held.
std::vector<Face> held(const std::string& path) {
  const Mesh whole = test::sample_mesh(3);
  const Communicator alone(MPI_COMM_SELF);
  OutputSet outputs(alone);
  write_mesh(outputs, extruded_sample(whole), path);
  outputs.commit();
  const std::optional<FileMesh> mesh = test::read_mesh3d(path);
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

/// Blocks of this rank's cells: quads are in the first, triangles in the second.
PlaneBlocks quads_before_triangles(const Mesh& part) {
  return {{"quads", "triangles"},
          std::vector<std::int32_t>(part.triangles.size(), 1),
          std::vector<std::int32_t>(part.quads.size(), 0)};
}

TEST(CellFaces, OfAnExtrudedMeshAreThoseOfTheHeldOne) {
  const test::TemporaryFolder folder;
  const Mesh whole = test::sample_mesh(3);
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  const ExtrudedMesh mesh = extruded_sample(part);
  const MeshStream stream(world(), mesh);
  const StreamFaces faces(stream, StreamFaces::CellNumbers::by_block, "m");
  const std::vector<Face> found = written(faces, folder.file("faces"));
  if (!world().is_root()) return;
  const std::vector<Face> wanted = held(folder.file("a.vtu"));
  EXPECT_TRUE(std::ranges::is_sorted(wanted));
  EXPECT_EQ(std::ssize(wanted), faces.internal());
  EXPECT_EQ(found, wanted);
}

TEST(CellFaces, HaveTheNumbersOfAFileThatNumbersCellsByBlock) {
  const test::TemporaryFolder folder;
  const Mesh whole = test::sample_mesh(3);
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  const PlaneBlocks blocks = quads_before_triangles(part);
  ExtrudedMesh mesh = extruded_sample(part);
  mesh.blocks = &blocks;
  const MeshStream stream(world(), mesh);
  const StreamFaces faces(stream, StreamFaces::CellNumbers::by_block, "m");
  const std::vector<Face> found = written(faces, folder.file("faces"));
  const std::vector<std::int64_t> beside = owners_at_patches(faces, folder.file("owners"));
  if (!world().is_root()) return;
  std::vector<Face> wanted = held(folder.file("a.vtu"));
  // On three layers six triangles, which the stream numbers 0 to 17, and three quads, 18 to 26.
  const auto by_block = [](std::int64_t cell) { return cell < 18 ? cell + 9 : cell - 18; };
  for (auto& [owner, neighbour, nodes] : wanted) {
    owner = by_block(owner);
    neighbour = by_block(neighbour);
  }
  EXPECT_EQ(found, wanted);
  ASSERT_EQ(std::ssize(beside), faces.all() - faces.internal());
  for (const std::int64_t cell : beside) EXPECT_TRUE(cell >= 0 && cell < 27);
  EXPECT_EQ(beside.front(), 0);  // below lie the quads
}

bool is_taken(const Mesh& mesh, bool has_blocks = false) {
  const Communicator alone(MPI_COMM_SELF);
  const MeshStream stream(alone, mesh, nullptr,
                          has_blocks ? std::optional(quads_before_triangles(mesh)) : std::nullopt);
  try {
    const StreamFaces faces(stream, StreamFaces::CellNumbers::as_streamed, "m");
    return true;
  } catch (const OutputError&) {
    return false;
  }
}

TEST(CellFaces, AreRefusedUnlessEachEdgeHasItsCellsOrBoundary) {
  const Mesh mesh = test::sample_mesh(3);
  EXPECT_TRUE(is_taken(mesh));
  Mesh open = mesh, stray = mesh, between = mesh;
  open.boundaries[0].edges.pop_back();
  EXPECT_FALSE(is_taken(open));
  std::swap(stray.boundaries[0].edges[0][0], stray.boundaries[0].edges[0][1]);
  EXPECT_FALSE(is_taken(stray));
  between.boundaries.push_back({"between", "interface", {{mesh.quads[0][2], mesh.quads[0][3]}}});
  EXPECT_FALSE(is_taken(between));
  EXPECT_TRUE(is_taken(between, true));
}

}  // namespace
}  // namespace quadloop::io
