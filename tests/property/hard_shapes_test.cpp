// Thousands of small hard geometries: every one must end as a valid mesh or as a refusal that names a place,
// and none may hang.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "mesher/base/error.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/build/outline_losses.hpp"
#include "mesher/cut/grid_rank.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/check/validate_geometry.hpp"
#include "mesher/mesh/topology.hpp"
#include "smoother/smooth_mesh.hpp"
#include "tests/property/shapes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

constexpr double rounding = 1e-7;  // of costs near 1 and of angles in degrees: cells of these shapes may be
                                   // as flat as doubles can tell
constexpr double seconds_allowed =
    10;  // for one shape of a few thousand leaves; the median is a few milliseconds

/// Number of shapes: QUADLOOP_SHAPES where set.
int shapes_wanted() {
  const char* text = std::getenv("QUADLOOP_SHAPES");
  return text != nullptr ? std::atoi(text) : 2400;
}

MeshOptions random_options(shapes::Random& random) {
  MeshOptions options;
  options.size.min = std::ldexp(1.0, -static_cast<int>(3 + random() % 4)) * (random() % 2 == 0 ? 1.0 : 1.3);
  options.size.max = 0.5;
  options.size.gradation = random() % 3 == 0 ? 2.0 : 1.5;
  if (random() % 4 == 0) options.size.curvature = 30.0;
  if (random() % 2 == 0) options.size.root = RootOptions{{-1, -1}, 2, 1, 1};
  const double snaps[] = {0, 0.001, 0.4, 0.4};
  options.snap = snaps[random() % 4];
  options.type = random() % 2 == 0 ? MeshType::delaunay : MeshType::hybrid;
  options.may_vanish = true;
  return options;
}

void write_shape(const shapes::Shape& shape, std::uint64_t seed) {
  std::ofstream out("failed_shape_" + std::to_string(seed) + ".geom");
  out.precision(17);
  out << "# " << shape.name << ", seed " << seed << "\n" << shape.chains.size() << "\n";
  for (const Chain& chain : shape.chains) {
    out << chain.name << (chain.open ? " open\n" : "\n") << chain.points.size() << "\n";
    for (const Point p : chain.points) out << p.x << " " << p.y << "\n";
  }
}

/// Empty, or what is wrong: an edge that the circumcircle of one triangle beside it would have flipped,
/// though the other diagonal leaves room.
std::string delaunay_fault(const Mesh& mesh) {
  if (!mesh.quads.empty()) return "quads in a Delaunay mesh";
  const EdgeTable table(mesh);
  const auto positive = [](Point a, Point b, Point c) {
    return cross(b - a, c - a) > 0 && cross(c - b, a - b) > 0 && cross(a - c, b - c) > 0;
  };
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      const std::int32_t across = table.cell_left_of(b, a);
      if (across < 0) continue;
      for (const NodeId d : mesh.triangles[across]) {
        if (d == a || d == b) continue;
        const Point pa = mesh.point(a), pb = mesh.point(b), pc = mesh.point(c), pd = mesh.point(d);
        if (in_circle(pa, pb, pc, pd) > 0 && positive(pa, pd, pc) && positive(pd, pb, pc))
          return "an edge is not Delaunay";
      }
    }
  }
  return "";
}

/// What is dropped or coarsened by design has to pass the comparison with the geometry that was given.
std::string mesh_fault(Mesh mesh, const Geometry& geometry, MeshType type) {
  std::erase_if(mesh.boundaries, [](const BoundaryEdges& b) { return b.edges.empty(); });
  for (const MeshFault& fault : validate(mesh)) return std::string(name_of(fault.rule)) + ": " + fault.what;
  for (const MeshFault& fault : validate_geometry(mesh, chains_of(geometry)).faults) {
    return fmt::format("geometry: {} at ({}, {})", fault.what, fault.place.x, fault.place.y);
  }
  return type == MeshType::delaunay ? delaunay_fault(mesh) : "";
}

