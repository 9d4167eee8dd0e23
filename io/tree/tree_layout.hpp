#pragma once

#include <array>
#include <cstdint>

#include "mesher/mesh/tree_record.hpp"

namespace quadloop::io {

/// Format name and version in a saved tree.
inline constexpr const char* tree_format_name = "quadloop tree";
inline constexpr std::int32_t tree_format_version = 1;
/// Edge of a tree in integer coordinates, and the corresponding deepest level.
inline constexpr std::int32_t tree_grid_edge = std::int32_t{1} << 30;
inline constexpr int deepest_tree_level = 30;

/// Calls `visit(name, member reference)` for each numeric attribute, in file order.
template <class Attributes, class Visit>
void for_each_attribute(Attributes& attributes, const Visit& visit) {
  visit("root_x", attributes.root_x);
  visit("root_y", attributes.root_y);
  visit("tree_edge", attributes.tree_edge);
  visit("trees_x", attributes.trees_x);
  visit("trees_y", attributes.trees_y);
  visit("gradation", attributes.gradation);
  visit("geometry_digest", attributes.geometry_digest);
  visit("case_digest", attributes.case_digest);
  visit("nodes", attributes.nodes);
  visit("triangles", attributes.triangles);
  visit("quads", attributes.quads);
  visit("coordinate_digest", attributes.coordinate_digest);
}

/// Attributes of TreeAttributes::root_far; absent in files without it and in those of earlier versions.
inline constexpr std::array root_far_names{"root_far_x", "root_far_y"};

/// A dataset with one row of `columns` numbers of one type for each `Row`; absent in files without rows.
template <class Row_, class Number_, std::size_t columns_>
struct RowsDataset {
  using Row = Row_;
  using Number = Number_;
  static constexpr std::size_t columns = columns_;
  static_assert(sizeof(Row) == columns * sizeof(Number));
  const char* name;
};

/// Of MeasuredFlow::walls: x, y of the edge's ends, then wall units at both.
inline constexpr RowsDataset<MeasuredEdge, double, 6> measured_wall_rows{"measured_wall"};
/// Of MeasuredFlow::wakes: x and y of the points of all paths; the number of points of each.
inline constexpr RowsDataset<Point, double, 2> wake_point_rows{"wake_points"};
inline constexpr RowsDataset<std::int64_t, std::int64_t, 1> wake_size_rows{"wake_sizes"};
/// Of MeasuredFlow::thickness: x, y of the edge's ends, then the thickness at both.
inline constexpr RowsDataset<MeasuredThickness, double, 6> measured_thickness_rows{"measured_thickness"};
/// Of TreeRecord::block_runs: corners, block and number of cells.
inline constexpr RowsDataset<BlockRun, std::int64_t, 3> block_run_rows{"block_runs"};

/// Calls `visit(name, pointers to the members of a row)` for each dataset, in file order.
template <class Visit>
void for_each_tree_dataset(const Visit& visit) {
  visit("tree", std::array{&LeafRecord::tree_x, &LeafRecord::tree_y});
  visit("x", std::array{&LeafRecord::x});
  visit("y", std::array{&LeafRecord::y});
  visit("level", std::array{&LeafRecord::level});
  visit("wanted", std::array{&LeafRecord::wanted});
  visit("mark", std::array{&LeafRecord::block});
  visit("triangles", std::array{&LeafRecord::triangles});
  visit("quads", std::array{&LeafRecord::quads});
  visit("adapted", std::array{&LeafRecord::adapted});
}

}  // namespace quadloop::io
