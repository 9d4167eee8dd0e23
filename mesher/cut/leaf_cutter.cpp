#include <algorithm>

#include "mesher/cut/cut_leaf.hpp"

namespace quadloop {

namespace {

constexpr double stray_of_leaf = 0.5;   ///< how far the outline may lie from its chord, as a share of the leaf's edge
constexpr double stray_of_chord = 0.5;  ///< and as a share of the chord

std::array<Point, 4> corners_of(const Box& box) { return {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}; }

double distance_to_segment(Point p, Point a, Point b) {
  const Point ab = b - a, ap = p - a, bp = p - b;
  const double square = dot(ab, ab);
  if (square == 0) return length(ap);
  const double along = dot(ap, ab);
  if (along <= 0) return length(ap);
  if (along >= square) return length(bp);
  return std::abs(cross(ab, ap)) / std::sqrt(square);
}

}  // namespace

bool LeafCutter::cut(const Box& box, Point centre, unsigned hanging, std::span<const std::int32_t> segments, Detail detail) {
  trace_leaf(*outline_, box, segments, trace_);
  leaf_.nodes.clear();
  leaf_.outline.clear();
  leaf_.loop_nodes.clear();
  leaf_.loop_starts.assign(1, 0);
  leaf_.refined = false;
  edges_.clear();
  largest_stray_ = stray_of_leaf * box.width();
  gather_stops(centre, hanging);
  if (!walk_sides(centre)) return false;
  add_chords(detail);
  sort_inner_nodes();
  leaf_.simple = trace_.pieces.size() == 1 && leaf_.outline.size() == 1 && trace_.crossings.size() == 2 &&
                 trace_.crossings[0].side != trace_.crossings[1].side;
  if (!cancel_opposites() || !trace_loops(edges_, leaf_)) return false;
  return leaf_.simple || loops_are_sound(edges_, leaf_);
}

void LeafCutter::add_stop(int side, Point position, int place, std::int32_t crossing) {
  const std::array<Point, 4> corner = corners_of(trace_.box);
  const auto next = static_cast<std::size_t>((side + 1) % 4);
  if (position == corner[next]) side = static_cast<int>(next);
  const double along = side == 0 ? position.x : side == 1 ? position.y : side == 2 ? -position.x : -position.y;
  stops_.push_back({side, along, position, place, crossing});
}

/// Corners, hanging nodes and crossings in their order round the leaf.
void LeafCutter::gather_stops(Point centre, unsigned hanging) {
  stops_.clear();
  const Box& box = trace_.box;
  const std::array<Point, 4> corner = corners_of(box);
  const std::array<Point, 4> middle{Point{centre.x, box.low.y}, {box.high.x, centre.y}, {centre.x, box.high.y}, {box.low.x, centre.y}};
  for (int side = 0; side < 4; ++side) {
    const auto s = static_cast<std::size_t>(side);
    add_stop(side, corner[s], side, -1);
    if (((hanging >> side) & 1) != 0) add_stop(side, middle[s], 4 + side, -1);
  }
  for (std::size_t c = 0; c < trace_.crossings.size(); ++c) {
    const Crossing& crossing = trace_.crossings[c];
    add_stop(crossing.side, crossing.position, 8 + crossing.side, static_cast<std::int32_t>(c));
  }
  std::stable_sort(stops_.begin(), stops_.end(), [](const Stop& a, const Stop& b) {
    return a.side != b.side ? a.side < b.side : a.along != b.along ? a.along < b.along : a.place < b.place;
  });
  name_stops();
}

/// One node for all stops at one position: crossings at a corner are the corner.
void LeafCutter::name_stops() {
  stop_node_.clear();
  for (const Stop& stop : stops_) {
    if (leaf_.nodes.empty() || leaf_.nodes.back().position != stop.position) {
      int place = stop.place;
      if (place >= 8) place = 8 + stop.side;
      leaf_.nodes.push_back({stop.position, place});
    }
    stop_node_.push_back(static_cast<std::int32_t>(leaf_.nodes.size()) - 1);
  }
  leaf_.side_nodes = static_cast<std::int32_t>(leaf_.nodes.size());
}

/// Adds the parts of the sides that lie in the domain. Walking round the leaf, an outline that leaves it has the domain after it, one that
/// enters has it before. False where that does not come out even.
bool LeafCutter::walk_sides(Point centre) {
  std::vector<int> change(leaf_.nodes.size(), 0);
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    const std::int32_t c = stops_[i].crossing;
    if (c >= 0) change[static_cast<std::size_t>(stop_node_[i])] += trace_.crossings[static_cast<std::size_t>(c)].enters ? -1 : 1;
  }
  bool inside = false;
  if (!status_at_start(change, inside)) return false;
  int status = inside ? 1 : 0;
  leaf_.half_inside = 0;
  int side = 0;
  const std::int32_t count = leaf_.side_nodes;
  for (std::int32_t node = 0; node < count; ++node) {
    status += change[static_cast<std::size_t>(node)];
    if (status != 0 && status != 1) return false;
    const auto& at = leaf_.nodes[static_cast<std::size_t>(node)];
    if (at.place < 4) side = at.place;
    if (status == 0) continue;
    const std::int32_t next = (node + 1) % count;
    edges_.push_back({node, next, -1});
    const Point b = leaf_.nodes[static_cast<std::size_t>(next)].position;
    const bool by_x = side % 2 == 0, ascending = side < 2;
    const double middle = by_x ? centre.x : centre.y, from = by_x ? at.position.x : at.position.y, to = by_x ? b.x : b.y;
    const bool first = ascending ? from < middle : from > middle, second = ascending ? to > middle : to < middle;
    leaf_.half_inside = static_cast<std::uint8_t>(leaf_.half_inside | (first << (2 * side)) | (second << (2 * side + 1)));
  }
  return true;
}

