#include "mesher/layers/filled_interface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesher/base/error.hpp"
#include "mesher/layers/fan_rows.hpp"
#include "mesher/layers/layer_column.hpp"
#include "mesher/layers/zipper.hpp"

namespace quadloop {

namespace {

bool is_fan_place(const WallLine& line, std::int32_t i) {
  return line[i].shape == Station::Shape::fan && line.next(i) != WallLine::none && line.width(i) == 0;
}

/// The whole run of a station as one closed part.
InterfacePart closed_part(const WallLine& line, std::int32_t begin) {
  for (std::int32_t i = line.next(begin); i != begin; i = line.next(i)) {
    if (is_fan_place(line, i) && !is_fan_place(line, line.previous(i))) return {i, i, true};
  }
  return {begin, begin, true};
}

/// Sorts entries by their positions, each node once.
template <class Entry>
void sort_once(std::vector<Entry>& entries, std::vector<double>& positions) {
  std::vector<std::size_t> order(entries.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t k) { return std::pair(positions[k], entries[k].node); });
  std::vector<Entry> sorted;
  std::vector<double> sorted_positions;
  for (const std::size_t k : order) {
    if (!sorted.empty() && sorted.back().node == entries[k].node) continue;
    sorted.push_back(entries[k]);
    sorted_positions.push_back(positions[k]);
  }
  entries = std::move(sorted);
  positions = std::move(sorted_positions);
}

}  // namespace

std::vector<InterfacePart> interface_parts(const WallLine& line) {
  std::vector<InterfacePart> parts;
  std::vector<char> seen(line.size(), 0);
  const auto add = [&](InterfacePart part) {
    std::int32_t i = part.begin;
    do {
      seen[i] = 1;
      i = line.next(i);
    } while (i != part.begin && line.is_on_interface(i));
    if (!part.closed) part.end = i;
    parts.push_back(part);
  };
  for (std::int32_t i = 0; i < line.size(); ++i) {
    const std::int32_t before = line.previous(i);
    if (line.is_on_interface(i) && (before == WallLine::none || !line.is_on_interface(before)))
      add({i, i, false});
  }
  for (std::int32_t i = 0; i < line.size(); ++i) {
    if (line.is_on_interface(i) && !seen[i]) add(closed_part(line, i));
  }
  return parts;
}

void refuse_lost_foot(const LayerFront& front, std::int32_t station) {
  const Station& at = front.line[station];
  throw InputError(fmt::format(
      "boundary {}: near ({:.6g}, {:.6g}) a feature point of the layers between two blocks is no node of "
      "the mesh; reduce spacing.min",
      front.line.geometry().boundary(at.layers).name, at.wall.x, at.wall.y));
}

FilledInterface::FilledInterface(const LayerFront& front, const InterfacePart& part,
                                 std::vector<InterfaceFoot> feet, std::vector<FrontNode> tops)
    : front_{front},
      line_{front.line},
      part_{part},
      layers_{front.line.spec(part.begin).count},
      feet_{std::move(feet)},
      tops_{std::move(tops)} {
  if (feet_.empty() || tops_.empty()) refuse_lost_foot(front_, part_.begin);
  sort_by_position();
  if (part_.closed) {
    close();
  } else {
    for (const std::int32_t station : {part_.begin, part_.end}) refuse_fan_beside(station);
    const double last = line_.steps(part_.begin, part_.end);
    if (position_of_feet_.front() != 0 || position_of_tops_.front() != 0)
      refuse_lost_foot(front_, part_.begin);
    if (position_of_feet_.back() != last || position_of_tops_.back() != last)
      refuse_lost_foot(front_, part_.end);
  }
  add_columns();
}

/// A fan has the layers of one of the two boundaries that meet there, but its foot is the other block's.
void FilledInterface::refuse_fan_beside(std::int32_t station) const {
  if (!line_.is_beside_interface(station) || !is_fan({station})) return;
  const Station& at = line_[station];
  throw InputError(fmt::format(
      "boundary {}: at ({:.6g}, {:.6g}) layers turn by more than 120 degrees from a boundary between two "
      "blocks to another boundary; remove the layers of one of the two",
      line_.geometry().boundary(at.layers).name, at.wall.x, at.wall.y));
}

/// The number of stations from the beginning; that of a fan's first station for a foot in a fan.
double FilledInterface::position(const FrontPlace& place) const {
  return line_.steps(part_.begin, place.station) + place.share;
}

