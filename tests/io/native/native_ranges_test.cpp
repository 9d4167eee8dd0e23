// A native file that all ranks read, each some of its lines, gives the mesh that one rank reads, or the same
// message: however its lines are divided, and whatever is wrong.
#include <gtest/gtest.h>
#include <mpi.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "io/model/distribute.hpp"
#include "io/native/binary_file.hpp"
#include "io/native/native_file.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/same_mesh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::expect_same;
using test::TemporaryFolder;
using test::world;

/// Two blocks of the squares [0, 1] and [1, 2], with all that a file may have.
const std::string two_blocks =
    "#Number of grid points\n8\n0 0\n1 0\n1 1\n0 1\n2 0 2 1\n3\n0\n 3 1\n"
    "#Number of blocks\n2\n# block the gas\n#Number of triangular elements\n2\n1 2 3\n1 3 4\n"
    "#Number of quadrilateral elements\n0\n# block solid\n#T\n2 2 5 6 2 6 3\n#Q\n1\n5 7 8 6\n"
    "#Number of boundaries\n4\n# layers wall 2 0.25\n#Number of edges for boundary 1 (wall)\n3\n1 2\n2 5\n5 "
    "7\n"
    "#edges (far)\n3 7 8 8 6 6 3\n#edges (side)\n1\n3 4\n#edges (wall)\n1\n4 1\n"
    "# strip wake 1 0.5 3 2 line\n# nodes 1-3 4-6\n# pair far side translation 1 0\n# inner line cut 2\n# 1 "
    "3\n# 2 6\n"
    "# node 4 corner\n"
    "#Number of constants\n2\n0.5 7\n#Number of variables\n2\n#names: a b\n"
    "1 2\n3 4 5 6\n7 8 9 10 11 12\n13 14\n15 16\n#Number of cell variables\n1\n#names: rank\n1 2\n3 4 5\n# "
    "end";

/// Reads with all ranks and with one; compares what they get.
void expect_as_one_rank(const std::string& text, std::size_t piece, bool readable) {
  const TemporaryFolder folder;
  const std::string path = folder.write("m.mesh", text);
  const Communicator alone(MPI_COMM_SELF);
  LoadedMesh part, wanted;
  const std::string refusal = test::refusal_text([&] { part = read_native(world(), path, piece); }),
                    of_one = test::refusal_text([&] { wanted = read_native(alone, path); });
  EXPECT_EQ(refusal, of_one) << text;
  EXPECT_TRUE(refusal.empty() || !readable) << refusal;
  if (!refusal.empty() || !of_one.empty()) return;
  const LoadedMesh whole = gathered(world(), part);
  if (world().is_root()) expect_same(whole, wanted);
}

TEST(NativeRanges, GiveTheMeshThatOneRankReads) {
  for (const std::size_t piece : {1, 30, 1000000}) expect_as_one_rank(two_blocks, piece, true);
  const TemporaryFolder folder;
  const LoadedMesh part = read_native(world(), folder.write("m.mesh", two_blocks));
  EXPECT_EQ(part.mesh.owned_nodes,
            8 * (world().rank() + 1) / world().size() - 8 * world().rank() / world().size());
  EXPECT_EQ(part.mesh.named_nodes.at(0).node, GlobalNodeId{3});
  EXPECT_EQ(part.inner_curves.at(0).name, "cut");
  EXPECT_EQ(part.block_names, (std::vector<std::string>{"the gas", "solid"}));
  EXPECT_EQ(part.mesh.boundaries.at(0).layers.count, 2);
  EXPECT_EQ(world().sum(std::ssize(part.mesh.boundaries.at(0).edges)), 4) << "of two lists";
}

TEST(NativeRanges, NameTheFirstErrorOfTheFile) {
  std::string text = two_blocks;
  const std::size_t coordinate = text.find("0 1\n2 0"), node = text.find("5 7 8 6");
  text.replace(node, 1, "99");
  expect_as_one_rank(text, 1000, false);
  text.replace(coordinate, 1, "x");
  const TemporaryFolder folder;
  const std::string path = folder.write("m.mesh", text);
  EXPECT_EQ(test::refusal_text([&] { read_native(world(), path); }),
            path + ":6: expected an x coordinate, found \"x\"");
}

TEST(NativeRanges, SayWhatOneRankSaysOfDamagedFiles) {
  std::mt19937 random(4);  // the same on all ranks
  const auto below = [&](std::size_t end) { return random() % end; };
  const std::array<const char*, 8> numbers{"-1", "0", "2", "9", "1e9", "nan", "2147483648", "#"};
  for (int trial = 0; trial < 60; ++trial) {
    std::string text = two_blocks;
    for (std::size_t times = 1 + below(2); times > 0; --times) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0: text.resize(at); break;
        case 1: text.erase(at, below(20)); break;
        case 2: text.insert(at, text.substr(below(text.size()), below(30))); break;
        default: text.replace(at, below(3), std::string(" ") + numbers.at(below(numbers.size())) + " ");
      }
      if (text.empty()) text = "1";
    }
    expect_as_one_rank(text, 1 + below(60), false);
  }
}

TEST(BinaryRanges, GiveTheMeshThatOneRankReads) {
  const TemporaryFolder folder;
  const Communicator alone(MPI_COMM_SELF);
  const LoadedMesh whole = read_native(alone, folder.write("m.mesh", two_blocks));
  if (world().is_root()) {
    OutputSet outputs(alone);
    write_binary(outputs, MeshStream(alone, whole), folder.file("m.qmesh"));
    outputs.commit();
  }
  world().barrier();
  const LoadedMesh wanted = read_binary(alone, folder.file("m.qmesh")),
                   found = gathered(world(), read_binary(world(), folder.file("m.qmesh")));
  EXPECT_EQ(wanted.solution->cells.values, whole.solution->cells.values);
  if (world().is_root()) expect_same(found, wanted);
}

}  // namespace
}  // namespace quadloop::io