/// Whether the domain lies just before the first stop (counter-clockwise).
bool LeafCutter::status_at_start(const std::vector<int>& change, bool& inside) const {
  const auto first = std::find_if(change.begin(), change.end(), [](int c) { return c != 0; });
  if (first != change.end()) {
    inside = *first < 0;
    return *first == 1 || *first == -1;
  }
  inside = inside_->contains(trace_.box.low);
  return true;
}

std::int32_t LeafCutter::node_at(Point position) {
  for (std::size_t i = 0; i < leaf_.nodes.size(); ++i) {
    if (leaf_.nodes[i].position == position) return static_cast<std::int32_t>(i);
  }
  leaf_.nodes.push_back({position, 12});
  return static_cast<std::int32_t>(leaf_.nodes.size()) - 1;
}

void LeafCutter::add_chords(Detail detail) {
  for (const Piece& piece : trace_.pieces) add_chord_run(piece, trace_.vertices_of(piece), detail);
}

/// The chords for one piece: from its entry over the kept points to its exit, one boundary each.
void LeafCutter::add_chord_run(const Piece& piece, std::span<const std::int32_t> vertices, Detail detail) {
  const Geometry& g = outline_->geometry();
  const bool closed = piece.entry < 0;
  std::vector<Point> points;
  std::vector<std::int32_t> segments;  // that begins at each point
  if (!closed) {
    points.push_back(trace_.crossings[static_cast<std::size_t>(piece.entry)].position);
    segments.push_back(piece.first_segment);
  }
  for (const std::int32_t v : vertices) {
    points.push_back(g.point(v));
    segments.push_back(v);
  }
  points.push_back(closed ? points.front() : trace_.crossings[static_cast<std::size_t>(piece.exit)].position);
  std::vector<char> keep(points.size(), closed || detail == Detail::full ? 1 : 0);
  keep.front() = keep.back() = 1;
  if (closed) leaf_.refined = true;
  if (!closed && detail == Detail::merged) {
    std::size_t from = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (i + 1 < points.size() && !g.kept(vertices[i - 1])) continue;
      keep[i] = 1;
      keep_strays(points, from, i, keep);
      from = i;
    }
  }
  std::size_t from = 0;
  std::int32_t from_node = node_at(points[0]);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (keep[i] == 0) continue;
    const std::int32_t to_node = node_at(points[i]);
    if (from_node != to_node) leaf_.outline.push_back({from_node, to_node, segments[from]});
    from = i;
    from_node = to_node;
  }
}

/// Keeps the points between two kept ones from which the chord would stray too far (the rule of Douglas and Peucker 1973).
void LeafCutter::keep_strays(std::span<const Point> points, std::size_t from, std::size_t to, std::vector<char>& keep) {
  if (to - from < 2) return;
  const Point a = points[from], b = points[to];
  std::size_t farthest = from;
  double stray = std::min(largest_stray_, stray_of_chord * length(b - a));
  for (std::size_t i = from + 1; i < to; ++i) {
    const double distance = distance_to_segment(points[i], a, b);
    if (distance <= stray) continue;
    stray = distance;
    farthest = i;
  }
  if (farthest == from) return;
  keep[farthest] = 1;
  leaf_.refined = true;
  keep_strays(points, from, farthest, keep);
  keep_strays(points, farthest, to, keep);
}

/// The order of the nodes inside must not depend on the order in which boundaries are listed.
void LeafCutter::sort_inner_nodes() {
  const auto first = static_cast<std::size_t>(leaf_.side_nodes);
  if (leaf_.nodes.size() <= first + 1) return;
  std::vector<std::int32_t> order;
  for (std::size_t i = first; i < leaf_.nodes.size(); ++i) order.push_back(static_cast<std::int32_t>(i));
  const auto position = [&](std::int32_t i) { return leaf_.nodes[static_cast<std::size_t>(i)].position; };
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return position(a) < position(b); });
  std::vector<std::int32_t> renamed(leaf_.nodes.size());
  for (std::size_t i = 0; i < first; ++i) renamed[i] = static_cast<std::int32_t>(i);
  std::vector<CutLeaf::Node> sorted;
  for (std::size_t i = 0; i < order.size(); ++i) {
    renamed[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(first + i);
    sorted.push_back(leaf_.nodes[static_cast<std::size_t>(order[i])]);
  }
  std::copy(sorted.begin(), sorted.end(), leaf_.nodes.begin() + static_cast<std::ptrdiff_t>(first));
  for (auto& edge : leaf_.outline) {
    edge.from = renamed[static_cast<std::size_t>(edge.from)];
    edge.to = renamed[static_cast<std::size_t>(edge.to)];
  }
}

/// A chord along a side of the leaf, against the sense of the side, leaves nothing between the two: neither bounds a cell here. Two chords
/// against each other would swallow what lies between: false.
bool LeafCutter::cancel_opposites() {
  const std::size_t sides = edges_.size();
  for (const CutLeaf::Edge& chord : leaf_.outline) {
    for (const CutLeaf::Edge& other : leaf_.outline) {
      if (chord.from == other.to && chord.to == other.from) return false;
    }
    bool cancelled = false;
    for (std::size_t i = 0; i < sides && !cancelled; ++i) {
      if (edges_[i].from == chord.from && edges_[i].to == chord.to) return false;
      cancelled = edges_[i].from == chord.to && edges_[i].to == chord.from;
      if (cancelled) edges_[i].from = edges_[i].to = -1;
    }
    if (!cancelled) edges_.push_back(chord);
  }
  std::erase_if(edges_, [](const CutLeaf::Edge& e) { return e.from < 0; });
  return true;
}

}  // namespace quadloop
