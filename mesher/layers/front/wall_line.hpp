#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/layers/front/end_path.hpp"
#include "mesher/layers/front/wall_runs.hpp"

namespace quadloop {

/// A station: a point of the wall where a column of layers may begin. The domain lies to the left.
struct Station {
  /// The shape of the wall at the station.
  enum class Shape : std::uint8_t {
    smooth,   ///< straight, or a turn so small (or away from the domain) that one column suffices
    concave,  ///< a corner that turns into the domain
    fan,      ///< one of several columns at a sharp convex corner
    end       ///< end of the run, on a boundary without layers
  };

  Point wall;
  Point before, after;       ///< unit directions of the wall before and after it
  std::int32_t segment = 0;  ///< segment of the geometry after it; before it where a run ends
  BoundaryId layers;         ///< the boundary that specifies its layers
  Shape shape = Shape::smooth;
  bool at_wake = false;     ///< a wake begins there
  bool opens_wake = false;  ///< a wake lies between it and the next station
  bool kept = false;        ///< must be a node, on the wall and on the front
  double slope = 0;  ///< at a concave corner, an end or a wake: tangent of the column's angle to the normal,
                     ///< away from the corner
  Point direction;   ///< of its column: given in fans and at ends, elsewhere the bisector of the two normals

  bool fixed() const { return shape != Shape::smooth; }
};

/// The longest last column of a run, as a fraction of the part of a boundary on which it can lie.
constexpr double share_of_end = 0.9;
/// The part of a gap for the layers of one of its sides: the columns of two facing walls, with their
/// clearance, just do not meet.
constexpr double share_of_gap = 0.36;
/// The change of thickness along a wall or a wake, per distance, in gaps and at corners.
constexpr double steepest_thickness = 0.35;
constexpr double cosine_of_sharp_edge = -0.5;  ///< the wall turns by more than 120 degrees

/// An edge at which a wake begins.
struct WakeStart {
  std::int32_t first = 0, last = 0;  ///< vertices; equal at a sharp edge
  Point direction;                   ///< unit direction of the wake
};

/// The walls with layers, as a flat list of the stations of all runs. Within eight thicknesses of a segment's
/// ends stations are an eighth of the layers' thickness apart. Farther away the distance grows by an eighth
/// of the distance, up to a quarter of the requested spacing; layers are straight there, and the number of
/// stations grows with the logarithm of the thickness only. A place between two stations has the number of
/// the first one.
class WallLine {
 public:
  static constexpr std::int32_t none = -1;

  /// Where a wake begins there are two columns, one for each side of the wake, instead of a fan. `geometry`
  /// must outlive it.
  WallLine(const Geometry& geometry, const std::vector<WallRun>& runs,
           const std::vector<WakeStart>& wakes = {});

  /// Replaces the layers of each station; one entry per station.
  void follow(std::vector<LayerSpec> specs);
  /// Limits the requested thicknesses, and their slopes (limit_slopes()); one entry per station.
  void limit_thickness(std::span<const double> most);

  std::int32_t size() const { return size32(stations_); }
  const Station& operator[](std::int32_t i) const { return stations_[i]; }
  std::int32_t next(std::int32_t i) const { return next_[i]; }          ///< or `none`
  std::int32_t previous(std::int32_t i) const { return previous_[i]; }  ///< or `none`
  /// The number of stations from i to j on the same run; `none` if j is on another run.
  std::int32_t steps(std::int32_t i, std::int32_t j) const;
  /// Whether the layers continue to the next station.
  bool goes_on(std::int32_t i) const { return next_[i] != none && !stations_[i].opens_wake; }
  /// The station on the other side of the inner line, or of the boundary between two blocks, on which the run
  /// ends at station i: the run on that side ends there too, at the same foot. `none` elsewhere.
  std::int32_t across(std::int32_t i) const { return across_[i]; }
  /// Of the stations at a foot the one at which a run begins, or ends; i elsewhere.
  std::int32_t beginning_at(std::int32_t i) const {
    return next_[i] == none && across_[i] != none ? across_[i] : i;
  }
  std::int32_t ending_at(std::int32_t i) const {
    return previous_[i] == none && across_[i] != none ? across_[i] : i;
  }
  /// The station whose column stands at station i: both sides of an inner line have the same one.
  std::int32_t column_at(std::int32_t i) const { return across_[i] == none ? i : std::min(i, across_[i]); }
  /// The length of the wall to the next station; 0 within a fan and where there is no next station.
  double width(std::int32_t i) const { return width_[i]; }
  /// The requested thickness, as far as limit_thickness() allows it.
  double asked(std::int32_t i) const { return asked_[i]; }
  /// The requested layers: those of its boundary, or those set by follow().
  const LayerSpec& spec(std::int32_t i) const {
    return followed_.empty() ? *geometry_->boundary(stations_[i].layers).layers : followed_[i];
  }
  const Geometry& geometry() const { return *geometry_; }
  /// Whether the columns of a segment with layers stand on nodes of the block on the other side: it has
  /// layers on this side only, or also on that of the lower block.
  bool is_interface(std::int32_t segment) const {
    const std::int32_t twin = geometry_->twin(segment);
    return twin >= 0 && (has_layers_[twin] == 0 || geometry_->is_second(segment));
  }
  /// Whether such columns stand between the station and the next one; within a fan, at the station.
  bool is_on_interface(std::int32_t i) const { return goes_on(i) && is_interface(stations_[i].segment); }
  /// Whether such columns stand on one side of the station only, and ordinary ones on the other side.
  bool is_beside_interface(std::int32_t i) const {
    const std::int32_t before = previous_[i];
    return before != none && goes_on(before) && goes_on(i) && is_on_interface(before) != is_on_interface(i);
  }
  bool has_layers(std::int32_t segment) const { return has_layers_[segment] != 0; }
  /// The part of a boundary without layers on which the last column of a run lies, which ends at station i,
  /// but not at a wake.
  const EndPath& end_path(std::int32_t i) const { return ends_.at(i); }
  /// Whether the last column of a run lies on a curve and ends at station i.
  bool ends_on_curve(std::int32_t i) const {
    if (stations_[i].shape != Station::Shape::end) return false;
    const auto found = ends_.find(i);
    return found != ends_.end() && found->second.is_curved();
  }

  /// Calls `visit(station, distance)` once for each station after i (walk_on) or before i (walk_back) within
  /// `reach` along the wall; i itself is excluded. Distances are summed from i, so that a mirror image has
  /// the same ones.
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
  void find_across();

  const Geometry* geometry_;
  std::vector<char> has_layers_;                             ///< flags of segments
  std::map<std::int32_t, WakeStart> wakes_from_, wakes_to_;  ///< by their first and last vertices
  std::vector<Station> stations_;
  std::map<std::int32_t, EndPath> ends_;  ///< by station
  std::vector<std::int32_t> next_, previous_, across_;
  struct Run {
    std::int32_t begin = 0, end = 0;
    bool closed = false;
  };
  std::vector<Run> runs_;
  std::vector<std::int32_t> run_of_;
  std::vector<double> width_, asked_;
  std::vector<LayerSpec> followed_;
};

/// Limits values of the stations, e.g. thicknesses, such that they grow by at most `steepest_thickness` times
/// the distance from any other station on the same run.
void limit_slopes(const WallLine& line, std::span<double> values);

/// The direction rotated by 90 degrees to the left: into the domain.
constexpr Point left_of(Point direction) { return {-direction.y, direction.x}; }

/// The unit vector in the same direction.
inline Point unit(Point p) { return (1 / length(p)) * p; }

}  // namespace quadloop
