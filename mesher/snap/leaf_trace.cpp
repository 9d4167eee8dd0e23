#include "mesher/snap/leaf_trace.hpp"

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/base/short_lists.hpp"

namespace quadloop {

namespace {

/// Numbers of a segment's crossings with the sides of the leaf: at most one inwards and one outwards.
struct Passage {
  std::int32_t entry = -1, exit = -1;
  bool followed = false;  ///< a piece has the segment
};

Point crossing_of_vertical(const Geometry& g, std::int32_t s, double x, double low, double high) {
  return {x, std::clamp(crossing_height(g.point(s), g.point(g.next(s)), x), low, high)};
}

Point crossing_of_horizontal(const Geometry& g, std::int32_t s, double y, double low, double high) {
  const Point a = g.point(s), b = g.point(g.next(s));
  return {std::clamp(crossing_height({a.y, a.x}, {b.y, b.x}, y), low, high), y};
}

/// Appends the crossings of one segment.
Passage find_passage(const ShiftedOutline& outline, std::int32_t s, const Box& box, std::int32_t first,
                     std::vector<Crossing>& crossings) {
  const Geometry& g = outline.geometry();
  const std::int32_t end = g.next(s);
  Passage passage;
  const auto add = [&](Side side, bool enters, Point position) {
    (enters ? passage.entry : passage.exit) = size32(crossings) - first;
    crossings.push_back({s, side, enters, position});
  };
  const auto crosses = [&](bool a_beyond, bool b_beyond, bool from_left, bool to_left) {
    return a_beyond != b_beyond && from_left != to_left;
  };
  const bool sw = outline.has_left(s, box.low), se = outline.has_left(s, {box.high.x, box.low.y});
  const bool ne = outline.has_left(s, box.high), nw = outline.has_left(s, {box.low.x, box.high.y});
  const bool above_low = outline.beyond_y(end, box.low.y), above_high = outline.beyond_y(end, box.high.y);
  const bool past_low = outline.beyond_x(end, box.low.x), past_high = outline.beyond_x(end, box.high.x);
  if (crosses(outline.beyond_y(s, box.low.y), above_low, sw, se)) {
    add(Side::bottom, above_low, crossing_of_horizontal(g, s, box.low.y, box.low.x, box.high.x));
  }
  if (crosses(outline.beyond_x(s, box.high.x), past_high, se, ne)) {
    add(Side::right, !past_high, crossing_of_vertical(g, s, box.high.x, box.low.y, box.high.y));
  }
  if (crosses(outline.beyond_y(s, box.high.y), above_high, ne, nw)) {
    add(Side::top, !above_high, crossing_of_horizontal(g, s, box.high.y, box.low.x, box.high.x));
  }
  if (crosses(outline.beyond_x(s, box.low.x), past_low, nw, sw)) {
    add(Side::left, past_low, crossing_of_vertical(g, s, box.low.x, box.low.y, box.high.y));
  }
  return passage;
}

/// Follows the outline from the segment at `start` to where it leaves the leaf or comes back; appends the
/// vertices on the way.
Piece follow(const Geometry& g, std::span<const std::int32_t> segments, std::span<Passage> passages,
             std::size_t start, std::int32_t first_vertex, std::vector<std::int32_t>& vertices) {
  Piece piece;
  piece.first_segment = segments[start];
  piece.entry = passages[start].entry;
  piece.vertices_begin = size32(vertices) - first_vertex;
  std::size_t at = start;
  while (true) {
    passages[at].followed = true;
    piece.exit = passages[at].exit;
    if (piece.exit >= 0) break;
    const std::int32_t vertex = g.next(segments[at]);
    vertices.push_back(vertex);
    const auto found = std::lower_bound(segments.begin(), segments.end(), vertex);
    QUADLOOP_REQUIRE(found != segments.end() && *found == vertex, "the outline ends inside a leaf");
    at = found - segments.begin();
    if (at == start) break;
  }
  piece.vertices_end = size32(vertices) - first_vertex;
  return piece;
}

}  // namespace

std::int32_t LeafTraces::add(const ShiftedOutline& outline, const Box& box,
                             std::span<const std::int32_t> segments) {
  begins_.push_back({box, size32(crossings_), size32(pieces_), size32(vertices_)});
  const std::int32_t first_crossing = size32(crossings_), first_vertex = size32(vertices_);
  ShortLists<512> lists;
  std::pmr::vector<Passage> passages(lists.memory());
  passages.reserve(segments.size());
  for (const std::int32_t s : segments)
    passages.push_back(find_passage(outline, s, box, first_crossing, crossings_));
  const auto add_piece = [&](std::size_t start) {
    pieces_.push_back(follow(outline.geometry(), segments, passages, start, first_vertex, vertices_));
  };
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (passages[i].entry >= 0) add_piece(i);
  }
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (!passages[i].followed) add_piece(i);
  }
  return size32(begins_) - 1;
}

LeafTrace LeafTraces::operator[](std::int32_t trace) const {
  const std::size_t i = trace;
  const Begin& begin = begins_[i];
  const bool last = i + 1 == begins_.size();
  const auto part = [&](const auto& all, std::int32_t Begin::*of) {
    return std::span(all).first(last ? size32(all) : begins_[i + 1].*of).subspan(begin.*of);
  };
  return {begin.box, part(crossings_, &Begin::crossings), part(pieces_, &Begin::pieces),
          part(vertices_, &Begin::vertices)};
}

void LeafTraces::clear() {
  begins_.clear();
  crossings_.clear();
  pieces_.clear();
  vertices_.clear();
}

}  // namespace quadloop
