// Directions of cells by their neighbours: alone, and by what a reader makes of them and of the boundary.
#include "io/model/orient_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "io/su2/su2_file.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/io/read_plane.hpp"
#include "tests/io/reader_check.hpp"

namespace quadloop::io {
namespace {

const test::ReaderCheck check{test::read_plane<read_su2>, "m.su2"};

/// Cells by the numbers of their nodes, as a file lists them, and an outline of which each edge stands in any
/// direction.
struct Listing {
  std::vector<Point> points;
  std::vector<std::vector<int>> cells;
  std::vector<std::array<int, 2>> outline;
};

/// Adds 4 x 4 nodes with the lower left at (x, 0), the lowest row of cells triangles, the others quads, all
/// counter-clockwise; the outline's edges run up and to the right.
void add_grid(Listing& listing, double x) {
  const auto first = static_cast<int>(listing.points.size());
  const auto at = [&](int i, int j) { return first + 4 * j + i; };
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) listing.points.push_back({x + i, static_cast<double>(j)});
  }
  for (int i = 0; i < 3; ++i) {
    listing.cells.push_back({at(i, 0), at(i + 1, 0), at(i + 1, 1)});
    listing.cells.push_back({at(i, 0), at(i + 1, 1), at(i, 1)});
    for (int j = 1; j < 3; ++j)
      listing.cells.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    for (const int end : {0, 3}) {
      listing.outline.push_back({at(i, end), at(i + 1, end)});
      listing.outline.push_back({at(end, i), at(end, i + 1)});
    }
  }
}

Listing grid() {
  Listing listing;
  add_grid(listing, 0);
  return listing;
}

/// Cells 0 to 11 of the grid at 0, cells 12 to 23 of one beside it.
Listing two_grids() {
  Listing listing = grid();
  add_grid(listing, 5);
  return listing;
}

/// An inner node, that of row 1 and column 1, pulled over the cells to its upper right.
Listing tangled(Listing listing) {
  listing.points[5] = {2.5, 2.25};
  return listing;
}

/// The cells turned for which `chosen` of their number holds.
template <class Chosen>
Listing turned(Listing listing, const Chosen& chosen) {
  for (std::size_t cell = 0; cell < listing.cells.size(); ++cell) {
    if (chosen(cell)) std::reverse(listing.cells[cell].begin() + 1, listing.cells[cell].end());
  }
  return listing;
}

std::string su2_text(const Listing& listing) {
  std::ostringstream text;
  text << "NDIME= 2\nNELEM= " << listing.cells.size() << "\n";
  for (const auto& nodes : listing.cells) {
    text << (nodes.size() == 3 ? 5 : 9);
    for (const int node : nodes) text << " " << node;
    text << "\n";
  }
  text << "NPOIN= " << listing.points.size() << "\n";
  for (const Point p : listing.points) text << p.x << " " << p.y << "\n";
  if (listing.outline.empty()) return text.str();
  text << "NMARK= 1\nMARKER_TAG= outline\nMARKER_ELEMS= " << listing.outline.size() << "\n";
  for (const auto& [from, to] : listing.outline) text << "3 " << from << " " << to << "\n";
  return text.str();
}

std::int64_t faults_of(const Mesh& mesh, MeshRule rule) {
  const std::vector<MeshFault> faults = validate(mesh);
  return std::count_if(faults.begin(), faults.end(),
                       [&](const MeshFault& fault) { return fault.rule == rule; });
}

void expect_same_cells_and_boundary(const Mesh& mesh, const Mesh& expected) {
  EXPECT_EQ(mesh.triangles, expected.triangles);
  EXPECT_EQ(mesh.quads, expected.quads);
  ASSERT_EQ(mesh.boundaries.size(), 1U);
  EXPECT_EQ(mesh.boundaries[0].edges, expected.boundaries.at(0).edges);
}

/// Expects that a listing, however the chosen of its cells are turned, reads as it does without; also where
/// the reader itself has to find the outline. The number of cells turned is in the warning.
template <class Chosen>
void expect_turned_back(const Listing& listing, const Chosen& chosen, const std::string& count) {
  const LoadedMesh plain = check.of(su2_text(listing)), loaded = check.of(su2_text(turned(listing, chosen)));
  EXPECT_TRUE(plain.warnings.empty());
  expect_same_cells_and_boundary(loaded.mesh, plain.mesh);
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_NE(loaded.warnings[0].find(": reversed " + count + " cell"), std::string::npos)
      << loaded.warnings[0];
  Listing bare = listing;
  bare.outline.clear();
  const Mesh found = check.of(su2_text(turned(bare, chosen))).mesh;
  EXPECT_EQ(found.boundaries.at(0).edges.size(), listing.outline.size());
  EXPECT_EQ(faults_of(found, MeshRule::conforming), 0);
  expect_same_cells_and_boundary(found, check.of(su2_text(bare)).mesh);
}

const auto all = [](std::size_t) { return true; };
const auto every_third = [](std::size_t cell) { return cell % 3 == 0; };
const auto most = [](std::size_t cell) { return cell % 4 != 0; };
const auto first_grid = [](std::size_t cell) { return cell < 12; };