bool FilledInterface::is_fan(const FrontPlace& place) const {
  return place.at_station() && line_[place.station].shape == Station::Shape::fan;
}

FilledInterface::Fan FilledInterface::fan_at(std::int32_t station) const {
  Fan fan{station, station};
  while (line_.previous(fan.first) != WallLine::none && is_fan_place(line_, line_.previous(fan.first)))
    fan.first = line_.previous(fan.first);
  while (is_fan_place(line_, fan.last)) fan.last = line_.next(fan.last);
  return fan;
}

void FilledInterface::sort_by_position() {
  for (InterfaceFoot& foot : feet_) {
    if (is_fan(foot.place)) foot.place = {fan_at(foot.place.station).first};
    position_of_feet_.push_back(position(foot.place));
  }
  for (const FrontNode& top : tops_) position_of_tops_.push_back(position(top.place));
  sort_once(feet_, position_of_feet_);
  sort_once(tops_, position_of_tops_);
}

/// Repeats the first foot and the first node of the front at the end. Without a fan the first foot's column
/// is joined to the nearest node of the front.
void FilledInterface::close() {
  const std::int32_t before = line_.previous(part_.begin);
  const double around = line_.steps(part_.begin, before) + 1.0;
  if (!is_fan(feet_.front().place)) {
    const Point top = point_of_front(front_, feet_.front().place);
    const auto distance = [&](const FrontNode& node) { return length(node.point - top); };
    const auto nearest = std::ranges::min_element(tops_, {}, distance) - tops_.begin();
    const bool turns_back = position_of_tops_[nearest] > position_of_feet_.front() + around / 2;
    std::rotate(tops_.begin(), tops_.begin() + nearest, tops_.end());
    std::rotate(position_of_tops_.begin(), position_of_tops_.begin() + nearest, position_of_tops_.end());
    const std::ptrdiff_t passed = std::ssize(tops_) - nearest;
    for (std::ptrdiff_t k = 0; k < std::ssize(tops_); ++k) {
      if (turns_back && k < passed) position_of_tops_[k] -= around;
      if (!turns_back && k >= passed) position_of_tops_[k] += around;
    }
  }
  feet_.push_back(feet_.front());
  position_of_feet_.push_back(position_of_feet_.front() + around);
  tops_.push_back(tops_.front());
  position_of_tops_.push_back(position_of_tops_.front() + around);
}

/// The front's node at a station.
std::int32_t FilledInterface::top_at(std::int32_t station) const {
  const auto found = std::ranges::find(position_of_tops_, position({station}));
  if (found == position_of_tops_.end()) refuse_lost_foot(front_, station);
  return static_cast<std::int32_t>(found - position_of_tops_.begin());
}

/// The front's node nearest to a position, strictly between two others; the first of them if there is none.
std::int32_t FilledInterface::top_near(double position, std::int32_t from, std::int32_t to) const {
  std::int32_t nearest = from;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t k = from + 1; k < to; ++k) {
    const double distance = std::abs(position_of_tops_[k] - position);
    if (distance < least) nearest = k, least = distance;
  }
  return nearest;
}

std::int32_t FilledInterface::add_column(std::int32_t foot) {
  const InterfaceFoot& on = feet_[foot];
  Column column{foot, -1, false, 1, {}};
  const bool begins = !part_.closed && foot == 0,
             ends = !part_.closed && foot + 1 == static_cast<std::int32_t>(feet_.size());
  if ((begins && line_.is_beside_interface(part_.begin)) || (ends && line_.is_beside_interface(part_.end))) {
    column.is_walls = true;
    column.top = begins ? 0 : static_cast<std::int32_t>(tops_.size()) - 1;
    column.points = layer_column(front_, {begins ? part_.begin : part_.end}, tops_[column.top].point);
  } else {
    column.points = column_on_foot(front_, on.place, on.point);
  }
  column.points.erase(column.points.begin());
  columns_.push_back(std::move(column));
  return static_cast<std::int32_t>(columns_.size()) - 1;
}

void FilledInterface::add_columns() {
  const auto last = static_cast<std::int32_t>(feet_.size()) - 1;
  std::int32_t first_of_closed = -1;
  for (std::int32_t foot = 0; foot <= last; ++foot) {
    if (is_fan(feet_[foot].place)) {
      if (!part_.closed || foot < last) {
        if (foot > 0) items_.push_back({static_cast<std::int32_t>(columns_.size()), position_of_feet_[foot]});
        add_fan(foot);
      } else {
        items_.push_back({0, position_of_feet_[foot]});  // the fan's first ray again
        add_piece(static_cast<std::int32_t>(tops_.size()) - 1);
      }
      continue;
    }
    const bool again = part_.closed && foot == last;
    const std::int32_t column = again ? first_of_closed : add_column(foot);
    if (foot == 0) first_of_closed = column;
    items_.push_back({column, position_of_feet_[foot]});
  }
  if (items_.size() > 1) add_piece(static_cast<std::int32_t>(tops_.size()) - 1);
}

