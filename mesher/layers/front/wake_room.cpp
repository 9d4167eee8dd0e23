#include "mesher/layers/front/wake_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

bool keeps_clear(const PlacedLine& line) { return !line.clear_of_all_but.empty(); }

std::vector<Point> points_of(const WallLine& walls) {
  std::vector<Point> points;
  for (std::int32_t i = 0; i < walls.size(); ++i) points.push_back(walls[i].wall);
  return points;
}

bool begins_at(const PlacedLine& wake, BoundaryId boundary) {
  return std::ranges::find(wake.clear_of_all_but, boundary) != wake.clear_of_all_but.end();
}

/// The part of the distance to another line that is free for a wake. Two wakes that follow the flow share
/// it; layers of another line have their requested thickness, and thicken behind a wall.
double free_beside(const PlacedLine& other, double distance) {
  constexpr double share = 0.6, spread_of_wake = 0.1, triangles = 0.85;
  if (keeps_clear(other)) return share * distance;
  const double spread = other.edge == PlacedLine::nowhere ? 0 : spread_of_wake * length_of(other.path);
  return std::max(0.0, distance - layers_thickness(other.layers) - spread - triangles * other.spacing);
}

}  // namespace

double layers_in_room(double free, double half_base) {
  const double both = layers_over_room * free;
  return half_base > 0 ? std::min(both / (1 + core_over_layers), both - half_base) : both;
}

WakeRoom::WakeRoom(const WallLine& walls, const std::vector<PlacedLine>& lines)
    : WakeRoom(walls, points_of(walls), lines) {
  share_ = 1 - share_of_gap;
}

WakeRoom::WakeRoom(const WallLine& walls, std::span<const Point> fronts, const std::vector<PlacedLine>& lines)
    : walls_{walls}, geometry_{walls.geometry()}, share_{1}, lines_{lines} {
  if (std::ranges::none_of(lines, keeps_clear)) return;
  for (std::int32_t i = 0; i < walls.size(); ++i) {
    if (const std::int32_t next = walls.next(i); next != WallLine::none)
      obstacles_.push_back({fronts[i], fronts[next], geometry_.boundary_of(walls[i].segment)});
  }
  for (std::int32_t s = 0; s < geometry_.size(); ++s) {
    if (!walls.has_layers(s))
      obstacles_.push_back(
          {geometry_.point(s), geometry_.point(geometry_.next(s)), geometry_.boundary_of(s)});
  }
  tree_ = BoxTree(size32(obstacles_),
                  [&](std::int32_t k) { return box_of(obstacles_[k].from, obstacles_[k].to); });
}

FreeDistance WakeRoom::around(const PlacedLine& wake) const {
  if (!keeps_clear(wake)) return {};
  return [this, &wake](Point p) { return free(wake, p); };
}

WakeRoom::Nearest WakeRoom::nearest(const PlacedLine& wake, Point p) const {
  if (!keeps_clear(wake)) return {.distance = unlimited};
  const auto distance = [&](std::int32_t k) {
    const Obstacle& obstacle = obstacles_[k];
    return begins_at(wake, obstacle.boundary)
               ? unlimited
               : place_on_segment(p, obstacle.from, obstacle.to).squared_distance;
  };
  Nearest found{unlimited, tree_.nearest(p, distance)};
  if (found.obstacle != BoxTree::none) found.distance = share_ * std::sqrt(distance(found.obstacle));
  for (const PlacedLine& other : lines_) {
    if (other.name == wake.name) continue;
    if (const double free = free_beside(other, distance_to_polyline(p, other.path)); free < found.distance)
      found = {free, BoxTree::none, &other};
  }
  return found;
}

std::string WakeRoom::name_of(const Nearest& nearest) const {
  if (nearest.line != nullptr) return nearest.line->name;
  return "boundary " + geometry_.boundary(obstacles_[nearest.obstacle].boundary).name;
}

PlacedLine WakeRoom::with_room(const PlacedLine& wake) const {
  if (!keeps_clear(wake)) return wake;
  constexpr double least_share = 0.3, step = 0.25, shortest = 2;
  const double whole = length_of(wake.path),
               thickness = std::min(layers_thickness(wake.layers), thickness_at_root(wake)),
               half_base = 0.5 * length(geometry_.point(wake.edge) - geometry_.point(wake.base_end));
  for (double s = std::min(whole, shortest * thickness); s < whole; s += step * wake.spacing) {
    const std::vector<Point> part = quadloop::beginning_of(wake.path, s);
    const Nearest at = nearest(wake, part.back());
    if (layers_in_room(at.distance, half_base) >= least_share * thickness) continue;
    PlacedLine shorter = wake;
    shorter.path = part;
    shorter.shortened =
        ShortenedWake{wake.shortened ? wake.shortened->requested : whole, s, name_of(at), part.back()};
    return shorter;
  }
  return wake;
}

double WakeRoom::thickness_at_root(const PlacedLine& wake) const {
  constexpr double step = 0.25;  // of the column width
  const double whole = length_of(wake.path);
  double most = unlimited;
  for (double s = 0; steepest_thickness * s < most && s < whole; s += step * wake.spacing)
    most = std::min(
        most, layers_over_room * free(wake, beginning_of(wake.path, s).back()) + steepest_thickness * s);
  return most;
}

std::vector<double> WakeRoom::thickness_of_walls() const {
  if (std::ranges::none_of(lines_, keeps_clear)) return {};
  std::vector<double> most(walls_.size(), unlimited);
  for (const PlacedLine& wake : lines_) {
    if (!keeps_clear(wake)) continue;
    const double at_root = thickness_at_root(wake);
    for (std::int32_t i = 0; i < walls_.size(); ++i) {
      const Station& station = walls_[i];
      if (!begins_at(wake, geometry_.boundary_of(station.segment))) {
        const Point to_wake = nearest_on_polyline(station.wall, wake.path) - station.wall;
        if (dot(to_wake, station.direction) > 0) most[i] = std::min(most[i], share_of_gap * length(to_wake));
      } else if (station.wall == geometry_.point(wake.edge) ||
                 station.wall == geometry_.point(wake.base_end)) {
        most[i] = std::min(most[i], at_root);
      }
    }
  }
  return most;
}

}  // namespace quadloop
