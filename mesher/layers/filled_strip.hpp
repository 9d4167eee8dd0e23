#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/layers/front/layer_strip.hpp"

namespace quadloop {

/// An edge of a strip's front, known to all ranks.
struct FrontEdge {
  std::array<GlobalNodeId, 2> nodes;
  std::array<Point, 2> points;
  std::int32_t rank = 0, leaf = 0;  ///< that own it
};

/// Reports a corner of a strip's front that is not a node of the mesh. Throws InputError.
[[noreturn]] void refuse_narrow(const LayerStrip& strip, Point corner);

/// One strip with the nodes on its front, the same on all ranks.
class FilledStrip {
 public:
  /// Throws InputError if a corner of the front is lost within a leaf that is wider than the layers.
  FilledStrip(const LayerStrip& strip, std::vector<FrontEdge> front);

  const LayerStrip& strip() const { return strip_; }
  const std::vector<FrontEdge>& front() const { return front_; }
  std::size_t columns() const { return strip_.columns.size(); }
  std::size_t rows() const { return strip_.columns[0].size() - 1; }
  /// The strip owns the column's nodes from row own_begin to before row own_end; of a wake's first column
  /// only the nodes on the base.
  std::size_t own_begin(std::size_t column) const { return is_root(column) ? strip_.layers + 1 : 0; }
  std::size_t own_end(std::size_t column) const {
    return is_root(column) ? std::max(own_begin(column), rows() - strip_.layers) : rows() + 1;
  }
  /// The strip's own nodes on the lines of the base's layers, numbered after those of the first column.
  std::size_t base_nodes() const { return strip_.base_lines.size() * base_nodes_of_line(); }
  std::size_t base_nodes_of_line() const {
    return strip_.base_lines.empty() ? 0 : strip_.base_lines[0].size() - 2;
  }
  std::size_t own_nodes(std::size_t column) const {
    return own_end(column) - own_begin(column) + (is_root(column) ? base_nodes() : 0);
  }
  /// Positions of the own nodes, in order.
  std::vector<Point> own_points(std::size_t column) const;
  bool is_root(std::size_t column) const { return strip_.root && column == 0; }
  /// The front edge after whose first node the column's nodes are numbered.
  std::int32_t anchor(std::size_t column) const { return anchor_[column]; }

  /// A node of the strip, given by column and row (counted from the right), or a node of the front.
  struct Corner {
    bool on_front = false;
    std::size_t column = 0, row = 0;  ///< for a node of the front, `column` is its number
  };
  struct Triangle {
    std::int32_t edge = 0;  ///< of the front, to whose leaf the triangle belongs
    std::array<Corner, 3> corners;
  };
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  std::size_t middle() const { return rows() / 2; }
  /// Before it all is reflected.
  std::size_t first_column() const { return strip_.across ? columns() / 2 : 0; }
  /// Whether its beginning is closed as its end is.
  bool begins_free() const { return !strip_.root && !strip_.across; }
  Point at(const Corner& c) const { return c.on_front ? nodes_[c.column] : strip_.columns[c.column][c.row]; }

  /// Splits the front's nodes into left and right sides and the parts that face the line's ends.
  void cut_at_ends();
  std::size_t facing(std::size_t from, std::size_t to, std::size_t column, bool left) const;
  std::size_t number_of(std::size_t corner) const;

  std::vector<Corner> inner_side(bool left) const;
  std::vector<Corner> outer_side(bool left) const;
  void zip(bool left);
  void close_ends();
  void add_triangle(std::int32_t edge, const Corner& a, const Corner& b, const Corner& c) {
    triangles_.push_back({edge, {a, b, c}});
  }
  std::size_t on_axis(std::size_t from, std::size_t to) const;
  void reflect();
  void anchor_columns();

  const LayerStrip& strip_;
  std::vector<FrontEdge> front_;
  std::vector<Point> nodes_;  ///< of the front, one more than edges
  /// Of the front's nodes the last one on the left and the first one on the right, at the end; of a free line
  /// the last one on the right and the first one on the left, at the beginning; of one across an axis those
  /// on the axis.
  std::size_t end_left_ = 0, end_right_ = 0, begin_right_ = 0, begin_left_ = 0;
  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> anchor_;
};

}  // namespace quadloop
