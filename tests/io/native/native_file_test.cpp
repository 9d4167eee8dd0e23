// The native reader: what it accepts, and what it refuses by line. It works on one rank alone.
#include "io/native/native_file.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include "mesher/base/error.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;

/// One square of two triangles; the line numbers below count in it.
const std::string square =
    "#Number of grid points\n4\n0 0\n1 0\n1 1\n0 1\n"                          // 1-6
    "#Number of blocks\n1\n#Number of triangular elements\n2\n1 2 3\n1 3 4\n"  // 7-12
    "#Number of quadrilateral elements\n0\n#Number of boundaries\n1\n"         // 13-16
    "#Number of edges for boundary 1 (wall)\n4\n1 2\n2 3\n3 4\n4 1\n";         // 17-22
const std::string solution =
    "#Number of constants\n1\n0.5\n#Number of variables\n2\n#names: a b\n1 2\n3 4\n5 6\n7 8\n";  // 23-32

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

LoadedMesh read_text(const std::string& text) {
  const TemporaryFolder folder;
  test::write_bytes(folder.file("m.mesh"), text);
  return read_native(Communicator(MPI_COMM_SELF), folder.file("m.mesh"));
}

/// Line and reason of the refusal, without the folder; empty where the text is accepted.
std::string refusal(const std::string& text) {
  const TemporaryFolder folder;
  test::write_bytes(folder.file("m.mesh"), text);
  try {
    read_native(Communicator(MPI_COMM_SELF), folder.file("m.mesh"));
  } catch (const InputError& error) {
    return std::string(error.what()).substr(folder.path().size() + 1);
  }
  return {};
}

void expect_refusal(const std::string& text, const std::string& begins, const std::string& says) {
  const std::string found = refusal(text);
  EXPECT_EQ(found.substr(0, begins.size()), begins) << found;
  EXPECT_NE(found.find(says), std::string::npos) << found;
}

TEST(NativeReader, ReadsStripsFromCommentsAndTellsOfDamagedOnes) {
  const std::string strip = "# strip wake 1 0.5 3 2 line\n";
  const LoadedMesh damaged = read_text(square + strip + "# nodes 1-3\n" + solution);
  EXPECT_TRUE(damaged.mesh.strips.empty());
  ASSERT_EQ(damaged.warnings.size(), 1U);
  EXPECT_NE(damaged.warnings[0].find("'# strip wake' does not list"), std::string::npos)
      << damaged.warnings[0];
  EXPECT_TRUE(damaged.solution.has_value());
  const LoadedMesh narrow = read_text(square + "# strip wake 1 0.5 3 2 line\n# nodes 1-3 4\n# nodes 2 1\n");
  EXPECT_TRUE(narrow.mesh.strips.empty()) << "a node twice";
}