/// Adds the columns of a fan, one for each node of the front in it, and its cells. The columns before it end
/// at its first ray, and others begin at its last one.
void FilledInterface::add_fan(std::int32_t foot) {
  const Fan fan = fan_at(feet_[foot].place.station);
  const std::int32_t first = top_at(fan.first), last = top_at(fan.last),
                     first_column = static_cast<std::int32_t>(columns_.size());
  std::vector<Point> directions;
  for (std::int32_t top = first; top <= last; ++top)
    directions.push_back(unit(tops_[top].point - line_[fan.first].wall));
  const FanRows rows(directions, layers_);
  for (std::int32_t top = first; top <= last; ++top) {
    Column ray{foot, top, false, rows.lowest_ring(top - first), {}};
    const std::vector<Point> nodes = layer_column(front_, tops_[top].place, tops_[top].point);
    ray.points.assign(nodes.begin() + std::min<std::ptrdiff_t>(ray.lowest, std::ssize(nodes)), nodes.end());
    columns_.push_back(std::move(ray));
  }
  if (!items_.empty()) add_piece(first);
  for (std::int32_t top = first; top < last; ++top) {
    for (const FanRows::Cell& cell : rows.cells_after(top - first)) {
      Cell made{top, {}};
      for (const auto& [ray, ring] : cell) {
        if (ring == layers_)
          made.corners.push_back({true, first + ray, 0});
        else
          made.corners.push_back({false, first_column + ray, ring});
      }
      cells_.push_back(std::move(made));
    }
  }
  items_ = {{first_column + last - first, position({fan.last})}};
  first_top_ = last;
}

/// Joins the collected columns to the front's nodes up to `last_top`; the last column begins the next piece.
/// Every few columns one is joined to the nearest node of the front, so that the work is linear.
void FilledInterface::add_piece(std::int32_t last_top) {
  constexpr std::size_t columns_at_once = 32;
  std::size_t from = 0;
  std::int32_t top = first_top_;
  for (std::size_t to = columns_at_once; to + columns_at_once / 2 < items_.size(); to += columns_at_once) {
    const std::int32_t next = top_near(items_[to].position, top, last_top);
    if (next == top) break;
    zip(from, to, top, next);
    from = to;
    top = next;
  }
  zip(from, items_.size() - 1, top, last_top);
  items_.clear();
  first_top_ = last_top;
}

Point FilledInterface::at(const Corner& c) const {
  if (c.on_front) return tops_[c.number].point;
  const Column& column = columns_[c.number];
  return c.ring == 0 ? feet_[column.foot].point : column.points[c.ring - column.lowest];
}

/// Adds the cells between two columns, and between two nodes of the front.
void FilledInterface::zip(std::size_t from, std::size_t to, std::int32_t from_top, std::int32_t to_top) {
  std::vector<Corner> inner, outer;
  for (std::size_t k = from; k <= to; ++k) inner.push_back({false, items_[k].column, layers_ - 1});
  for (std::int32_t k = from_top; k <= to_top; ++k) outer.push_back({true, k, 0});
  std::vector<Point> first, second;
  for (const Corner& c : inner) first.push_back(at(c));
  for (const Corner& c : outer) second.push_back(at(c));
  for (const ZipperTriangle& t : zipper(first, second, true)) {
    const Corner a = inner[t.first], b = outer[t.second];
    const std::int32_t edge = from_top + std::min(t.second, std::max(to_top - from_top - 1, 0));
    if (t.on_first) {
      add_quads(a.number, inner[t.first + 1].number, edge);
      cells_.push_back({edge, {a, inner[t.first + 1], b}});
    } else {
      cells_.push_back({edge, {a, outer[t.second + 1], b}});
    }
  }
}

void FilledInterface::add_quads(std::int32_t a, std::int32_t b, std::int32_t edge) {
  for (int ring = 1; ring < layers_; ++ring)
    cells_.push_back(
        {edge, {{false, a, ring - 1}, {false, b, ring - 1}, {false, b, ring}, {false, a, ring}}});
}

}  // namespace quadloop
