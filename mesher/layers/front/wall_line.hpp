#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/layers/front/wall_runs.hpp"

namespace quadloop {

/// A place of the wall from which a column of layers may rise. The domain lies to the left.
struct Station {
  /// What the wall does there.
  enum class Shape : std::uint8_t {
    smooth,   ///< goes on, or turns by so little (or away from the domain) that one column will do
    concave,  ///< a corner that turns into the domain
    fan,      ///< one of several columns that rise from a sharp corner
    end       ///< the run ends here, on a boundary without layers
  };

  Point wall;
  Point before, after;       ///< directions of the wall before and after it
  std::int32_t segment = 0;  ///< of the geometry: that after it, or before it where a run ends
  BoundaryId layers;         ///< whose layers it carries
  Shape shape = Shape::smooth;
  bool at_wake = false;     ///< a wake begins there
  bool opens_wake = false;  ///< and lies between it and the next station
  bool kept = false;        ///< must be a node, on the wall and on the front
  double slope = 0;  ///< of a concave corner's or an end's column, over the normal, away from the corner
  Point direction;   ///< of its column: given in fans and at ends, elsewhere the middle of the two normals

  bool fixed() const { return shape != Shape::smooth; }
};

constexpr double cosine_of_sharp_edge = -0.5;  ///< where the wall turns by more than 120 degrees

/// An edge that a wake begins at.
struct WakeStart {
  std::int32_t first = 0, last = 0;  ///< vertices: one and the same at a sharp edge
  Point direction;                   ///< of the wake, of length 1
};

/// The walls that carry layers, as stations: on each segment an eighth of the layers' thickness apart within
/// eight thicknesses of its ends, and farther from them wider, by an eighth of the distance and up to a
/// quarter of the spacing wanted there. So a segment has as many more stations as the logarithm of how thin
/// its layers are, which on it are straight. Flat: the stations of all runs one after another, a place
/// between two stations has the number of the first one.
class WallLine {
 public:
  static constexpr std::int32_t none = -1;

  /// Where a wake begins there is no fan but two columns, one for each side of the wake. `geometry` must
  /// outlive it.
  WallLine(const Geometry& geometry, const std::vector<WallRun>& runs,
           const std::vector<WakeStart>& wakes = {});

  /// Other layers at each station, as many as there are.
  void follow(std::vector<LayerSpec> specs);

  std::int32_t size() const { return size32(stations_); }
  const Station& operator[](std::int32_t i) const { return stations_[i]; }
  std::int32_t next(std::int32_t i) const { return next_[i]; }          ///< or `none`
  std::int32_t previous(std::int32_t i) const { return previous_[i]; }  ///< or `none`
  /// How many stations on from i the station j is, on the same line of wall; `none` where it is not.
  std::int32_t steps(std::int32_t i, std::int32_t j) const;
  /// Whether the layers go on to a next station.
  bool goes_on(std::int32_t i) const { return next_[i] != none && !stations_[i].opens_wake; }
  /// The length of the wall to the next station; 0 within a fan, and where there is none.
  double width(std::int32_t i) const { return width_[i]; }
  /// The thickness asked for there.
  double asked(std::int32_t i) const { return asked_[i]; }
  /// The layers asked for there: those of its boundary, or what follow() has made of them.
  const LayerSpec& spec(std::int32_t i) const {
    return followed_.empty() ? *geometry_->boundary(stations_[i].layers).layers : followed_[i];
  }
  const Geometry& geometry() const { return *geometry_; }
  /// Calls `visit(vertex, distance)` for the vertices of the boundary on which a run ends at station i, as
  /// far as it is straight and that one boundary, with their distances from the wall.
  template <class Visit>
  void walk_end(std::int32_t i, const Visit& visit) const;

  /// Calls `visit(station, distance)` for the stations that follow i, or that lead to it, as far as `reach`
  /// along the wall and once each; i itself is not among them. Distances are summed from i on, so that a
  /// mirror image has the same ones.
  template <class Visit>
  void walk_on(std::int32_t i, double reach, const Visit& visit) const {
    double distance = 0;
    for (std::int32_t j = i; next_[j] != none && next_[j] != i; j = next_[j]) {
      distance += width_[j];
      if (distance > reach) return;
      visit(next_[j], distance);
    }
  }
  template <class Visit>
  void walk_back(std::int32_t i, double reach, const Visit& visit) const {
    double distance = 0;
    for (std::int32_t j = i; previous_[j] != none && previous_[j] != i; j = previous_[j]) {
      distance += width_[previous_[j]];
      if (distance > reach) return;
      visit(previous_[j], distance);
    }
  }

 private:
  void add_run(const WallRun& run);
  void add_corner(const WallRun& run, std::size_t k);
  void add_wake(Station station, BoundaryId before, const WakeStart& wake);
  void add_between(const WallRun& run, std::size_t k);
  void add_end(const WallRun& run, bool first);
  void link(std::int32_t begin, bool closed);

  const Geometry* geometry_;
  std::map<std::int32_t, WakeStart> wakes_from_, wakes_to_;  ///< by their first and last vertices
  std::vector<Station> stations_;
  std::vector<std::int32_t> next_, previous_;
  struct Run {
    std::int32_t begin = 0, end = 0;
    bool closed = false;
  };
  std::vector<Run> runs_;
  std::vector<std::int32_t> run_of_;
  std::vector<double> width_, asked_;
  std::vector<LayerSpec> followed_;
};

template <class Visit>
void WallLine::walk_end(std::int32_t i, const Visit& visit) const {
  constexpr double straight_sine = 1e-9;
  const Geometry& g = *geometry_;
  const bool first = previous_[i] == none;
  const std::int32_t wall = first ? stations_[i].segment : g.next(stations_[i].segment);
  const std::int32_t on = first ? g.previous(wall) : wall;
  for (std::int32_t s = on; g.boundary_of(s) == g.boundary_of(on); s = first ? g.previous(s) : g.next(s)) {
    const std::int32_t vertex = first ? s : g.next(s);
    const Point way = g.point(vertex) - stations_[i].wall;
    const double distance = length(way);
    if (vertex == wall || std::abs(cross(stations_[i].direction, way)) > straight_sine * distance) return;
    visit(vertex, distance);
  }
}

/// Left of a direction: into the domain.
constexpr Point left_of(Point direction) { return {-direction.y, direction.x}; }

/// In the same direction, of length 1.
inline Point unit(Point p) { return (1 / length(p)) * p; }

}  // namespace quadloop
