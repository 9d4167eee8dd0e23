#include "mesher/layers/front/end_path.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop {

namespace {

constexpr double straight_sine = 1e-9;
constexpr double cosine_of_30 = 0.86602540378443865;  // 30 degrees

/// Whether two directions of any length differ by at most 30 degrees.
bool about_parallel(Point a, Point b) { return dot(a, b) >= cosine_of_30 * length(a) * length(b); }

}  // namespace

EndPath::EndPath(const Geometry& g, std::int32_t wall, bool first) : geometry_{&g}, first_{first} {
  const std::int32_t on = first ? g.previous(wall) : wall;
  is_curved_ = g.is_curved(on);
  const Point foot = g.point(wall), start = g.point(first ? on : g.next(on)) - foot,
              tangent = first ? -1.0 * g.direction_into(wall) : g.direction_out_of(wall);
  direction_ = (1 / quadloop::length(tangent)) * tangent;
  for (std::int32_t s = on; g.boundary_of(s) == g.boundary_of(on); s = first ? g.previous(s) : g.next(s)) {
    const std::int32_t near = first ? g.next(s) : s, vertex = first ? s : g.next(s);
    if (vertex == wall || (s != on && g.is_tip(near))) return;
    if (is_curved_) {
      const Point leaving = first ? -1.0 * g.direction_out_of(s) : g.direction_into(vertex);
      if (s != on && (g.kept(near) || !about_parallel(tangent, leaving))) return;
      pieces_.push_back({s, vertex, length() + quadloop::length(g.point(vertex) - g.point(near))});
    } else {
      const Point way = g.point(vertex) - foot;
      const double distance = quadloop::length(way);
      const double off = std::abs(cross(start, way)) / quadloop::length(start);
      if (g.is_curved(s) || off > straight_sine * distance) return;
      pieces_.push_back({s, vertex, distance});
    }
  }
}

EndPath::Place EndPath::place_at(double distance) const {
  const Geometry& g = *geometry_;
  const auto found = std::ranges::find_if(pieces_, [&](const Piece& p) { return distance <= p.distance; });
  const Piece& piece = found == pieces_.end() ? pieces_.back() : *found;
  const std::int32_t near = first_ ? g.next(piece.segment) : piece.segment;
  const Point from = g.point(near), to = g.point(piece.vertex);
  const double whole = quadloop::length(to - from), rest = std::max(0.0, piece.distance - distance);
  const Point on_chord =
      2 * rest > whole ? from + ((whole - rest) / whole) * (to - from) : to + (rest / whole) * (from - to);
  return {piece.segment, g.on_curve(piece.segment, on_chord)};
}

}  // namespace quadloop