TEST(OrientCells, TurnsAllAndSome) {
  EXPECT_TRUE(validate(check.of(su2_text(grid())).mesh).empty());
  expect_turned_back(grid(), all, "12");
  expect_turned_back(grid(), every_third, "4");
  expect_turned_back(grid(), most, "9");
}

/// The left of a boundary edge is to the left of the domain as the grid has it, wherever its cell is now.
TEST(OrientCells, LeavesATangledMeshTangled) {
  const Mesh mesh = check.of(su2_text(tangled(grid()))).mesh;
  expect_same_cells_and_boundary(mesh, check.of(su2_text(grid())).mesh);
  EXPECT_GT(faults_of(mesh, MeshRule::positive), 0);
  EXPECT_EQ(faults_of(mesh, MeshRule::conforming), 0);
  EXPECT_EQ(faults_of(mesh, MeshRule::closed), 0);
  expect_turned_back(tangled(grid()), all, "12");
  expect_turned_back(tangled(grid()), every_third, "4");
}

/// A node of the outline pulled across its neighbours: cells at the boundary are inverted.
TEST(OrientCells, KeepsTheOutlineOfInvertedCells) {
  Listing listing = grid();
  listing.points[1] = {1.25, 1.75};
  const Mesh mesh = check.of(su2_text(listing)).mesh;
  expect_same_cells_and_boundary(mesh, check.of(su2_text(grid())).mesh);
  EXPECT_GT(faults_of(mesh, MeshRule::positive), 0);
  expect_turned_back(listing, all, "12");
}

TEST(OrientCells, TurnsEachPieceByItself) {
  EXPECT_TRUE(validate(check.of(su2_text(two_grids())).mesh).empty());
  expect_turned_back(two_grids(), first_grid, "12");
  expect_turned_back(tangled(two_grids()), first_grid, "12");
  expect_turned_back(tangled(two_grids()), most, "18");
}

Mesh triangles_of(std::vector<Point> points, const std::vector<std::array<int, 3>>& triangles) {
  Mesh mesh;
  mesh.points = std::move(points);
  for (const auto& [a, b, c] : triangles) mesh.triangles.push_back({NodeId{a}, NodeId{b}, NodeId{c}});
  return mesh;
}

const std::vector<Point> pentagon{{0, 0}, {2, 0}, {3, 2}, {1, 4}, {-1, 2}};

TEST(OrientCells, LeavesWhatHasNoDirection) {
  Mesh strip = triangles_of(pentagon, {{0, 1, 2}, {1, 2, 3}, {2, 4, 3}, {3, 4, 0}, {4, 0, 1}});  // of Moebius
  const auto before = strip.triangles;
  EXPECT_EQ(orient_cells(strip), 0);
  EXPECT_EQ(strip.triangles, before);
  Mesh twice = triangles_of(pentagon, {{0, 1, 2}, {0, 1, 2}});
  EXPECT_EQ(orient_cells(twice), 0);
  Mesh endless = triangles_of({{-1e308, 0}, {1e308, 0}, {0, -1e308}, {0, 1e308}}, {{0, 1, 2}, {0, 1, 3}});
  EXPECT_LE(orient_cells(endless), 1);
}

TEST(OrientCells, IsSureOfWhatNeedsNoTurn) {
  const auto sure_of = [](const Mesh& mesh) { return surely_oriented(mesh, EdgeTable(mesh)); };
  const std::vector<std::array<int, 3>> fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_TRUE(sure_of(triangles_of(pentagon, fan)));
  for (unsigned choice = 1; choice < 8; ++choice) {
    std::vector<std::array<int, 3>> some = fan;
    for (unsigned k = 0; k < 3; ++k) {
      if ((choice >> k & 1U) != 0) std::swap(some[k][1], some[k][2]);
    }
    EXPECT_FALSE(sure_of(triangles_of(pentagon, some))) << choice;
  }
  EXPECT_FALSE(sure_of(triangles_of(pentagon, {{0, 1, 2}, {0, 1, 3}})));  // on one side of their edge
  Mesh quad = triangles_of(pentagon, {});
  quad.quads = {{NodeId{0}, NodeId{1}, NodeId{2}, NodeId{3}}};
  EXPECT_TRUE(sure_of(quad));
  std::reverse(quad.quads[0].begin(), quad.quads[0].end());
  EXPECT_FALSE(sure_of(quad));
}

TEST(OrientCells, JoinsNothingOverEdgesOfThreeCells) {
  Mesh mesh = triangles_of(pentagon, {{0, 2, 1}, {0, 2, 3}, {0, 4, 2}});
  EXPECT_EQ(orient_cells(mesh), 2);
  EXPECT_EQ(mesh.triangles, triangles_of(pentagon, {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}}).triangles);
  EXPECT_GT(faults_of(mesh, MeshRule::conforming), 0);
}

TEST(OrientCells, TakesCellsThatNameANodeTwice) {
  Mesh mesh = triangles_of(pentagon, {{0, 0, 0}, {0, 1, 1}, {0, 2, 1}});
  mesh.quads = {{NodeId{0}, NodeId{1}, NodeId{0}, NodeId{1}}, {NodeId{0}, NodeId{2}, NodeId{0}, NodeId{3}}};
  EXPECT_LE(orient_cells(mesh), 5);
  EXPECT_GT(faults_of(mesh, MeshRule::positive), 0);
}

}  // namespace
}  // namespace quadloop::io
