// The binary format: what its file is to the byte, and what is refused. It works on one rank alone.
#include "io/native/binary_file.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <bit>
#include <cstring>
#include <functional>
#include <limits>

#include "io/mesh_file.hpp"
#include "io/native/binary_header.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;

/// A triangle and a quadrilateral in a block each, with a solution.
LoadedMesh two_blocks() {
  LoadedMesh whole;
  Mesh& mesh = whole.mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0.5}};
  mesh.owned_nodes = 5;
  const auto node = [](std::int32_t n) { return NodeId{n}; };
  mesh.triangles = {{node(1), node(4), node(2)}};
  mesh.quads = {{node(0), node(1), node(2), node(3)}};
  mesh.boundaries = {{"bow wave", "viscous_wall", {{node(0), node(1)}, {node(1), node(4)}}, {30, 0.0118}},
                     {"out", "none", {{node(4), node(2)}, {node(2), node(3)}, {node(3), node(0)}}}};
  whole.blocks = 2;
  whole.triangle_to_block = {1};
  whole.quad_to_block = {0};
  whole.block_names = {"gas", "membrane"};
  whole.solution.emplace();
  whole.solution->constants = {7, 0.5};
  whole.solution->names = {"density"};
  whole.solution->values = {1, 2, 3, 4, 5};
  whole.solution->cells = {{"depth"}, {6, 7}};
  return whole;
}

const std::string head =
    "quadloop binary mesh 1\nheader          224\nnodes 5\nnode_bytes 4\nblock 0 1 gas\nblock 1 0 membrane\n"
    "boundary 2 viscous_wall bow wave\nlayers 30 0.0118\nboundary 3 none out\nconstants 2\n"
    "variable density\ncell_variable depth\nend";

class BinaryFile : public testing::Test {
 protected:
  std::string written(const LoadedMesh& whole) const {
    const Communicator alone(MPI_COMM_SELF);
    OutputSet outputs(alone);
    write_mesh(outputs, whole, folder_.file("m.qmesh"));
    outputs.commit();
    return test::bytes_of(folder_.file("m.qmesh"));
  }
  LoadedMesh read(const std::string& bytes) const {
    test::write_bytes(folder_.file("m.qmesh"), bytes);
    return read_binary(Communicator(MPI_COMM_SELF), folder_.file("m.qmesh"));
  }
  /// Without the folder; empty where the bytes are accepted.
  std::string refusal(const std::string& bytes) const {
    try {
      read(bytes);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(folder_.path().size() + 1);
    }
    return {};
  }
  void expect_refusal(const std::string& bytes, const std::string& begins, const std::string& says) const {
    const std::string found = refusal(bytes);
    EXPECT_EQ(found.substr(0, begins.size()), begins) << found;
    EXPECT_NE(found.find(says), std::string::npos) << found;
  }

  TemporaryFolder folder_;
};

/// The same length of head, by blanks behind `end`.
std::string with_line(std::string bytes, const std::string& what, const std::string& with) {
  const std::size_t at = bytes.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  bytes.replace(at, what.size(), with);
  const std::size_t end = bytes.find("\nend") + 4;
  if (with.size() <= what.size()) {
    bytes.insert(end, what.size() - with.size(), ' ');
  } else {
    bytes.erase(end, with.size() - what.size());
  }
  return bytes;
}

template <class Number>
std::string with_number(std::string bytes, std::size_t offset, Number number) {
  std::memcpy(bytes.data() + offset, &number, sizeof number);
  return bytes;
}

TEST_F(BinaryFile, IsWhatTheDocumentSays) {
  const std::string bytes = written(two_blocks());
  ASSERT_EQ(bytes.substr(0, head.size()), head);
  const std::size_t start = 224;
  EXPECT_EQ(bytes.substr(head.size(), start - head.size()), std::string(start - 1 - head.size(), ' ') + "\n");
  ASSERT_EQ(bytes.size(), start + 8 * (10 + 2 + 5 + 2) + 4 * (3 + 4 + 10));
  if constexpr (std::endian::native == std::endian::little) {
    std::array<double, 2> last_node{};
    std::array<std::int32_t, 9> cells_and_edge{};
    std::array<double, 9> solution{};
    std::memcpy(last_node.data(), bytes.data() + start + 64, 16);
    std::memcpy(cells_and_edge.data(), bytes.data() + start + 80, 36);
    std::memcpy(solution.data(), bytes.data() + bytes.size() - 72, 72);
    EXPECT_EQ(last_node, (std::array<double, 2>{2, 0.5}));
    EXPECT_EQ(cells_and_edge, (std::array<std::int32_t, 9>{1, 4, 2, 0, 1, 2, 3, 0, 1}));
    EXPECT_EQ(solution, (std::array<double, 9>{7, 0.5, 1, 2, 3, 4, 5, 6, 7}));
  }
}

TEST_F(BinaryFile, KeepsAll) {
  const LoadedMesh whole = two_blocks(), back = read(written(whole));
  EXPECT_EQ(back.mesh.points, whole.mesh.points);
  EXPECT_EQ(back.mesh.triangles, whole.mesh.triangles);
  EXPECT_EQ(back.mesh.quads, whole.mesh.quads);
  ASSERT_EQ(back.mesh.boundaries.size(), 2U);
  for (const std::size_t b : {0U, 1U}) {
    EXPECT_EQ(back.mesh.boundaries[b].name, whole.mesh.boundaries[b].name);
    EXPECT_EQ(back.mesh.boundaries[b].condition, whole.mesh.boundaries[b].condition);
    EXPECT_EQ(back.mesh.boundaries[b].edges, whole.mesh.boundaries[b].edges);
    EXPECT_EQ(back.mesh.boundaries[b].layers, whole.mesh.boundaries[b].layers);
  }
  EXPECT_EQ(back.blocks, 2);
  EXPECT_EQ(back.block_names, whole.block_names);
  EXPECT_EQ(back.triangle_to_block, whole.triangle_to_block);
  EXPECT_EQ(back.quad_to_block, whole.quad_to_block);
  ASSERT_TRUE(back.solution);
  EXPECT_EQ(back.solution->constants, whole.solution->constants);
  EXPECT_EQ(back.solution->names, whole.solution->names);
  EXPECT_EQ(back.solution->values, whole.solution->values);
  EXPECT_EQ(back.solution->cells.names, whole.solution->cells.names);
  EXPECT_EQ(back.solution->cells.values, whole.solution->cells.values);
}

