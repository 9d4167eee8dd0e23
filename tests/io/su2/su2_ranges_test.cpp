// An SU2 mesh that all ranks read, each some of its lines, is the one that is read as a whole; a file that
// needs more than that is left to the root, and gives the same mesh or message. Solutions are read by ranges,
// too.
#include "io/su2/su2_ranges.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/formats.hpp"
#include "io/model/distribute.hpp"
#include "io/solution_file.hpp"
#include "io/su2/su2_file.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/as_whole.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/same_mesh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::expect_same;
using test::TemporaryFolder;
using test::world;

/// Two squares, the second divided, with a line between them, a marker in two parts, of which one is empty,
/// edges in both directions, sides that match, keys and rows of others, remarks, and numbers of rows or none.
const std::string squares =
    "% made by hand = here\nNDIME= 2\n% block the gas\nAOA= 3 degrees\n"
    "NELEM= 3\n5 1 2 4 0\n9 0 1 4 3   1\n\n5 2 5 4 % of the second\n"
    "NPOIN= 6 6\n0 0 0\n1 0\n  2 0 2\n0 1.0D0 3 3\n1 1\n2 1 5\n"
    "NMARK= 5\nMARKER_TAG= sides % of the domain\nMARKER_ELEMS= 1\n3 0 3\n"
    "MARKER_TAG= top and bottom\nMARKER_ELEMS= 4\n3 0 1 0\n3 1 2 1\n3 4 5 2\n3 4 3 3\n"
    "MARKER_TAG= middle\nMARKER_ELEMS= 1\n3 4 1\nMARKER_TAG= none\nMARKER_ELEMS= 0\n"
    "MARKER_TAG= right\nMARKER_ELEMS= 1\n3 2 5\nFFD_NBOX= 0\nrows of others\n1 2 3";

std::string changed(const std::string& what, const std::string& into) {
  std::string text = squares;
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), into);
}

std::string refusal_by_ranges(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.write("m.su2", text);
  return test::refusal_text([&] { read_su2_ranges(world(), path); });
}

void expect_as_whole(const std::string& text) {
  SCOPED_TRACE(text.substr(0, 2000));
  const TemporaryFolder folder;
  test::expect_as_whole<read_su2>("su2", folder.write("m.su2", text));
}

TEST(Su2Ranges, GiveTheMeshThatIsReadAsAWhole) {
  std::string text = squares;
  text.replace(text.find(" % of the domain"), 16, "");
  for (const std::size_t piece : {1, 30, 1000000}) {
    const TemporaryFolder folder;
    const std::string path = folder.write("m.su2", text);
    const LoadedMesh whole = gathered(world(), read_su2_ranges(world(), path, piece));
    if (world().is_root()) expect_same(whole, test::read_plane<read_su2>(path));
  }
  const TemporaryFolder folder;
  const LoadedMesh part = read_su2_ranges(world(), folder.write("m.su2", text));
  EXPECT_EQ(part.mesh.owned_nodes,
            6 * (world().rank() + 1) / world().size() - 6 * world().rank() / world().size());
  EXPECT_EQ(part.block_names, std::vector<std::string>{"the gas"});
  ASSERT_EQ(part.mesh.boundaries.size(), 3U);
  EXPECT_EQ(part.mesh.boundaries[1].name, "top and bottom");
  ASSERT_EQ(part.inner_curves.size(), 1U);
  EXPECT_EQ(part.inner_curves[0].name, "middle");
  EXPECT_EQ(world().sum(std::ssize(part.periodic_nodes)), 4) << "of the sides";
}

/// Each is changed in one thing, which the root alone repairs, reports or refuses.
TEST(Su2Ranges, AreOfFilesThatNeedNoMore) {
  EXPECT_NE(refusal_by_ranges(squares), "") << "a remark after a name";
  const std::vector<std::pair<std::string, std::string>> changes{
      {"5 1 2 4 0", "5 1 4 2 0"},                          // clockwise
      {"5 1 2 4 0", "5 1 2 4 0 0"},                        // too many numbers
      {"5 1 2 4 0", "5 1 2 6 0"},                          // no such point
      {"5 1 2 4 0", "5 1 2"},                              // too few
      {"NELEM= 3\n", "NELEM= 4\n5 2 5 4\n"},               // twice the same cell
      {"5 1 2 4 0", "10 1 2 4 0"},                         // a tetrahedron
      {"NELEM= 3", "NELEM= 4"},                            //
      {"NELEM= 3", "NELEM= 2"},                            //
      {"NPOIN= 6 6", "NPOIN= 6 6 6"},                      //
      {"  2 0 2", "  2 x 2"},                              //
      {"  2 0 2", "  nan 0 2"},                            //
      {"  2 0 2", "  2 0 0.5"},                            // ignored with a warning
      {"NMARK= 5", "NMARK= 4"},                            //
      {"NMARK= 5", ""},                                    //
      {"MARKER_TAG= middle", "MARKER_TAG= SEND_RECEIVE"},  // left out with a warning
      {"MARKER_TAG= middle\n", ""},                        //
      {"3 2 5\n", "3 0 4\n"},                              // of no cell
      {"NDIME= 2", "NZONE= 1\nIZONE= 1\nNDIME= 2"},        //
      {"NDIME= 2", "NDIME= 2\nNDIME= 2"},                  //
      {"NDIME= 2", "NDIME= 3"},                            //
      {"NDIME= 2", "0 0\nNDIME= 2"},                       //
      {"NELEM= 3", "NELEM= 0\nMORE= 1"},                   //
  };
  for (const auto& [what, into] : changes) {
    std::string text = changed(what, into);
    text.replace(text.find(" % of the domain"), 16, "");
    EXPECT_NE(refusal_by_ranges(text), "") << what << " -> " << into;
    expect_as_whole(text);
  }
  expect_as_whole(squares);
  expect_as_whole("");
}

