// Texts that all ranks write together.
#include "io/text/text_output.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder, test::world;

template <class Number>
std::string text_of(Number value) {
  TextRows rows(1, 1);
  rows.put(value, ' ');
  const auto text = rows.take();
  return {text.begin(), text.end()};
}

TEST(TextRows, NumbersAreTheShortestThatReadBack) {
  EXPECT_EQ(text_of(0.1), "0.1 ");
  EXPECT_EQ(text_of(-0.0), "-0 ");
  EXPECT_EQ(text_of(std::int64_t{-7}), "-7 ");
  for (const double longest : {-std::numeric_limits<double>::max(), -std::numeric_limits<double>::min(),
                               -2.2250738585072011e-308, -1.2345678901234567e-300}) {
    const std::string text = text_of(longest);
    EXPECT_LE(text.size(), TextRows::longest_number);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), longest);
  }
}

/// A mesh whose boundaries lie on some ranks alone, one of them on none.
Mesh spread_mesh() {
  const Mesh whole = test::sample_mesh(9);
  Mesh part = scatter_mesh(world(), whole, own_order(whole));
  part.boundaries.insert(part.boundaries.begin(), {"nothing", "none", {}});
  return part;
}

TEST(TextOutput, IsTheSameTextHoweverItsRowsAreSpread) {
  const TemporaryFolder folder;
  const Mesh part = spread_mesh();
  OutputSet outputs(world());
  TextOutput text(outputs, folder.file("a.txt"));
  text.write("head\n");
  text.write_rows(static_cast<std::size_t>(part.owned_nodes), 2, [&](TextRows& rows, std::size_t i) {
    rows.put(part.first_node + static_cast<std::int64_t>(i), ' ');
    rows.put(0.5, '\n');
  });
  text.write_root_rows(2, 1, [](TextRows& rows, std::size_t i) { rows.put(i, '\n'); });
  text.write_boundaries(
      BoundaryStream(world(), part), 1, [](std::size_t n) { return "boundary " + std::to_string(n) + "\n"; },
      [](TextRows& rows, std::size_t n, const BoundaryStream::Edge&) { rows.put(n, '\n'); });
  text.close();
  outputs.commit();
  std::string expected = "head\n";
  for (std::int64_t node = 0; node < world().sum(part.owned_nodes); ++node)
    expected += std::to_string(node) + " 0.5\n";
  expected += "0\n1\nboundary 0\n";
  const Mesh whole = test::sample_mesh(9);
  for (std::size_t i = 0; i < whole.boundaries[0].edges.size(); ++i) expected += "0\n";
  expected += "boundary 1\n";
  for (std::size_t i = 0; i < whole.boundaries[1].edges.size(); ++i) expected += "1\n";
  world().barrier();
  EXPECT_EQ(test::bytes_of(folder.file("a.txt")), expected);
  world().barrier();
}

}  // namespace
}  // namespace quadloop::io
