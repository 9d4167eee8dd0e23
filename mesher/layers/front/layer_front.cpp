#include "mesher/layers/front/layer_front.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "mesher/base/error.hpp"
#include "mesher/geometry/curve_parts.hpp"
#include "mesher/layers/front/adapted_thickness.hpp"
#include "mesher/layers/front/followed_layers.hpp"
#include "mesher/layers/front/strip_room.hpp"
#include "mesher/layers/front/thickness.hpp"
#include "mesher/layers/front/wake_room.hpp"

namespace quadloop {

namespace {

constexpr double sine_of_sector = 0.3;  // columns of a fan are at least about 18 degrees apart

/// The segments of blunt edges (bases) at which wakes begin.
std::vector<std::int32_t> bases_of(const Geometry& g, const std::vector<PlacedLine>& lines) {
  std::vector<std::int32_t> bases;
  for (const PlacedLine& line : lines) {
    for (std::int32_t s = line.edge; s != line.base_end; s = g.next(s)) bases.push_back(s);
  }
  return bases;
}

/// The points of the base at which a wake begins; empty at a sharp edge.
std::vector<Point> base_of(const Geometry& g, const PlacedLine& wake) {
  std::vector<Point> base;
  for (std::int32_t v = wake.edge; v != wake.base_end; v = g.next(v)) base.push_back(g.point(v));
  if (!base.empty()) base.push_back(g.point(wake.base_end));
  return base;
}

/// Builds the geometry outside the layers.
class OuterOutline {
 public:
  OuterOutline(const WallLine& line, const FittingColumns& fitting, const std::vector<PlacedLine>& lines,
               const WakeRoom& room, std::optional<double> curvature, bool mirrored,
               const AdaptedSize& adapted)
      : line_{line},
        g_{line.geometry()},
        lines_{lines},
        room_{room},
        fitting_{fitting},
        curvature_{curvature},
        mirrored_{mirrored},
        adapted_{adapted},
        first_of_segment_(g_.points().size(), WallLine::none),
        covered_(g_.points().size(), 0),
        is_base_(g_.points().size(), 0) {
    for (const std::int32_t s : bases_of(g_, lines_)) is_base_[s] = 1;
    for (const PlacedLine& l : lines_) {
      if (l.edge != PlacedLine::nowhere) wake_from_.emplace(l.edge, &l);
    }
    cover_ends();
    for (std::int32_t i = line_.size() - 1; i >= 0; --i) {
      if (begins(i)) first_of_segment_[line_[i].segment] = i;
    }
  }

  void build(LayerFront& into) {
    for (std::int32_t loop = 0; loop < g_.loop_count(); ++loop) {
      for (std::int32_t v = g_.loop_start(loop); v < g_.loop_start(loop + 1); ++v) add_segment(v);
      builder_.end_loop(g_.block_of(g_.loop_start(loop)));
    }
    for (const PlacedLine& line : lines_) {
      if (line.edge == PlacedLine::nowhere) add_free_strip(line);
    }
    std::vector<Boundary> boundaries(g_.boundaries().begin(), g_.boundaries().end());
    if (!strips_.empty()) boundaries.push_back({.name = "wakes and free lines", .corner_degrees = 180});
    if (on_interfaces_) boundaries.push_back({.name = "layers between blocks", .corner_degrees = 180});
    QUADLOOP_REQUIRE(strips_.empty() || !on_interfaces_, "layers of lines, or of several blocks");
    into.on_interfaces = on_interfaces_;
    into.strips = std::move(strips_);
    into.outer = std::move(builder_)
                     .geometry(std::move(boundaries), g_.block_names())
                     .with({std::move(spacing_), std::move(kept_), std::move(bend_)});
    for (const std::int32_t i : station_of_)
      into.last_heights.push_back(i == WallLine::none ? 0 : (last_layer(i) + last_layer(line_.next(i))) / 2);
    into.station_of = std::move(station_of_);
  }

 private:
  /// Whether a wall segment follows the station.
  bool begins(std::int32_t i) const { return line_.next(i) != WallLine::none; }
  /// The boundary that is added for fronts of strips, or for those on interfaces.
  BoundaryId strip_boundary() const { return BoundaryId{size32(g_.boundaries())}; }
  bool ends_run(std::int32_t i) const { return line_[i].shape == Station::Shape::end; }

