#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "mesher/base/ids.hpp"
#include "smoother/smooth_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::test {

/// This rank alone; never freed, as MPI ends before what is static does.
const Communicator& self();

Mesh jittered(const Grid& grid, double share, std::uint64_t seed = 3);

/// A fifth of the inner nodes go up to nine tenths of their shortest edge away, so that cells are inverted.
Mesh tangled(const Grid& grid, std::uint64_t seed);

/// A polygon close to the unit circle: `vertices` of them, none a corner.
Geometry circle(int vertices);

/// A grid bent to the disc inside the polygon, its boundary nodes somewhere on it.
Mesh disc(const Grid& grid, const Geometry& polygon);

/// Smooths a whole mesh on this rank.
Mesh smoothed_alone(Mesh mesh, const smoother::SmoothOptions& options,
                    smoother::SmoothReport* report = nullptr);

/// A whole mesh smoothed on one rank and on all, in one order.
struct Smoothed {
  MeshOrder order;
  Mesh alone, part;
  smoother::SmoothReport alone_report, report;
};

/// `options_for(part, order)` gives each communicator's options.
template <class Options>
Smoothed smooth_both_ways(const Mesh& mesh, const MeshOrder& order, const Options& options_for) {
  Smoothed s{order, scatter_mesh(self(), mesh, order), scatter_mesh(world(), mesh, order), {}, {}};
  s.alone_report = smoother::smooth_mesh(self(), s.alone, options_for(s.alone));
  s.report = smoother::smooth_mesh(world(), s.part, options_for(s.part));
  return s;
}

void expect_same_report(const smoother::SmoothReport& a, const smoother::SmoothReport& b);

template <class Options>
void expect_same_positions(const Mesh& mesh, const Options& options_for) {
  for (const MeshOrder& order : {space_filling_order(mesh), test::shuffled_order(mesh, 7)}) {
    const Smoothed s = smooth_both_ways(mesh, order, options_for);
    EXPECT_GT(s.report.moves, 0);
    expect_same_report(s.report, s.alone_report);
    for (std::int32_t node = 0; node < size32(s.part.points); ++node) {
      const std::int64_t number = s.part.global(NodeId{node}).value();
      EXPECT_EQ(s.part.point(NodeId{node}), s.alone.points[number]) << "node " << number;
    }
  }
}

}  // namespace quadloop::test
