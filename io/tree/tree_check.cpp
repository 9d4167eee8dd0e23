#include "io/tree/tree_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/tree/tree_layout.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/morton.hpp"

namespace quadloop::io {

namespace {

constexpr const char* cure =
    "; the file is damaged: restore it from a copy, or generate it again with quadloop mesh";

std::string text_of(const LeafRecord& leaf) {
  return fmt::format("the leaf of tree ({}, {}) at ({}, {}), level {}", leaf.tree_x, leaf.tree_y, leaf.x,
                     leaf.y, leaf.level);
}

std::int64_t edge_of(const LeafRecord& leaf) { return std::int64_t{tree_grid_edge} >> leaf.level; }

/// Returns an error of a single leaf, as a format string; null if there is none.
const char* fault_of(const LeafRecord& leaf, const TreeAttributes& attributes) {
  const auto within = [](auto value, auto low, auto high) { return value >= low && value <= high; };
  if (!within(leaf.tree_x, 0, attributes.trees_x - 1) || !within(leaf.tree_y, 0, attributes.trees_y - 1))
    return "is in none of the trees";
  if (!within(leaf.level, 0, deepest_tree_level)) return "has an impossible level";
  const auto on_grid = [&](std::int32_t at) {
    return within(at, 0, tree_grid_edge - 1) && (at & (edge_of(leaf) - 1)) == 0;
  };
  if (!on_grid(leaf.x) || !on_grid(leaf.y)) return "is not on the grid of its level";
  if (!within(leaf.wanted, 0, leaf.level)) return "is coarser than its target level {wanted}";
  if ((std::uint64_t{leaf.adapted} >> leaf.level) != 0)
    return "has splits below itself ('adapted' is {adapted:#x})";
  if (leaf.block < 0 || leaf.triangles < 0 || leaf.quads < 0)
    return "has a mark or a number of cells below 0";
  if (leaf.block == 0 && leaf.triangles + std::int64_t{leaf.quads} > 0)
    return "is outside the domain, but has cells";
  return nullptr;
}

std::string text_of(const char* fault, const LeafRecord& leaf) {
  return text_of(leaf) + " " +
         fmt::format(fmt::runtime(fault), fmt::arg("wanted", leaf.wanted), fmt::arg("adapted", leaf.adapted));
}

/// Returns the position on the curve within a tree: interleaved bits of y and x.
std::int64_t curve_key(const LeafRecord& leaf) {
  return static_cast<std::int64_t>(
      morton_key(static_cast<std::uint32_t>(leaf.x), static_cast<std::uint32_t>(leaf.y)));
}

std::int64_t end_on_curve(const LeafRecord& leaf) { return curve_key(leaf) + edge_of(leaf) * edge_of(leaf); }

constexpr std::int64_t end_of_tree = std::int64_t{tree_grid_edge} * tree_grid_edge;

bool follows(const std::optional<LeafRecord>& before, const LeafRecord& leaf) {
  if (!before) return curve_key(leaf) == 0;
  const bool same_tree = before->tree_x == leaf.tree_x && before->tree_y == leaf.tree_y;
  if (same_tree) return curve_key(leaf) == end_on_curve(*before);
  return end_on_curve(*before) == end_of_tree && curve_key(leaf) == 0;
}

void require_sum(const Communicator& comm, std::int64_t own, std::int64_t wanted, const std::string& what,
                 const std::string& path) {
  const std::int64_t all = comm.sum(own);
  if (all != wanted)
    throw InputError(
        fmt::format("{}: its leaves have {} {}, but {} are declared{}", path, all, what, wanted, cure));
}

}  // namespace

void require_possible_attributes(const TreeAttributes& attributes, std::int64_t leaves,
                                 const std::string& path) {
  const auto refuse = [&](const std::string& what) { throw InputError(path + ": " + what + cure); };
  const auto& [root_x, root_y, tree_edge, trees_x, trees_y, gradation, geometry, of_case, nodes, triangles,
               quads, coordinates, root_far] = attributes;
  if (!std::isfinite(root_x) || !std::isfinite(root_y))
    refuse(fmt::format("its root lies at ({}, {})", root_x, root_y));
  if (!(tree_edge > 0) || !std::isfinite(tree_edge)) refuse(fmt::format("its tree edge is {}", tree_edge));
  const auto are_near = [](double a, double b, double side) {  // up to rounding
    return std::abs(a - b) <= 1e-9 * side + 1e-15 * (std::abs(a) + std::abs(b));
  };
  const Point end = Point{root_x, root_y} + Point{trees_x * tree_edge, trees_y * tree_edge};
  if (root_far &&
      !(are_near(root_far->x, end.x, end.x - root_x) && are_near(root_far->y, end.y, end.y - root_y)))
    refuse(fmt::format("its root ends at ({}, {}), but its trees at ({}, {})", root_far->x, root_far->y,
                       end.x, end.y));
  const bool enough =
      trees_x >= 1 && trees_y >= 1 && std::int64_t{trees_x} * trees_y <= leaves;  // each tree has a leaf
  if (!enough) refuse(fmt::format("it has {} by {} trees, but {} leaves", trees_x, trees_y, leaves));
  if (!(gradation > 1 && gradation <= 2))
    refuse(fmt::format("its gradation is {}, which must be above 1 and at most 2", gradation));
  if (nodes < 0 || triangles < 0 || quads < 0) refuse("it has a number of nodes or cells below 0");
}

void require_possible_flow(const MeasuredFlow& flow, const std::string& path) {
  const auto require_possible = [&](const char* what, Point from, Point to, double at_from, double at_to) {
    const bool finite = std::isfinite(from.x) && std::isfinite(from.y) && std::isfinite(to.x) &&
                        std::isfinite(to.y) && std::isfinite(at_from) && std::isfinite(at_to);
    if (!finite || at_from < 0 || at_to < 0)
      throw InputError(
          fmt::format("{}: the {} measured at ({}, {}) is impossible{}", path, what, from.x, from.y, cure));
  };
  for (const auto& [from, to, at_from, at_to] : flow.walls)
    require_possible("friction", from, to, at_from, at_to);
  for (const auto& [from, to, at_from, at_to] : flow.thickness)
    require_possible("thickness", from, to, at_from, at_to);
}

std::vector<std::vector<Point>> possible_wakes(const std::vector<Point>& points,
                                               const std::vector<std::int64_t>& sizes,
                                               const std::string& path) {
  std::vector<std::vector<Point>> wakes;
  std::size_t begin = 0;
  for (const std::int64_t size : sizes) {
    if (size < 2 || size > std::ssize(points) - static_cast<std::int64_t>(begin))
      throw InputError(path + ": the points of its wakes do not fit their numbers" + cure);
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(begin);
    wakes.emplace_back(first, first + size);
    begin += static_cast<std::size_t>(size);
  }
  if (begin != points.size())
    throw InputError(path + ": the points of its wakes do not fit their numbers" + cure);
  const auto is_finite = [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  for (const std::vector<Point>& wake : wakes) {
    if (!std::ranges::all_of(wake, is_finite) || std::ranges::adjacent_find(wake) != wake.end())
      throw InputError(fmt::format("{}: the wake from ({}, {}) has an impossible point{}", path, wake[0].x,
                                   wake[0].y, cure));
  }
  return wakes;
}

void require_possible_runs(const std::vector<BlockRun>& runs, const TreeAttributes& attributes,
                           const std::string& path) {
  if (runs.empty()) return;
  std::int64_t triangles = 0, quads = 0;
  bool possible = true;
  for (const BlockRun& run : runs) {
    possible = possible && (run.corners == 3 || run.corners == 4) && run.block >= 0 &&
               run.block < std::numeric_limits<std::int16_t>::max() && run.cells > 0 &&
               run.cells <= attributes.triangles + attributes.quads;
    if (possible) (run.corners == 3 ? triangles : quads) += run.cells;
  }
  if (!possible || triangles != attributes.triangles || quads != attributes.quads)
    throw InputError(path + ": the blocks of its cells do not fit their numbers" + cure);
}

void require_whole_tree(const Communicator& comm, const TreeRecord& tree,
                        const std::optional<LeafRecord>& before, const std::string& path) {
  std::int64_t begun = 0, ended = 0, triangles = 0, quads = 0;
  comm.together([&] {
    // reported by the rank that has the leaf
    if (before && fault_of(*before, tree.attributes) != nullptr) return;
    std::optional<LeafRecord> last = before;
    for (const LeafRecord& leaf : tree.leaves) {
      if (const char* const fault = fault_of(leaf, tree.attributes); fault != nullptr)
        throw InputError(path + ": " + text_of(fault, leaf) + cure);
      if (!follows(last, leaf))
        throw InputError(path + ": " + text_of(leaf) + " does not follow the one before it" + cure);
      begun += curve_key(leaf) == 0 ? 1 : 0;
      ended += end_on_curve(leaf) == end_of_tree ? 1 : 0;
      triangles += leaf.triangles;
      quads += leaf.quads;
      last = leaf;
    }
  });
  const std::int64_t trees = std::int64_t{tree.attributes.trees_x} * tree.attributes.trees_y;
  require_sum(comm, begun, trees, "trees", path);
  require_sum(comm, ended, trees, "whole trees", path);
  require_sum(comm, triangles, tree.attributes.triangles, "triangles", path);
  require_sum(comm, quads, tree.attributes.quads, "quadrilaterals", path);
}

}  // namespace quadloop::io
