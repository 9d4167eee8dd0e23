// Rows and boundary edges that all ranks append to a file.
#include "io/files/row_output.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "io/files/boundary_stream.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder, test::world;

/// Some texts of different length on each rank, none on rank 1 and none of some sections.
std::string text_of(int rank, std::size_t section, std::int64_t i) {
  return std::to_string(rank) + "." + std::to_string(section) + "." + std::to_string(i * i * i) + ";";
}
std::int64_t rows_of(int rank, std::size_t section) {
  return rank == 1 || section == 2 ? 0 : 3 + rank + static_cast<std::int64_t>(section);
}

std::string expected_text(std::size_t sections) {
  std::string text = "head|";
  for (std::size_t s = 0; s < sections; ++s) {
    text += "section " + std::to_string(s) + ":";
    for (int rank = 0; rank < world().size(); ++rank) {
      for (std::int64_t i = 0; i < rows_of(rank, s); ++i) text += text_of(rank, s, i);
    }
  }
  return text + "|end";
}

/// The file that all ranks write, in pieces of so many rows, as rank 0 reads it.
std::string written_text(std::size_t sections, std::int64_t per_piece, std::int64_t most_held) {
  const TemporaryFolder folder;
  OutputSet outputs(world());
  RowOutput file(outputs, outputs.stage(folder.file("a.txt")), most_held);
  file.write("head");
  file.write("|");
  RowSections rows{.rows = {}, .rows_per_piece = per_piece};
  for (std::size_t s = 0; s < sections; ++s) {
    rows.rows.push_back(rows_of(world().rank(), s));
    if (world().is_root()) rows.heads.push_back("section " + std::to_string(s) + ":");
  }
  std::string piece;
  file.write_sections(rows, [&](std::size_t section, std::int64_t begin, std::int64_t end) {
    EXPECT_LE(end - begin, per_piece);
    piece.clear();
    for (std::int64_t i = begin; i < end; ++i) piece += text_of(world().rank(), section, i);
    return std::string_view(piece);
  });
  file.write("|end");
  file.close();
  outputs.commit();
  std::string text = world().is_root() ? test::bytes_of(folder.file("a.txt")) : std::string();
  world().barrier();
  return text;
}

TEST(RowOutput, HasTheRowsOfEachSectionInTheOrderOfRanks) {
  for (const std::size_t sections : {1, 4}) {
    const std::string expected = world().is_root() ? expected_text(sections) : std::string();
    for (const std::int64_t per_piece : {1, 2, 100}) {
      for (const std::int64_t most_held : {0, 20, 1 << 20})
        EXPECT_EQ(written_text(sections, per_piece, most_held), expected) << per_piece << " " << most_held;
    }
  }
}

TEST(RowOutput, WritesNumbersAtAPlace) {
  const TemporaryFolder folder;
  OutputSet outputs(world());
  RowOutput file(outputs, outputs.stage(folder.file("a.bin")));
  const std::int64_t own = 2 + world().rank(), all = world().sum(own), before = world().exclusive_sum(own);
  const std::int64_t second_place = 8 * all;
  file.move_to(second_place);
  file.write_shared_rows(all, [](std::int64_t i) { return std::array{-i, i}; });
  file.move_to(0);
  file.write_rows(own, [&](std::int64_t i) { return std::array{100 + before + i}; });
  file.close();
  outputs.commit();
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < all; ++i) numbers.push_back(100 + i);
  for (std::int64_t i = 0; i < all; ++i) numbers.insert(numbers.end(), {-i, i});
  if (world().is_root()) {
    EXPECT_EQ(test::bytes_of(folder.file("a.bin")), bytes_of(std::span<const std::int64_t>(numbers)));
  }
  world().barrier();
}

TEST(RowOutput, AFailureOfAnyRankEndsOnAll) {
  const TemporaryFolder folder;
  const int last = world().size() - 1;
  for (const std::int64_t row_bytes : {0, 1}) {
    OutputSet outputs(world());
    RowOutput file(outputs, outputs.stage(folder.file("a.txt")));
    EXPECT_THROW(file.write_sections({{2}, row_bytes, 1},
                                     [&](std::size_t, std::int64_t begin, std::int64_t) {
                                       if (world().rank() == last && begin == 1) throw InputError("broken");
                                       return "x";
                                     }),
                 InputError);
  }
}

/// A mesh whose boundaries lie on some ranks alone, one of them on none.
Mesh spread_mesh() {
  const Mesh whole = test::sample_mesh(9);
  Mesh part = scatter_mesh(world(), whole, own_order(whole));
  part.boundaries.insert(part.boundaries.begin(), {"nothing", "none", {}});
  return part;
}

TEST(BoundaryStream, HasTheEdgesOfEachBoundaryTogether) {
  const Mesh part = spread_mesh();
  const BoundaryStream stream(world(), part);
  ASSERT_EQ(stream.present().size(), 2U) << "the one without edges is left out";
  EXPECT_EQ(stream.present()[0]->name, "wall");
  EXPECT_EQ(stream.all_edges(), stream.edges_of(0) + stream.edges_of(1));
  const std::vector<std::int64_t> rows = stream.own_rows();
  for (std::size_t b = 1; b < part.boundaries.size(); ++b) {
    std::vector<BoundaryStream::Edge> own;
    for (const auto& [from, to] : part.boundaries[b].edges)
      own.push_back({part.global(from).value(), part.global(to).value()});
    const auto all = world().all_gather_values(std::span<const BoundaryStream::Edge>(own));
    EXPECT_EQ(stream.edges_of(b - 1), std::ssize(all));
    ASSERT_EQ(rows.at(b - 1), std::ssize(own));
    for (std::int64_t i = 0; i < std::ssize(own); ++i) EXPECT_EQ(stream.own_edge(b - 1, i), own[i]);
    if (own.empty()) continue;
    EXPECT_EQ(stream.before_own(b - 1) - (b == 2 ? stream.edges_of(0) : 0),
              std::ranges::find(all, own[0]) - all.begin());
  }
}

TEST(BoundaryStream, HasOtherNumbersInThePlaceOfNodes) {
  Mesh part = spread_mesh();
  part.boundaries[1].inner_line = true;  // is not chosen, so that its numbers are left out
  std::vector<BoundaryStream::Edge> instead;
  std::int64_t wanted = 0;
  for (const BoundaryEdges& boundary : part.boundaries) {
    for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
      const std::int64_t number = 100 * world().rank() + std::ssize(instead);
      instead.push_back({number, 7});
      if (!boundary.inner_line) wanted += number;
    }
  }
  const BoundaryStream stream(world(), part, std::move(instead), EdgeChoice::boundaries);
  std::int64_t sum = 0, edges = 0;
  const std::vector<std::int64_t> rows = stream.own_rows();
  for (std::size_t n = 0; n < rows.size(); ++n) {
    for (std::int64_t i = 0; i < rows[n]; ++i) {
      const auto [number, seven] = stream.own_edge(n, i);
      EXPECT_EQ(seven, 7);
      sum += number;
      ++edges;
    }
  }
  EXPECT_EQ(sum, wanted);
  EXPECT_EQ(world().sum(edges), stream.all_edges());
}

}  // namespace
}  // namespace quadloop::io