TEST_F(BinaryFile, NamesStayInTheirLines) {
  LoadedMesh whole = two_blocks();
  whole.mesh.boundaries[1].name = "out\nend";
  EXPECT_EQ(read(written(whole)).mesh.boundaries[1].name, "out_end");
}

TEST_F(BinaryFile, BoundariesOfOneNameBecomeOne) {
  const std::string bytes = with_line(written(two_blocks()), "none out", "none bow wave");
  const LoadedMesh back = read(bytes);
  ASSERT_EQ(back.mesh.boundaries.size(), 1U);
  EXPECT_EQ(back.mesh.boundaries[0].edges.size(), 5U);
}

TEST_F(BinaryFile, RefusesWhatIsNoSuchFile) {
  const std::string bytes = written(two_blocks());
  expect_refusal("", "m.qmesh: does not begin", "another kind of file");
  expect_refusal("#Number of grid points\n", "m.qmesh: does not begin", "");
  expect_refusal(with_line(bytes, "mesh 1\n", "mesh 2\n"), "m.qmesh: does not begin", "");
  expect_refusal(with_line(bytes, "224\n", "949\n"), "m.qmesh:2: ", "damaged");
  expect_refusal(with_line(bytes, "224\n", "-24\n"), "m.qmesh:2: ", "damaged");
  expect_refusal(with_line(bytes, "224\n", "216\n"), "m.qmesh:12: ", "ends before its line 'end'");
  EXPECT_THROW(read_binary(Communicator(MPI_COMM_SELF), folder_.path()), InputError);
  EXPECT_THROW(read_binary(Communicator(MPI_COMM_SELF), folder_.file("missing.qmesh")), InputError);
}

TEST_F(BinaryFile, RefusesHeadsByLine) {
  const std::string bytes = written(two_blocks());
  expect_refusal(with_line(bytes, "nodes 5\n", "nodes 6\n"), "m.qmesh: ", "bytes follow its head");
  expect_refusal(with_line(bytes, "nodes 5\n", "nodes -5\n"), "m.qmesh:3: ", "'-5' is not a number of nodes");
  expect_refusal(with_line(bytes, "nodes 5\n", "nodes 9000000000000000000\n"), "m.qmesh:3: ", "cut short");
  expect_refusal(with_line(bytes, "nodes 5\n", "modes 5\n"), "m.qmesh:3: ", "nodes N");
  expect_refusal(with_line(bytes, "node_bytes 4", "node_bytes 5"), "m.qmesh:4: ", "4 or 8");
  expect_refusal(with_line(bytes, "node_bytes 4", "node_bytes 8"), "m.qmesh: ", "bytes follow its head");
  expect_refusal(with_line(bytes, "block 0 1 gas", "blocks 0 1"),
                 "m.qmesh:5: ", "'blocks 0 1' is not a line");
  expect_refusal(with_line(bytes, "viscous_wall", "sticky_wall"), "m.qmesh:7: ", "'sticky_wall'");
  expect_refusal(with_line(bytes, "none out", "none "), "m.qmesh:9: ", "a boundary has a name");
  expect_refusal(with_line(bytes, "\nend ", "\nend x"), "m.qmesh:13: ", "follows 'end'");
  expect_refusal(with_line(bytes, "\nend", "\n# e"), "m.qmesh:1", "ends before its line 'end'");
}

TEST_F(BinaryFile, RefusesNumbers) {
  const std::string bytes = written(two_blocks());
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t start = 224, cells = start + 80, constants = cells + 4 * 17;
  expect_refusal(with_number(bytes, start + 16, none), "m.qmesh: node 1 lies at (nan, 0)", "not finite");
  expect_refusal(with_number(bytes, cells, std::int32_t{5}), "m.qmesh: triangle 0 has node 5", "0 to 4");
  expect_refusal(with_number(bytes, cells + 12, std::int32_t{-1}), "m.qmesh: quad 0 has node -1", "");
  expect_refusal(with_number(bytes, cells + 28, std::int32_t{9}), "m.qmesh: boundary edge 0 has node 9", "");
  expect_refusal(with_number(bytes, constants + 8, none), "m.qmesh: constant 1 is not finite", "");
  expect_refusal(with_number(bytes, constants + 24, none), "m.qmesh: density is not finite at node 1", "");
  expect_refusal(with_number(bytes, constants + 64, none), "m.qmesh: depth is not finite at cell 1", "");
}

TEST_F(BinaryFile, RefusesAnyOtherLength) {
  const std::string bytes = written(two_blocks());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string found = refusal(bytes.substr(0, size));
    EXPECT_EQ(found.substr(0, 7), "m.qmesh") << size;
  }
  expect_refusal(bytes + '\0', "m.qmesh: ", "bytes follow its head, which tells of");
}

TEST(BinaryHeader, ManyNodesTakeMoreBytes) {
  EXPECT_EQ(node_bytes_for(2147483647), 4);
  EXPECT_EQ(node_bytes_for(2147483648), 8);
}

}  // namespace
}  // namespace quadloop::io
