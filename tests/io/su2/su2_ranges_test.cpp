// An SU2 mesh that all ranks read, each some of its lines, is the one that is read as a whole; a file that
// needs more than that is left to the root, and gives the same mesh or message.
#include "io/su2/su2_ranges.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "io/formats.hpp"
#include "io/model/distribute.hpp"
#include "io/su2/su2_file.hpp"
#include "mesher/base/error.hpp"
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

/// Reads with all ranks as commands do, and as a whole on one; compares what they get.
void expect_as_whole(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.write("m.su2", text);
  MeshOfFile part;
  LoadedMesh wanted;
  const std::string refusal = test::refusal_text([&] { part = format_named("su2")->read(world(), path); }),
                    of_one = test::refusal_text([&] { wanted = test::read_plane<read_su2>(path); });
  EXPECT_EQ(refusal, of_one) << text;
  if (!refusal.empty() || !of_one.empty() || !std::holds_alternative<LoadedMesh>(part)) return;
  const LoadedMesh whole = gathered(world(), std::get<LoadedMesh>(part));
  if (world().is_root()) expect_same(whole, wanted);
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
      {"5 1 2 4 0", "5 2 5 4 0"},                          // twice the same cell
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

}  // namespace
}  // namespace quadloop::io
