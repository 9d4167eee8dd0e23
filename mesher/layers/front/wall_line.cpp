#include "mesher/layers/front/wall_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quadloop {

namespace {

constexpr double stations_per_thickness = 8;
// Number of thicknesses from either end of a segment within which stations are evenly spaced.
constexpr double even_thicknesses = 8;
constexpr double cosine_of_concave = 0.96592582628906831;  // a corner that turns in by more than 15 degrees
constexpr int fan_halvings = 4;

/// The bisector of two normals of the wall. Where the wall almost turns back their sum vanishes, and the
/// difference of the wall's directions is used.
Point between(Point a, Point b) {
  if (dot(a, b) > cosine_of_sharp_edge) return unit(a + b);
  const Point back{a.y - b.y, b.x - a.x};
  return unit(cross(a, b) < 0 ? back : -1.0 * back);
}

/// The directions of a fan from one normal to the other, both included.
std::vector<Point> fan_between(Point first, Point last) {
  std::vector<Point> fan{first, last};
  for (int halving = 0; halving < fan_halvings; ++halving) {
    std::vector<Point> finer{fan.front()};
    for (std::size_t k = 1; k < fan.size(); ++k) {
      finer.push_back(between(fan[k - 1], fan[k]));
      finer.push_back(fan[k]);
    }
    fan = std::move(finer);
  }
  return fan;
}

/// A point between two points, computed from the nearer one.
Point lerp(Point a, Point b, int part, int parts) {
  const double share = part / static_cast<double>(parts), rest = (parts - part) / static_cast<double>(parts);
  if (2 * part == parts) return 0.5 * (a + b);
  return 2 * part < parts ? a + share * (b - a) : b + rest * (a - b);
}

/// Tangent of the angle between the column at an end of a wall and the wall's normal, positive if the column
/// leans over the wall. `along`: direction of the wall there, which begins or ends.
double slope_over(Point column, Point along, bool begins) {
  const double ahead = dot(column, along);
  return (begins ? ahead : -ahead) / dot(column, left_of(along));
}

/// Distances of stations from the end of a segment up to its middle (included): an eighth of the thickness
/// apart near the end, where columns may lean, then increasing.
std::vector<double> widening_distances(double middle, double thickness, double widest) {
  constexpr double growth = 0.125;  // of the width, per distance from where it begins to grow
  const double least = thickness / stations_per_thickness, even = even_thicknesses * thickness;
  std::vector<double> distances;
  for (double reached = 0; reached < middle;) {
    const double wider = least + growth * std::max(0.0, reached - even);
    reached += std::min(wider, std::max(widest, least));
    distances.push_back(reached);
  }
  const double excess = distances.back() / middle;
  for (double& distance : distances) distance /= excess;
  return distances;
}

/// Stations inside a segment where cells of length `spacing` are requested. A mirror image, or the reversed
/// segment, has the same ones to the last bit.
std::vector<Point> places_between(Point from, Point to, double thickness, double spacing) {
  constexpr double stations_per_cell = 4;
  const double whole = length(to - from);
  std::vector<Point> places;
  if (whole <= 2 * even_thicknesses * thickness) {
    const int parts = std::max(1, static_cast<int>(std::ceil(stations_per_thickness * whole / thickness)));
    for (int part = 1; part < parts; ++part) places.push_back(lerp(from, to, part, parts));
    return places;
  }
  const std::vector<double> distances = widening_distances(whole / 2, thickness, spacing / stations_per_cell);
  const std::size_t half = distances.size() - 1;
  for (std::size_t k = 0; k < half; ++k) places.push_back(from + (distances[k] / whole) * (to - from));
  places.push_back(0.5 * (from + to));
  for (std::size_t k = half; k-- > 0;) places.push_back(to + (distances[k] / whole) * (from - to));
  return places;
}

void set_on_curve(const CurvePoint& at, Station& station) {
  station.wall = at.point;
  station.before = station.after = at.direction;
  station.direction = left_of(at.direction);
}

/// The unit direction of a segment at its first or its last point, a tangent of its curve.
Point direction_along(const Geometry& g, std::int32_t s, bool at_start) {
  if (!g.is_curved(s)) return direction_of(g.point(s), g.point(g.next(s)));
  return at_start ? direction_at_start(g.segment(s)) : direction_at_end(g.segment(s));
}

}  // namespace