/// Smooths the mesh, boundary nodes along the geometry; empty where it stays valid and its worst cell and
/// smallest angle get no worse.
std::string smoothing_fault(Mesh mesh, const Geometry& geometry, const MeshOptions& options,
                            double area_dropped) {
  smoother::SmoothOptions how;
  how.geometry = &geometry;
  const TreeGrid grid = choose_root(geometry, options.size);
  if (options.type == MeshType::delaunay) {
    how.delaunay = [&](Point p) { return tie_rank(grid, grid.finest_level(options.size.min), p); };
  }
  const QualitySummary before = summarise_quality(test::world(), mesh);
  const smoother::SmoothReport report = smoother::smooth_mesh(test::world(), mesh, how);
  const QualitySummary after = summarise_quality(test::world(), mesh);
  if (report.inverted_after > report.inverted_before) return "smoothed: more cells are flat";
  if (report.inverted_before == 0 && report.worst_cost_after > report.worst_cost_before + rounding) {
    return "smoothed: the largest cost has risen from " + std::to_string(report.worst_cost_before) + " to " +
           std::to_string(report.worst_cost_after);
  }
  if (report.inverted_before == 0 && after.smallest_degrees < before.smallest_degrees - rounding) {
    return "smoothed: the smallest angle has fallen from " + std::to_string(before.smallest_degrees) +
           " to " + std::to_string(after.smallest_degrees);
  }
  require_area(test::world(), geometry, area_dropped, mesh);
  const std::string wrong = mesh_fault(std::move(mesh), geometry, options.type);
  return wrong.empty() ? wrong : "smoothed: " + wrong;
}

/// Empty where all is well; else what is wrong.
std::string outcome(const shapes::Shape& shape, const MeshOptions& options, double corner,
                    std::int64_t& refused) {
  try {
    Warnings warnings;
    AssembleOptions how;
    how.default_corner_degrees = corner;
    const Geometry geometry = assemble(shape.chains, how, warnings);
    MeshResult result = build_mesh(test::world(), geometry, options);
    require_area(test::world(), geometry, result.report.area_dropped, result.mesh);
    const std::string wrong = mesh_fault(result.mesh, geometry, options.type);
    return wrong.empty() ? smoothing_fault(result.mesh, geometry, options, result.report.area_dropped)
                         : wrong;
  } catch (const InputError& error) {
    ++refused;
    const std::string message = error.what();
    if (message.find("boundary") == std::string::npos && message.find("loop") == std::string::npos)
      return "a refusal without a place: " + message;
  } catch (const std::exception& error) {
    return std::string("a fault: ") + error.what();
  }
  return {};
}

TEST(HardShapes, EndValidOrRefused) {
  const int count = shapes_wanted();
  std::int64_t refused = 0;
  double slowest = 0;
  for (int i = 0; i < count; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    shapes::Random random(seed);
    const shapes::Shape shape = shapes::random_shape(random);
    const MeshOptions options = random_options(random);
    const double corner = random() % 4 == 0 ? 180 : 30;
    const auto start = std::chrono::steady_clock::now();
    const std::string wrong = outcome(shape, options, corner, refused);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    slowest = std::max(slowest, seconds);
    EXPECT_LT(seconds, seconds_allowed) << shape.name << ", seed " << seed;
    EXPECT_EQ(wrong, "") << shape.name << ", seed " << seed << ", min " << options.size.min << ", snap "
                         << options.snap << ", corner " << corner << ", gradation " << options.size.gradation
                         << ", root " << options.size.root.has_value();
    if (!wrong.empty()) write_shape(shape, seed);
  }
  std::cout << count << " shapes, " << refused << " refused, slowest " << slowest << " s\n";
  EXPECT_LT(refused, count / 4) << "too many shapes are refused for the test to mean much";
}

}  // namespace
}  // namespace quadloop
