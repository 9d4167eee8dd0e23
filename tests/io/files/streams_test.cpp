// Rows and boundary edges on their way through rank 0.
#include <gtest/gtest.h>

#include <numeric>

#include "io/files/boundary_stream.hpp"
#include "io/files/row_stream.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::world;

std::vector<int> own_rows() {
  std::vector<int> rows(world().rank() == 1 ? 0 : 3 + world().rank());
  std::iota(rows.begin(), rows.end(), 100 * world().rank());
  return rows;
}

TEST(RowStream, BringsAllRowsThroughRankZeroInOrder) {
  const std::vector<int> own = own_rows();
  for (const std::int64_t per_piece : {1, 2, 100}) {
    std::vector<int> seen;
    std::size_t longest = 0;
    RowStream{world(), std::ssize(own), per_piece}.run<int>(
        [&](std::int64_t begin, std::int64_t end) {
          return std::vector<int>(own.begin() + begin, own.begin() + end);
        },
        [&](std::span<const int> piece) {
          longest = std::max(longest, piece.size());
          seen.insert(seen.end(), piece.begin(), piece.end());
        });
    const std::vector<int> all = world().all_gather_values(std::span<const int>(own));
    EXPECT_EQ(seen, world().is_root() ? all : std::vector<int>{});
    EXPECT_LE(longest, static_cast<std::size_t>(per_piece));
  }
}

TEST(RowStream, AFailureOfAnyRankEndsOnAll) {
  const std::vector<int> own = own_rows();
  const RowStream stream{world(), std::ssize(own), 1};
  const auto make = [&](std::int64_t begin, std::int64_t end) {
    return std::vector<int>(own.begin() + begin, own.begin() + end);
  };
  EXPECT_THROW(stream.run<int>(make, [](std::span<const int>) { throw OutputError("full"); }), OutputError);
  const int last = world().size() - 1;
  const auto failing = [&](std::int64_t begin, std::int64_t end) {
    if (world().rank() == last && begin == 1) throw InputError("broken");
    return make(begin, end);
  };
  if (last != 1) {  // which has no row
    EXPECT_THROW(stream.run<int>(failing, [](std::span<const int>) {}), InputError);
  }
}

/// A mesh whose boundaries lie on some ranks alone, one of them on none.
Mesh spread_mesh() {
  const Mesh whole = test::sample_mesh(9);
  Mesh part = scatter_mesh(world(), whole, own_order(whole));
  part.boundaries.insert(part.boundaries.begin(), {"nothing", "none", {}});
  return part;
}

TEST(BoundaryStream, BringsEachBoundarysEdgesTogether) {
  const Mesh part = spread_mesh();
  const BoundaryStream stream(world(), part);
  ASSERT_EQ(stream.present().size(), 2U) << "the one without edges is left out";
  EXPECT_EQ(stream.present()[0]->name, "wall");
  EXPECT_EQ(stream.all_edges(), stream.edges_of(0) + stream.edges_of(1));
  std::vector<std::vector<BoundaryStream::Edge>> seen;
  stream.run(
      [&](std::size_t place) {
        EXPECT_EQ(place, seen.size());
        seen.emplace_back();
      },
      [&](std::span<const BoundaryStream::Edge> edges) {
        seen.back().insert(seen.back().end(), edges.begin(), edges.end());
      });
  for (std::size_t b = 1; b < part.boundaries.size(); ++b) {
    std::vector<BoundaryStream::Edge> own;
    for (const auto& [from, to] : part.boundaries[b].edges)
      own.push_back({part.global(from).value(), part.global(to).value()});
    const auto all = world().all_gather_values(std::span<const BoundaryStream::Edge>(own));
    EXPECT_EQ(stream.edges_of(b - 1), std::ssize(all));
    if (world().is_root()) {
      EXPECT_EQ(seen.at(b - 1), all);
    }
  }
}

TEST(BoundaryStream, BringsOtherNumbersInThePlaceOfNodes) {
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
  stream.run([](std::size_t) {},
             [&](std::span<const BoundaryStream::Edge> some) {
               for (const auto& [number, seven] : some) {
                 EXPECT_EQ(seven, 7);
                 sum += number;
                 ++edges;
               }
             });
  wanted = world().sum(wanted);
  if (world().is_root()) {
    EXPECT_EQ(sum, wanted);
    EXPECT_EQ(edges, stream.all_edges());
  }
}

TEST(BoundaryStream, AFailureEndsOnAllRanks) {
  const Mesh part = spread_mesh();
  const BoundaryStream stream(world(), part);
  EXPECT_THROW(stream.run([](std::size_t) { throw OutputError("full"); },
                          [](std::span<const BoundaryStream::Edge>) {}),
               OutputError);
  EXPECT_THROW(stream.run([](std::size_t) {},
                          [](std::span<const BoundaryStream::Edge>) { throw OutputError("full"); }),
               OutputError);
}

}  // namespace
}  // namespace quadloop::io