WallLine::WallLine(const Geometry& geometry, const std::vector<WallRun>& runs,
                   const std::vector<WakeStart>& wakes)
    : geometry_{&geometry}, has_layers_(geometry.points().size(), 0) {
  for (const WallRun& run : runs) {
    for (const std::int32_t s : run.segments) has_layers_[s] = 1;
  }
  for (const WakeStart& wake : wakes) {
    wakes_from_.emplace(wake.first, wake);
    wakes_to_.emplace(wake.last, wake);
  }
  for (const WallRun& run : runs) add_run(run);
  find_across();
  for (std::int32_t i = 0; i < size(); ++i) {
    width_.push_back(next_[i] == none ? 0 : length(stations_[next_[i]].wall - stations_[i].wall));
    asked_.push_back(layers_thickness(spec(i)));
  }
}

void WallLine::follow(std::vector<LayerSpec> specs) {
  followed_ = std::move(specs);
  for (std::int32_t i = 0; i < size(); ++i) asked_[i] = layers_thickness(spec(i));
}

void WallLine::limit_thickness(std::span<const double> most) {
  for (std::int32_t i = 0; i < size(); ++i) asked_[i] = std::min(asked_[i], most[i]);
  limit_slopes(*this, asked_);
}

void WallLine::add_run(const WallRun& run) {
  const std::int32_t begin = size();
  for (std::size_t k = 0; k < run.segments.size(); ++k) {
    if (k == 0 && !run.closed) {
      add_end(run, true);
    } else {
      add_corner(run, k);
    }
    add_between(run, k);
  }
  if (!run.closed) add_end(run, false);
  link(begin, run.closed);
}

/// Adds the station at the vertex where segment k of the run begins.
void WallLine::add_corner(const WallRun& run, std::size_t k) {
  const std::size_t before_k = k == 0 ? run.segments.size() - 1 : k - 1;
  const std::int32_t before = run.segments[before_k], after = run.segments[k];
  const Geometry& g = *geometry_;
  Station station;
  station.wall = g.point(after);
  station.before = direction_along(g, before, false);
  station.after = direction_along(g, after, true);
  station.segment = after;
  station.layers = run.layers[k];
  station.kept = g.kept(after);
  const Point first = left_of(station.before), last = left_of(station.after);
  if (const auto wake = wakes_from_.find(after); wake != wakes_from_.end())
    return add_wake(station, run.layers[before_k], wake->second);
  const double turn = cross(station.before, station.after), cosine = dot(station.before, station.after);
  if (turn < 0 && cosine < cosine_of_sharp_edge) {
    station.shape = Station::Shape::fan;
    const std::vector<Point> fan = fan_between(first, last);
    for (std::size_t i = 0; i < fan.size(); ++i) {
      station.direction = fan[i];
      station.kept = i == 0 || i + 1 == fan.size();
      station.layers = run.layers[2 * i < fan.size() ? before_k : k];
      stations_.push_back(station);
    }
    return;
  }
  station.direction = between(first, last);
  if (station.kept && turn > 0 && cosine < cosine_of_concave) {
    station.shape = Station::Shape::concave;
    station.slope = turn / (1 + cosine);  // of the bisector: tangent of half the turn
  }
  stations_.push_back(station);
}

/// Adds the two columns at the edge, along the bisectors of the normals of wall and wake.
void WallLine::add_wake(Station station, BoundaryId before, const WakeStart& wake) {
  const BoundaryId after = station.layers;
  station.shape = Station::Shape::fan;
  station.kept = true;
  station.at_wake = station.opens_wake = true;
  station.layers = before;
  station.direction = unit(left_of(station.before) + left_of(wake.direction));
  station.slope = slope_over(station.direction, station.before, false);
  stations_.push_back(station);
  station.opens_wake = false;
  station.layers = after;
  station.direction = unit(left_of(station.after) - left_of(wake.direction));
  station.slope = slope_over(station.direction, station.after, true);
  stations_.push_back(station);
}