  void add_segment(std::int32_t s) {
    if (const std::int32_t first = first_of_segment_[s]; first != WallLine::none) {
      add_front(first, s);
    } else if (stays(s)) {
      add_vertex(g_.point(s), g_.boundary_of(s), WallLine::none,
                 std::min(g_.spacing_of(s), spacing_across(s)), g_.kept(s), bend_of(s), rest_of(s),
                 g_.returns(s));
    }
  }
  /// Whether vertex s of the geometry is one of the outer geometry.
  bool stays(std::int32_t s) const {
    return first_of_segment_[s] == WallLine::none && !begins_below(s) && !is_base(s) && !covered_[s];
  }
  void cover_ends();
  Curve rest_of(std::int32_t s) const;
  double bend_of(std::int32_t s) const;
  std::int32_t segment_of_end(std::int32_t i) const;
  void add_front(std::int32_t first, std::int32_t s);
  void add_wake(std::int32_t i);
  /// The station on the right of a wake's root.
  std::int32_t first_at(const PlacedLine& wake) const {
    const std::int32_t first = first_of_segment_[wake.base_end];
    return line_[first].opens_wake ? line_.next(first) : first;
  }
  bool is_base(std::int32_t s) const { return is_base_[s] != 0; }
  void add_free_strip(const PlacedLine& line);
  void add_front_of(const LayerStrip& strip);
  void add_vertex(Point p, BoundaryId boundary, std::int32_t station, double spacing, bool kept, double bend,
                  const Curve& curve = {}, bool returns = false) {
    builder_.add(p, boundary, curve, returns);
    station_of_.push_back(station);
    spacing_.push_back(spacing);
    kept_.push_back(kept ? 1 : 0);
    bend_.push_back(bend);
  }
  bool begins_below(std::int32_t s) const;
  double spacing_across(std::int32_t s) const;
  double spacing_after(std::int32_t i) const;
  double spread(std::int32_t i, bool turned) const;
  double front_width(std::int32_t i) const {
    return line_.width(i) == 0 ? 0 : length(fitting_.front[line_.next(i)] - fitting_.front[i]);
  }
  double spacing_of_turns(std::int32_t i) const;
  double last_layer(std::int32_t i) const;