TEST(NativeReader, ReadsMeshAndSolution) {
  const LoadedMesh loaded = read_text(square + solution);
  EXPECT_EQ(loaded.mesh.points.size(), 4U);
  EXPECT_EQ(loaded.mesh.triangles.size(), 2U);
  ASSERT_EQ(loaded.mesh.boundaries.size(), 1U);
  EXPECT_EQ(loaded.mesh.boundaries[0].name, "wall");
  EXPECT_TRUE(validate(loaded.mesh).empty());
  ASSERT_TRUE(loaded.solution);
  EXPECT_EQ(loaded.solution->names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(loaded.solution->constants, std::vector<double>{0.5});
  EXPECT_EQ(loaded.solution->values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(NativeReader, TakesAnyWhitespaceCommentsAndExponents) {
  EXPECT_FALSE(read_text(square).solution);
  std::string crlf;
  for (const char c : square) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read_text(crlf).mesh.boundaries.at(0).name, "wall");
  const LoadedMesh fortran = read_text(
      replaced(square, "1 0\n1 1\n", "# between rows\n  +1.0D+00\t0.0d0\n\n1\n# within a row\n 1E0\n"));
  EXPECT_EQ(fortran.mesh.points, read_text(square).mesh.points);
  const LoadedMesh unnamed = read_text(replaced(square + solution, "#names: a b\n", ""));
  EXPECT_EQ(unnamed.solution->names, (std::vector<std::string>{"v1", "v2"}));
  EXPECT_EQ(
      read_text(replaced(square, "#Number of edges for boundary 1 (wall)\n", "")).mesh.boundaries.at(0).name,
      "boundary_1");
}

TEST(NativeReader, KeepsBlocksApart) {
  const std::string two = replaced(replaced(square, "blocks\n1\n", "blocks\n2\n"),
                                   "2\n1 2 3\n1 3 4\n#Number of quadrilateral elements\n0\n",
                                   "1\n1 2 3\n#Q\n0\n#T\n1\n1 3 4\n#Q\n0\n");
  const LoadedMesh loaded = read_text(two);
  EXPECT_EQ(loaded.blocks, 2);
  EXPECT_EQ(loaded.triangle_to_block, (std::vector<std::int32_t>{0, 1}));
  EXPECT_EQ(loaded.block_names, (std::vector<std::string>{"block_1", "block_2"}));
  EXPECT_TRUE(validate(loaded.mesh, {2, loaded.triangle_to_block, loaded.quad_to_block}).empty());
}

TEST(NativeReader, ReadsNamesOfBlocksInComments) {
  const std::string two = replaced(replaced(square, "blocks\n1\n", "blocks\n2\n# block the gas\n"),
                                   "2\n1 2 3\n1 3 4\n#Number of quadrilateral elements\n0\n",
                                   "1\n1 2 3\n#Q\n0\n# block solid (a)\n#T\n1\n1 3 4\n#Q\n0\n");
  EXPECT_EQ(read_text(two).block_names, (std::vector<std::string>{"the gas", "solid (a)"}));
  EXPECT_EQ(read_text(two).mesh.boundaries.at(0).name, "wall");
  EXPECT_EQ(read_text(replaced(two, "# block solid (a)\n", "")).block_names,
            (std::vector<std::string>{"the gas", "block_2"}));
  EXPECT_EQ(read_text(replaced(square, "blocks\n1\n", "blocks\n1\n# block gas\n")).block_names,
            std::vector<std::string>{"gas"});
}

TEST(NativeReader, RefusesWrongCounts) {
  expect_refusal(replaced(square, "points\n4\n", "points\n5\n"), "m.mesh:", "");
  expect_refusal(replaced(square, "points\n4\n", "points\n-4\n"), "m.mesh:2: ", "negative");
  expect_refusal(replaced(square, "points\n4\n", "points\n4000000000\n"), "m.mesh:2: ", "");
  expect_refusal(replaced(square, "points\n4\n", "points\n2000000000\n"), "m.mesh:2: ", "cut short");
  expect_refusal(replaced(square, "blocks\n1\n", "blocks\n0\n"), "m.mesh:8: ", "block");
  expect_refusal(replaced(square, "\n2\n1 2 3", "\n3\n1 2 3"), "m.mesh:", "");
  expect_refusal(replaced(square, "\n2\n1 2 3", "\n2.5\n1 2 3"), "m.mesh:10: ", "2.5");
  expect_refusal(replaced(square + solution, "variables\n2\n", "variables\n3\n"), "m.mesh:", "");
  expect_refusal(replaced(square + solution, "names: a b", "names: a b c"), "m.mesh:", "3 names");
}

TEST(NativeReader, RefusesBadNumbersByLine) {
  expect_refusal(replaced(square, "1 3 4", "1 3 5"), "m.mesh:12: ", "node 5");
  expect_refusal(replaced(square, "1 3 4", "1 0 4"), "m.mesh:12: ", "node 0");
  expect_refusal(replaced(square, "4 1\n", "4 9\n"), "m.mesh:22: ", "node 9");
  expect_refusal(replaced(square, "1 1\n", "1 nan\n"), "m.mesh:5: ", "nan");
  expect_refusal(replaced(square, "1 1\n", "inf 1\n"), "m.mesh:5: ", "inf");
  expect_refusal(replaced(square, "1 1\n", "1e999 1\n"), "m.mesh:5: ", "1e999");
  expect_refusal(replaced(square, "1 1\n", "1 one\n"), "m.mesh:5: ", "one");
  expect_refusal(replaced(square + solution, "5 6", "5 NaN"), "m.mesh:31: ", "NaN");
}

TEST(NativeReader, RefusesEarlyEndAndTrailingText) {
  for (std::size_t lines = 0, at = 0; at + 1 < square.size(); at = square.find('\n', at) + 1, ++lines) {
    if (lines < 22) expect_refusal(square.substr(0, at), "m.mesh:", "");
  }
  expect_refusal(square + solution.substr(0, solution.size() - 4), "m.mesh:", "end");
  expect_refusal(square + solution + "9 9\n", "m.mesh:33: ", "after the end");
  expect_refusal("", "m.mesh:1: ", "end");
}

TEST(NativeReader, RefusesWhatIsNoFile) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_native(Communicator(MPI_COMM_SELF), folder.file("missing.mesh")), InputError);
  EXPECT_THROW(read_native(Communicator(MPI_COMM_SELF), folder.path()), InputError);
}

}  // namespace
}  // namespace quadloop::io