TEST(Su2Ranges, SayWhatIsSaidOfDamagedFilesAsAWhole) {
  std::mt19937 random(4);  // the same on all ranks
  const auto below = [&](std::size_t end) { return random() % end; };
  const std::array<const char*, 8> pieces{"-1", "0", "2", "=", "\n", "nan", "2147483648", "%"};
  for (int trial = 0; trial < 30; ++trial) {
    std::string text = squares;
    text.replace(text.find(" % of the domain"), 16, "");
    const std::size_t at = below(text.size());
    switch (below(3)) {
      case 0: text.resize(at); break;
      case 1: text.replace(at, 1, pieces[below(pieces.size())]); break;
      default: text.erase(at, 1 + below(9)); break;
    }
    expect_as_whole(text);
  }
}

/// The solution of a file, or why there is none, read by all ranks and by one.
void expect_as_one_rank(const std::string& name, const std::string& bytes, bool readable) {
  const TemporaryFolder folder;
  const std::string path = folder.write(name, bytes);
  LoadedSolution part, wanted;
  const std::string refusal = test::refusal_text([&] { part = read_solution(world(), path); }),
                    of_one = test::refusal_text([&] { wanted = read_solution(path); });
  EXPECT_EQ(refusal, of_one) << bytes;
  EXPECT_EQ(refusal.empty(), readable) << refusal;
  if (!refusal.empty() || !of_one.empty()) return;
  EXPECT_EQ(part.nodes, wanted.nodes);
  EXPECT_EQ(part.solution.names, wanted.solution.names);
  EXPECT_EQ(world().all_gather_values(std::span<const double>(part.solution.values)), wanted.solution.values);
  EXPECT_EQ(world().all_gather_values(std::span<const Point>(part.points)), wanted.points);
  const std::int64_t rank = world().rank(), ranks = world().size();
  EXPECT_EQ(std::ssize(part.solution.values),
            wanted.solution.width() * (part.nodes * (rank + 1) / ranks - part.nodes * rank / ranks));
}

const std::string table =
    "\n\"PointID\", \"x\", \"y\", \"z\", \"Density\", \"Mach\"\n0, 0, 0, 2, 1, 0.5\n\n1, 1, 0, 2, 3, 0.25,\n"
    "2, 1, 1, 2, 5, 0.125\n3, 0, 1, 2, 7, 1\n4, 0, 2, 2, 9, 2\n";

TEST(Su2Csv, IsReadByRangesOfLines) {
  const auto with = [](const std::string& what, const std::string& into) {
    std::string text = table;
    return text.replace(text.find(what), what.size(), into);
  };
  expect_as_one_rank("s.csv", table, true);
  const std::string moved = with("1, 1, 0, 2, 3", "3, 1, 0, 2, 3");
  expect_as_one_rank("s.csv", moved, false);  // twice the same number
  std::string sorted = moved;
  sorted.replace(sorted.rfind("3, 0, 1, 2, 7"), 1, "1");
  expect_as_one_rank("s.csv", sorted, true);
  const TemporaryFolder folder;
  const LoadedSolution part = read_solution(world(), folder.write("s.csv", sorted));
  EXPECT_EQ(world().all_gather_values(std::span<const double>(part.solution.values)),
            (std::vector<double>{1, 0.5, 7, 1, 5, 0.125, 3, 0.25, 9, 2}));
  EXPECT_EQ(world().all_gather_values(std::span<const Point>(part.points))[1], (Point{0, 1}));
  expect_as_one_rank("s.csv", with("4, 0, 2, 2, 9", "5, 0, 2, 2, 9"), false);
  expect_as_one_rank("s.csv", with("4, 0, 2, 2, 9", "4, 0, 2, 3, 9"), false);
  expect_as_one_rank("s.csv", with("4, 0, 2, 2, 9", "4, 0, 2, 2, inf"), false);
  expect_as_one_rank("s.csv", with("4, 0, 2, 2, 9", "4, 0, 2, 2"), false);
  expect_as_one_rank("s.csv", with("3, 0, 1", "3, 0, one"), false);
  expect_as_one_rank("s.csv", table.substr(0, 50), false);
  expect_as_one_rank("s.csv", "\n\n", false);
  EXPECT_EQ(test::refusal_text(
                [&] { read_solution(world(), folder.write("s.csv", with("3, 0, 1", "3, 0, one"))); }),
            folder.file("s.csv") + ":7: expected a number for y, found \"one\"");
}

TEST(Su2Dat, IsReadByRangesOfRows) {
  std::string bytes;
  const auto add = [&](const auto& numbers) {
    const std::span<const std::byte> raw = std::as_bytes(std::span(numbers));
    bytes.append(reinterpret_cast<const char*>(raw.data()), raw.size());
  };
  add(std::array<std::int32_t, 5>{535532, 4, 7, 0, 0});
  for (std::string name : {"x", "Density", "y", "Mach"}) bytes += (name.resize(33), name);
  for (int i = 0; i < 7; ++i) add(std::array<double, 4>{0.5 * i, i + 1., -2. * i, i + 100.});
  expect_as_one_rank("s.dat", bytes, true);
  expect_as_one_rank("s.dat", bytes.substr(0, bytes.size() - 1), false);
  expect_as_one_rank("s.dat", bytes.substr(0, 12), false);
}

}  // namespace
}  // namespace quadloop::io