  const WallLine& line_;
  const Geometry& g_;
  const std::vector<PlacedLine>& lines_;
  const WakeRoom& room_;
  const FittingColumns& fitting_;
  std::optional<double> curvature_;
  bool mirrored_;
  const AdaptedSize& adapted_;
  std::vector<std::int32_t> first_of_segment_;
  std::vector<char> covered_;  ///< flags of vertices on which a run's last column lies
  /// By segment: where its rest begins and ends, if the last column of a run lies on the part before or
  /// after.
  std::map<std::int32_t, Point> cut_begins_, cut_ends_;
  std::map<std::int32_t, const PlacedLine*> wake_from_;  ///< by the vertex of its edge
  std::vector<char> is_base_;                            ///< flags of segments: a wake begins there
  GeometryBuilder builder_;
  std::vector<std::int32_t> station_of_;
  std::vector<double> spacing_;
  std::vector<char> kept_;
  std::vector<double> bend_;
  std::vector<LayerStrip> strips_;
  bool on_interfaces_ = false;
};

void OuterOutline::cover_ends() {
  for (std::int32_t i = 0; i < line_.size(); ++i) {
    if (!ends_run(i) || line_[i].at_wake) continue;
    const EndPath& path = line_.end_path(i);
    const double column =
        path.is_curved() ? fitting_.columns.length[i] : length(fitting_.front[i] - line_[i].wall);
    for (const EndPath::Piece& piece : path.pieces()) {
      if (piece.distance <= column) covered_[piece.vertex] = 1;
    }
    if (!path.is_curved()) continue;
    const EndPath::Place place = path.place_at(column);
    (line_.previous(i) == WallLine::none ? cut_ends_ : cut_begins_).emplace(place.segment, place.point);
  }
}

/// The shape of a segment, without its parts on which last columns lie. It is straight if its end is not in
/// the outer geometry for another reason.
Curve OuterOutline::rest_of(std::int32_t s) const {
  const auto begin = cut_begins_.find(s), end = cut_ends_.find(s);
  if (!g_.is_curved(s) || (end == cut_ends_.end() && !stays(g_.next(s)))) return {};
  CurvedSegment rest = g_.segment(s);
  if (begin != cut_begins_.end()) rest = parts_at(rest, begin->second).second;
  if (end != cut_ends_.end()) rest = parts_at(rest, end->second).first;
  return rest.curve;
}

/// The turn at a vertex. Where a last column covers a part of one of its segments, the turn of the rest is
/// smaller in proportion.
double OuterOutline::bend_of(std::int32_t s) const {
  const std::int32_t before = g_.previous(s), next = g_.next(s);
  const auto begin = cut_begins_.find(before), end = cut_ends_.find(s);
  const double in = length(g_.point(s) - g_.point(before)), out = length(g_.point(next) - g_.point(s));
  const double left_in = begin == cut_begins_.end() ? in : length(g_.point(s) - begin->second),
               left_out = end == cut_ends_.end() ? out : length(end->second - g_.point(s));
  return left_in + left_out == in + out ? g_.bend_degrees(s)
                                        : g_.bend_degrees(s) * (left_in + left_out) / (in + out);
}

/// The segment of the geometry on which the last column of a run ends.
std::int32_t OuterOutline::segment_of_end(std::int32_t i) const {
  if (line_.ends_on_curve(i)) return line_.end_path(i).place_at(fitting_.columns.length[i]).segment;
  return g_.next(line_[i].segment);
}

/// Adds the stations of segment s from `first` on; where the run ends, also the rest of the boundary on which
/// it ends.
void OuterOutline::add_front(std::int32_t first, std::int32_t s) {
  std::int32_t i = first;
  const bool on_interface = line_.is_interface(s);
  on_interfaces_ = on_interfaces_ || on_interface;
  for (; i != WallLine::none && begins(i) && line_[i].segment == s; i = line_.next(i)) {
    if (line_[i].opens_wake)
      add_wake(i);
    else
      add_vertex(fitting_.front[i], on_interface ? strip_boundary() : g_.boundary_of(s), i, spacing_after(i),
                 line_[i].kept, 0);
  }
  if (i == WallLine::none || line_[i].segment != s) return;
  if (line_[i].opens_wake) return add_wake(i);
  const std::int32_t on = segment_of_end(i);
  add_vertex(fitting_.front[i], g_.boundary_of(on), WallLine::none, g_.spacing_of(on), true, 0, rest_of(on),
             g_.returns(on));
}

/// Adds a wake's front, from the column on its left to the column on its right.
void OuterOutline::add_wake(std::int32_t i) {
  const std::int32_t edge = ends_run(i) ? g_.next(line_[i].segment) : line_[i].segment;
  const PlacedLine* const at = wake_from_.at(edge);
  const std::int32_t before = line_.previous(i), right = first_at(*at);
  const double at_corner = g_.corner_spacing_of(at->edge);
  double spacing = std::min(spacing_after(before), spacing_after(right));
  if (at_corner > 0) spacing = std::min(spacing, at_corner);
  PlacedLine wake = *at;
  wake.layers = line_.spec(i).first < line_.spec(right).first ? line_.spec(i) : line_.spec(right);
  strips_.push_back(layer_strip(wake,
                                WakeRoot{i, fitting_.front[i], fitting_.front[right], base_of(g_, *at),
                                         spacing, g_.boundary_of(at->edge)},
                                adapted_, room_.around(*at)));
  add_vertex(fitting_.front[i], strip_boundary(), WallLine::none, strips_.back().spacing[0], true, 0);
  add_front_of(strips_.back());
}

void OuterOutline::add_free_strip(const PlacedLine& line) {
  strips_.push_back(layer_strip(line, {}, adapted_));
  add_front_of(strips_.back());
  builder_.end_loop();
}

void OuterOutline::add_front_of(const LayerStrip& strip) {
  const std::size_t ahead = strip.root ? 1 : 0;
  for (std::size_t k = 0; k < strip.front.size(); ++k) {
    const auto corners = std::span(strip.corners).first(strip.root ? 2 : 4);
    const bool kept = std::ranges::find(corners, k) != corners.end();
    add_vertex(strip.front[k], strip_boundary(), WallLine::none, strip.spacing[k + ahead], kept, 0);
  }
}

/// Whether a segment of a boundary without layers begins at the end of a wall with layers.
bool OuterOutline::begins_below(std::int32_t s) const {
  return first_of_segment_[g_.previous(s)] != WallLine::none;
}

double OuterOutline::last_layer(std::int32_t i) const {
  const LayerSpec& spec = line_.spec(i);
  const ColumnHeights column = column_heights(spec, spec.first, fitting_.thickness[i]);
  return column.reached[spec.count] - column.reached[spec.count - 1];
}

/// The column width that the turning of the wall between a station and the next requires; each turn counts as
/// spread over half of either side. (The front's own turns are not used, as they depend on how columns spread
/// or converge.)
double OuterOutline::spacing_of_turns(std::int32_t i) const {
  const std::int32_t s = line_[i].segment, next = g_.next(s);
  double spacing = std::numeric_limits<double>::infinity();
  if (!curvature_) return spacing;
  for (const std::int32_t v : {s, next}) {
    const double around =
        (length(g_.point(v) - g_.point(g_.previous(v))) + length(g_.point(g_.next(v)) - g_.point(v))) / 2;
    if (g_.bend_degrees(v) > 0) spacing = std::min(spacing, *curvature_ / g_.bend_degrees(v) * around);
  }
  return spacing;
}

/// The width of the front over that of the wall around the place after a station, over half a thickness: up
/// to the last station within reach on one side, past it on the other; `turned`: the other way round.
double OuterOutline::spread(std::int32_t i, bool turned) const {
  const std::int32_t next = line_.next(i);
  const double reach = fitting_.thickness[turned ? next : i] / 4, past = line_.width(i) + reach;
  double wall = line_.width(i), front = front_width(i);
  const auto add = [&](std::int32_t j) {
    if (j == WallLine::none || line_.next(j) == WallLine::none) return;
    wall += line_.width(j);
    front += front_width(j);
  };
  const auto add_after = [&](std::int32_t j, double) { add(j); };
  const auto add_before = [&](std::int32_t j, double) { add(line_.previous(j)); };
  if (turned) {
    line_.walk_back(next, past, add_before);
    line_.walk_on(next, reach, add_before);
  } else {
    line_.walk_on(i, past, add_after);
    line_.walk_back(i, reach, add_after);
  }
  return front / wall;
}

/// The spacing of the front on the other side of an interface without layers on this side: one row of
/// triangles joins both.
double OuterOutline::spacing_across(std::int32_t s) const {
  double spacing = std::numeric_limits<double>::infinity();
  const std::int32_t across = g_.twin(s);
  if (across < 0 || !line_.has_layers(across)) return spacing;
  for (std::int32_t i = first_of_segment_[across];
       i != WallLine::none && begins(i) && line_[i].segment == across; i = line_.next(i))
    spacing = std::min(spacing, spacing_after(i));
  return spacing;
}

double OuterOutline::spacing_after(std::int32_t i) const {
  const std::int32_t j = line_.next(i);
  const double spacing = leaf_over_last_layer * std::min(last_layer(i), last_layer(j));
  if (line_.width(i) == 0) return std::max(spacing, sine_of_sector * fitting_.thickness[i]);
  const double wider =
      mirrored_ ? std::min(spread(i, false), spread(i, true)) : spread(i, false);  // as of the image
  return std::min(
      {spacing, g_.spacing_of(line_[i].segment) * std::min(1.0, wider), spacing_of_turns(i) * wider});
}

WallLine wall_line(const Geometry& geometry, const std::vector<PlacedLine>& placed,
                   const MeasuredFlow& measured, const AdaptedSize& adapted) {
  std::vector<WakeStart> wakes;
  for (const PlacedLine& p : placed) {
    if (p.edge != PlacedLine::nowhere)
      wakes.push_back({p.edge, p.base_end, direction_of(p.path[0], p.path[1])});
  }
  WallLine line(geometry, wall_runs(geometry, bases_of(geometry, placed)), wakes);
  if (!measured.walls.empty() || !measured.thickness.empty())
    line.follow(followed_layers(line, measured, adapted));
  return line;
}

/// The stations at which runs end on the two sides of a pair, or of an inner line.
StationPairs partners_at(const WallLine& line, const std::vector<PeriodicPair>& pairs) {
  constexpr double rounding = 1e-9;
  const Box& box = line.geometry().box();
  const double allowed = rounding * std::max(box.width(), box.height());
  StationPairs partners;
  std::vector<std::int32_t> ends;
  for (std::int32_t i = 0; i < line.size(); ++i) {
    if (line[i].shape == Station::Shape::end && !line[i].at_wake) ends.push_back(i);
  }
  for (const std::int32_t i : ends) {
    if (line.across(i) > i) partners.emplace_back(i, line.across(i));
  }
  for (const PeriodicPair& pair : pairs) {
    for (const std::int32_t i : ends) {
      for (const std::int32_t j : ends) {
        if (i != j && length(pair.image(line[i].wall) - line[j].wall) <= allowed) partners.emplace_back(i, j);
      }
    }
  }
  return partners;
}

/// The root of a wake if the wall's layers have their requested thickness.
std::optional<WakeRoot> likely_root(const Geometry& g, const PlacedLine& line) {
  if (line.edge == PlacedLine::nowhere) return std::nullopt;
  const std::int32_t before = g.previous(line.edge), after = line.base_end;
  const Point along = direction_of(line.path[0], line.path[1]);
  const Point left = unit(left_of(direction_of(g.point(before), g.point(line.edge))) + left_of(along)),
              right = unit(left_of(direction_of(g.point(after), g.point(g.next(after)))) - left_of(along));
  const double thickness = layers_thickness(line.layers);
  WakeRoot root;
  root.left = g.point(line.edge) + thickness * left;
  root.right = g.point(line.base_end) + thickness * right;
  root.base = base_of(g, line);
  root.spacing = std::min(
      {leaf_over_last_layer * layer_heights(line.layers).back(), g.spacing_of(before), g.spacing_of(after)});
  if (const double at_corner = g.corner_spacing_of(line.edge); at_corner > 0)
    root.spacing = std::min(root.spacing, at_corner);
  return root;
}

}  // namespace

void LayerFront::keep(const std::vector<std::int32_t>& stations) {
  std::vector<char> keeps(line.size(), 0);
  for (const std::int32_t i : stations) keeps[i] = 1;
  LocalDemands demands;
  for (std::int32_t s = 0; s < outer.size(); ++s) {
    const bool kept = station_of[s] != WallLine::none && keeps[station_of[s]] != 0;
    demands.spacing.push_back(outer.spacing_of(s));
    demands.kept.push_back(kept || outer.kept(s) ? 1 : 0);
    demands.bend_degrees.push_back(kept ? 0 : outer.bend_degrees(s));
  }
  outer = outer.with(std::move(demands));
}

WallLine wall_line(const Geometry& geometry, const std::vector<LayerLine>& lines,
                   const MeasuredFlow& measured) {
  return wall_line(geometry, place_lines(geometry, lines, measured.wakes), measured, {});
}

double leaf_wanted_by_layers(const Geometry& geometry, const std::vector<LayerLine>& lines) {
  double least = std::numeric_limits<double>::infinity();
  for (const Boundary& boundary : geometry.boundaries()) {
    if (boundary.layers)
      least = std::min(least, leaf_over_last_layer * layer_heights(*boundary.layers).back());
  }
  constexpr double most_columns = 1e6;  // larger numbers are rejected as unreasonable
  for (const PlacedLine& line : place_lines(geometry, lines)) {
    if (least_size(line).columns > most_columns) continue;
    const LayerStrip strip = layer_strip(line, likely_root(geometry, line));
    least = std::min(least, std::ranges::min(strip.spacing));
  }
  return least;
}

LayerFront layer_front(const Geometry& geometry, std::optional<double> curvature,
                       const std::vector<LayerLine>& lines, const MeasuredFlow& measured, bool mirrored,
                       const std::vector<PeriodicPair>& pairs, const AdaptedSize& adapted,
                       const Communicator* sharing) {
  std::vector<PlacedLine> placed = place_lines(geometry, lines, measured.wakes);
  WallLine line = wall_line(geometry, placed, measured, adapted);
  if (adapted) line.limit_thickness(adapted_thickness(line, adapted));
  const WakeRoom before_layers(line, placed);
  for (PlacedLine& one : placed) one = before_layers.with_room(one);
  if (const std::vector<double> most = before_layers.thickness_of_walls(); !most.empty())
    line.limit_thickness(most);
  FittingColumns fitting = fit_thickness(line, partners_at(line, pairs), sharing);
  LayerFront front{std::move(line), {}, {}, {}, geometry, {}, {}, {}, false};
  const WakeRoom room(front.line, fitting.front, placed);
  for (PlacedLine& one : placed) one = room.with_room(one);
  OuterOutline(front.line, fitting, placed, room, curvature, mirrored, adapted).build(front);
  require_room_for_strips(front);
  front.thickness = std::move(fitting.thickness);
  front.columns = std::move(fitting.columns);
  front.points = std::move(fitting.front);
  return front;
}

}  // namespace quadloop
