#include "mesher/layers/filled_strip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "mesher/base/error.hpp"
#include "mesher/layers/zipper.hpp"
#include "mesher/mesh/mirror_images.hpp"

namespace quadloop {

void refuse_narrow(const LayerStrip& strip, Point corner) {
  const double width = length(strip.columns[0].back() - strip.columns[0].front());
  throw InputError(
      fmt::format("{}{}: its layers are {:.3g} wide and end within one cell near ({:.6g}, {:.6g}); reduce "
                  "spacing.min below that, or use thicker layers",
                  strip.place, strip.name, width, corner.x, corner.y));
}

FilledStrip::FilledStrip(const LayerStrip& strip, std::vector<FrontEdge> front)
    : strip_{strip}, front_{std::move(front)} {
  for (const FrontEdge& edge : front_) nodes_.push_back(edge.points[0]);
  if (!front_.empty()) nodes_.push_back(front_.back().points[1]);
  cut_at_ends();
  zip(true);
  zip(false);
  close_ends();
  if (strip_.across) reflect();
  anchor_columns();
}

std::vector<Point> FilledStrip::own_points(std::size_t column) const {
  const std::vector<Point>& across = strip_.columns[column];
  std::vector<Point> points(across.begin() + own_begin(column), across.begin() + own_end(column));
  if (!is_root(column)) return points;
  for (const std::vector<Point>& line : strip_.base_lines)
    points.insert(points.end(), line.begin() + 1, line.end() - 1);
  return points;
}

std::size_t FilledStrip::number_of(std::size_t corner) const {
  const Point place = strip_.front[strip_.corners[corner]];
  const auto found = std::ranges::find(nodes_, place);
  if (found == nodes_.end()) refuse_narrow(strip_, place);
  return found - nodes_.begin();
}

/// The last node on one side of the line, among the nodes between two corners that face an end.
std::size_t FilledStrip::facing(std::size_t from, std::size_t to, std::size_t column, bool left) const {
  const std::vector<Point>& across = strip_.columns[column];
  const Point middle_of = across[middle()], axis = across.back() - across.front();
  std::size_t found = from;
  for (std::size_t k = from; k != to; from < to ? ++k : --k) {
    const double side = dot(nodes_[k] - middle_of, axis);
    if (left ? side >= 0 : side <= 0) found = k;
  }
  return found;
}

void FilledStrip::cut_at_ends() {
  const std::size_t last = columns() - 1, left = number_of(0), right = number_of(1);
  end_left_ = facing(left, right, last, true);
  end_right_ = facing(right, left, last, false);
  if (strip_.root) return;
  if (strip_.across) {
    begin_left_ = on_axis(left, 0);
    begin_right_ = on_axis(right, nodes_.size());
    return;
  }
  begin_right_ = facing(number_of(2), nodes_.size() - 1, 0, false);
  begin_left_ = facing(nodes_.size() - 1, number_of(2), 0, true);
}

/// The boundary of the strip's rows on one side, from the beginning to the middle of the end.
std::vector<FilledStrip::Corner> FilledStrip::inner_side(bool left) const {
  const auto row = [&](std::size_t from_middle) {
    return left ? middle() + from_middle : middle() - from_middle;
  };
  std::vector<Corner> side;
  for (std::size_t r = 0; begins_free() && r < middle(); ++r) side.push_back({false, 0, row(r)});
  for (std::size_t k = first_column(); k < columns(); ++k) side.push_back({false, k, row(middle())});
  for (std::size_t r = middle(); r > 0; --r) side.push_back({false, columns() - 1, row(r - 1)});
  return side;
}

/// The front's nodes on one side, in the same direction.
std::vector<FilledStrip::Corner> FilledStrip::outer_side(bool left) const {
  std::vector<Corner> side;
  if (left) {
    for (std::size_t k = begin_left_; begins_free() && k + 1 < nodes_.size(); ++k)
      side.push_back({true, k, 0});
    for (std::size_t k = strip_.across ? begin_left_ : 0; k <= end_left_; ++k) side.push_back({true, k, 0});
  } else {
    for (std::size_t k = strip_.root ? nodes_.size() - 1 : begin_right_; k >= end_right_; --k)
      side.push_back({true, k, 0});
  }
  return side;
}

void FilledStrip::zip(bool left) {
  const std::vector<Corner> inner = inner_side(left), outer = outer_side(left);
  std::vector<Point> first, second;
  for (const Corner& c : inner) first.push_back(at(c));
  for (const Corner& c : outer) second.push_back(at(c));
  const auto edges = static_cast<std::int32_t>(front_.size());
  for (const ZipperTriangle& t : zipper(first, second, left)) {
    const Corner a = inner[t.first], b = outer[t.second];
    const auto node = static_cast<std::int32_t>(b.column);
    const Corner c = t.on_first ? inner[t.first + 1] : outer[t.second + 1];
    const std::int32_t other = t.on_first ? node : static_cast<std::int32_t>(c.column);
    const std::int32_t edge = std::min(left || t.on_first ? node : other, edges - 1);
    add_triangle(edge, a, left ? c : b, left ? b : c);
  }
}

/// Adds triangles between the two sides where the front has edges that face an end.
void FilledStrip::close_ends() {
  for (std::size_t k = end_left_; k < end_right_; ++k)
    add_triangle(static_cast<std::int32_t>(k), {false, columns() - 1, middle()}, {true, k + 1, 0},
                 {true, k, 0});
  if (!begins_free()) return;
  for (std::size_t k = begin_right_; k < begin_left_; ++k)
    add_triangle(static_cast<std::int32_t>(k), {false, 0, middle()}, {true, k + 1, 0}, {true, k, 0});
}

/// The front's node on the axis, of those from one to before another.
std::size_t FilledStrip::on_axis(std::size_t from, std::size_t to) const {
  for (std::size_t k = from; k != to; from < to ? ++k : --k) {
    if (side_of(*strip_.across, nodes_[k]) == 0) return k;
  }
  refuse_without_image(*strip_.across, "node", nodes_[from]);
}

/// The images of all triangles as well.
void FilledStrip::reflect() {
  std::map<Point, std::size_t> node_at;
  for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) node_at.emplace(nodes_[k], k);
  const auto image_of_node = [&](std::size_t k) {
    const auto found = node_at.find(image_of(*strip_.across, nodes_[k]));
    if (found == node_at.end()) refuse_without_image(*strip_.across, "node", nodes_[k]);
    return found->second;
  };
  const auto image = [&](const Corner& c) {
    return c.on_front ? Corner{true, image_of_node(c.column), 0}
                      : Corner{false, columns() - 1 - c.column, c.row};
  };
  const std::vector<Triangle> built = triangles_;
  for (const auto& [edge, corners] : built)
    add_triangle(static_cast<std::int32_t>(image_of_node(edge + 1)), image(corners[0]), image(corners[2]),
                 image(corners[1]));
}

/// Each column with the first triangle on the left that has its last node.
void FilledStrip::anchor_columns() {
  constexpr std::int32_t none = -1;
  anchor_.assign(columns(), none);
  if (strip_.root) anchor_[0] = 0;
  for (const Triangle& t : triangles_) {
    for (const Corner& c : t.corners) {
      if (!c.on_front && c.row == rows() && anchor_[c.column] == none) anchor_[c.column] = t.edge;
    }
  }
}

}  // namespace quadloop