/// Adds the stations inside segment k of the run.
void WallLine::add_between(const WallRun& run, std::size_t k) {
  const Geometry& g = *geometry_;
  const std::int32_t s = run.segments[k];
  const Point from = g.point(s), to = g.point(g.next(s));
  const double thickness = layers_thickness(*g.boundary(run.layers[k]).layers);
  Station station;
  station.before = station.after = direction_of(from, to);
  station.segment = s;
  station.layers = run.layers[k];
  station.direction = left_of(station.after);
  for (const Point p : places_between(from, to, thickness, g.spacing_of(s))) {
    station.wall = p;
    if (g.is_curved(s)) set_on_curve(above_chord(g.segment(s), p), station);
    stations_.push_back(station);
  }
}

/// Adds the station where an open run begins or ends; its column lies on the adjacent boundary.
void WallLine::add_end(const WallRun& run, bool first) {
  const Geometry& g = *geometry_;
  const std::int32_t s = first ? run.segments.front() : run.segments.back();
  const std::int32_t vertex = first ? s : g.next(s);
  Station station;
  station.wall = g.point(vertex);
  station.before = station.after = direction_along(g, s, first);
  station.segment = s;
  station.layers = first ? run.layers.front() : run.layers.back();
  station.shape = Station::Shape::end;
  station.kept = true;
  const EndPath path(g, vertex, first);
  const double thickness = layers_thickness(*g.boundary(station.layers).layers);
  const Point along = path.is_curved() ? path.point_at(std::min(thickness, share_of_end * path.length()))
                                       : g.point(first ? g.previous(vertex) : g.next(vertex));
  station.direction = direction_of(station.wall, along);
  const auto& wakes = first ? wakes_to_ : wakes_from_;
  if (const auto wake = wakes.find(vertex); wake != wakes.end()) {
    station.at_wake = true;
    station.opens_wake = !first;
    station.direction = unit(left_of(station.after) + (first ? -1 : 1) * left_of(wake->second.direction));
  }
  if (!station.at_wake) ends_.emplace(size(), path);
  station.slope = slope_over(station.direction, station.after, first);
  stations_.push_back(station);
}

/// Two stations lie across from each other if the runs end on twins.
void WallLine::find_across() {
  const Geometry& g = *geometry_;
  across_.assign(stations_.size(), none);
  std::map<std::int32_t, std::int32_t> begins;  // of runs, by their first segments
  for (std::int32_t i = 0; i < size(); ++i) {
    if (previous_[i] == none) begins.emplace(stations_[i].segment, i);
  }
  for (std::int32_t i = 0; i < size(); ++i) {
    const std::int32_t twin = next_[i] == none ? g.twin(g.next(stations_[i].segment)) : -1;
    const auto found = twin < 0 ? begins.end() : begins.find(g.next(twin));
    if (found == begins.end()) continue;
    across_[i] = found->second;
    across_[found->second] = i;
  }
}

void limit_slopes(const WallLine& line, std::span<double> values) {
  for (int round = 0; round < 2; ++round) {  // a closed run needs a second round
    for (std::int32_t i = 0; i < line.size(); ++i) {
      if (const std::int32_t j = line.next(i); j != WallLine::none)
        values[j] = std::min(values[j], values[i] + steepest_thickness * line.width(i));
    }
    for (std::int32_t i = line.size() - 1; i >= 0; --i) {
      if (const std::int32_t j = line.previous(i); j != WallLine::none)
        values[j] = std::min(values[j], values[i] + steepest_thickness * line.width(j));
    }
  }
}

std::int32_t WallLine::steps(std::int32_t i, std::int32_t j) const {
  if (run_of_[i] != run_of_[j]) return none;
  const Run& run = runs_[run_of_[i]];
  if (j >= i) return j - i;
  return run.closed ? j - i + (run.end - run.begin) : none;
}

void WallLine::link(std::int32_t begin, bool closed) {
  for (std::int32_t i = begin; i < size(); ++i) {
    next_.push_back(i + 1 < size() ? i + 1 : closed ? begin : none);
    previous_.push_back(i > begin ? i - 1 : closed ? size() - 1 : none);
    run_of_.push_back(size32(runs_));
  }
  runs_.push_back({begin, size(), closed});
}

}  // namespace quadloop
