#include "mesher/layers/front/columns_on_wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace quadloop {

namespace {

constexpr double least_cosine_of_tilt = 0.55;                    // of a column: 57 degrees
constexpr double least_ratio = 0.3, largest_ratio = 6;           // width of the front over that of the wall
constexpr double convergent_ratio = 1.1, spreading_ratio = 1.5;  // same ratio
constexpr int most_averagings = 40;
constexpr std::int32_t worth_sharing = 200;  ///< crowded stations that ranks divide among them

// A column's length depends on half a thickness of wall around its station. Seen from a place at this
// distance, the distance is measured in the local thickness, which may be smaller by 0.35 of the distance.
constexpr double known_within = 0.61;

}  // namespace

/// Where columns are averaged they depend on their neighbours; such stations are active. Stretches of active
/// stations that do not touch are independent, so a change of thickness affects only the stretches that it
/// touches.
class ColumnsOnWall::Columns {
 public:
  Columns(const WallLine& line, const Communicator* sharing)
      : line_{line},
        sharing_{sharing},
        h_(line.size()),
        leans_(line.size()),
        convergence_(line.size()),
        seen_(line.size()),
        active_(line.size()),
        again_(line.size()),
        turned_(line.size()),
        columns_{std::vector<Point>(line.size()), std::vector<double>(line.size())} {}

  const WallColumns& fit(const std::vector<double>& thickness) {
    std::vector<std::int32_t> stations = changed_by(thickness);
    while (!stations.empty()) {
      for (const std::int32_t i : stations) add_stretches(i);
      stand_and_turn();
      stations = active_outside();
    }
    for (const std::int32_t i : stations_) active_[i] = 0;
    for (const std::int32_t i : zone_of(touched_)) active_[i] = 1;
    for (const std::int32_t i : stations_) again_[i] = 0;
    stations_.clear();
    return columns_;
  }

 private:
  /// The stations whose columns change before averaging.
  std::vector<std::int32_t> changed_by(const std::vector<double>& thickness) {
    const std::vector<double> h_before = std::exchange(h_, thickness);
    const std::vector<double> leans_before = std::exchange(leans_, leans());
    std::vector<std::int32_t> changed;
    for (std::int32_t i = 0; i < line_.size(); ++i) {
      if (h_[i] != h_before[i] || leans_[i] != leans_before[i]) changed.push_back(i);
    }
    return with_neighbours(around(
        changed, [&](std::int32_t i) { return known_within * std::max(h_[i], h_before[i]); }, false));
  }

  /// Flags the station, and the stretch of active stations that it touches, to be recomputed.
  void add_stretches(std::int32_t i) {
    if (!add_again(i)) return;
    for (std::int32_t j = line_.next(i); j != WallLine::none && active_[j] && add_again(j);)
      j = line_.next(j);
    for (std::int32_t j = line_.previous(i); j != WallLine::none && active_[j] && add_again(j);)
      j = line_.previous(j);
  }
  bool add_again(std::int32_t i) {
    if (std::exchange(again_[i], 1)) return false;
    stations_.push_back(i);
    return true;
  }

  void stand_and_turn() {
    for (const std::int32_t i : stations_) {
      const Point normal = line_[i].direction;
      columns_.direction[i] = leans_[i] == 0 ? normal : upright(i, unit(normal + leans_[i] * along(i)));
    }
    touched_.clear();
    set_lengths(stations_);
    std::vector<std::int32_t> crowded = crowded_among(stations_);
    const bool shares = sharing_ != nullptr && size32(crowded) >= worth_sharing;
    turn_together(std::move(crowded), shares ? sharing_->size() : 1);
    for (const std::int32_t i : touched_) turned_[i] = 0;
  }

  /// Turns columns around the crowded stations.
  void turn(std::vector<std::int32_t> crowded) {
    for (int round = 0; round < most_averagings && !crowded.empty(); ++round) {
      const std::vector<std::int32_t> turned = around(
          crowded, [&](std::int32_t i) { return h_[i]; }, true);
      if (turned.empty()) break;
      average(turned);
      const auto touched = around(
          turned, [&](std::int32_t i) { return 0.75 * h_[i]; }, false);
      set_lengths(touched);
      crowded = crowded_among(touched);
      for (const std::int32_t i : touched) {
        if (!std::exchange(turned_[i], 1)) touched_.push_back(i);
      }
    }
  }

  /// A column that a rank has turned, or a place whose convergence has changed.
  struct Changed {
    std::int32_t station = 0;
    bool touched = false;
    Point direction;
    double length = 0, convergence = 0;
  };

  /// The same on several ranks: each turns the columns around its share of the crowded stations. If no rank
  /// has changed a column on which those of another rank depend, the result is that of turn(). Otherwise the
  /// work is repeated with fewer, larger shares. *Collective.*
  void turn_together(std::vector<std::int32_t> crowded, int shares) {
    constexpr int fewer = 4;
    if (shares <= 1) return turn(std::move(crowded));
    const WallColumns before = columns_;
    const std::vector<double> convergence_before = convergence_;
    turn(share_of(crowded, shares));
    const std::vector<Changed> own = changes(),
                               all = sharing_->all_gather_values(std::span<const Changed>(own));
    if (sharing_->any(depends_on_others(all, own.size()))) {
      columns_ = before;
      convergence_ = convergence_before;
      for (const std::int32_t i : touched_) turned_[i] = 0;
      touched_.clear();
      return turn_together(std::move(crowded), shares / fewer);
    }
    for (const auto& [station, touched, direction, length, convergence] : all) {
      columns_.direction[station] = direction;
      columns_.length[station] = length;
      convergence_[station] = convergence;
      if (touched && !std::exchange(turned_[station], 1)) touched_.push_back(station);
    }
  }

  std::vector<Changed> changes() {
    std::vector<Changed> changed;
    begin_set();
    for (const std::int32_t i : touched_) {
      for (const std::int32_t j : {i, line_.previous(i)}) {
        if (j != WallLine::none && add_to_set(j))
          changed.push_back({j, turned_[j] != 0, columns_.direction[j], columns_.length[j], convergence_[j]});
      }
    }
    return changed;
  }

  /// Whether changes of other ranks, among those of all, are at stations that this rank's columns depend on.
  bool depends_on_others(const std::vector<Changed>& all, std::size_t own) {
    std::vector<std::int32_t> zone = zone_of(touched_);
    begin_set();
    for (const std::int32_t i : zone) add_to_set(i);
    const auto in_zone =
        std::ranges::count_if(all, [&](const Changed& change) { return seen_[change.station] == stamp_; });
    return static_cast<std::size_t>(in_zone) != own;
  }

  /// This rank's share of the crowded stations, with borders where two of them are far apart; none on ranks
  /// beyond the number of shares.
  std::vector<std::int32_t> share_of(std::vector<std::int32_t> crowded, int shares) const {
    std::ranges::sort(crowded);
    const std::int64_t count = std::ssize(crowded), search = count / (3 * shares);
    const auto border = [&](std::int64_t rank) {
      std::int64_t best = std::min(count, rank * count / shares);
      if (rank == 0 || rank >= shares) return best;
      double widest = 0;
      for (std::int64_t k = std::max<std::int64_t>(1, best - search), end = best + search; k <= end; ++k) {
        const double gap = thicknesses_between(crowded[k - 1], crowded[k]);
        if (gap > widest) widest = gap, best = k;
      }
      return best;
    };
    return {crowded.begin() + border(sharing_->rank()), crowded.begin() + border(sharing_->rank() + 1)};
  }
  /// The length of the wall from one station to a later one, in thicknesses; infinite between two runs.
  double thicknesses_between(std::int32_t from, std::int32_t to) const {
    if (line_.steps(from, to) == WallLine::none) return std::numeric_limits<double>::infinity();
    double distance = 0;
    for (std::int32_t i = from; i < to; ++i) distance += line_.width(i);
    return distance / std::max(h_[from], h_[to]);
  }

  /// The stations that depend on the given ones.
  std::vector<std::int32_t> zone_of(const std::vector<std::int32_t>& stations) {
    return with_neighbours(around(
        stations, [&](std::int32_t i) { return known_within * h_[i]; }, false));
  }
  std::vector<std::int32_t> with_neighbours(const std::vector<std::int32_t>& stations) {
    std::vector<std::int32_t> all;
    begin_set();
    for (const std::int32_t i : stations) {
      for (const std::int32_t j : {line_.previous(i), i, line_.next(i)}) {
        if (j != WallLine::none && add_to_set(j)) all.push_back(j);
      }
    }
    return all;
  }

  /// Newly active stations outside the recomputed ones that touch stations which were already active.
  std::vector<std::int32_t> active_outside() {
    std::vector<std::int32_t> outside;
    bool touches = false;
    for (const std::int32_t i : zone_of(touched_)) {
      if (again_[i]) continue;
      outside.push_back(i);
      for (const std::int32_t j : {line_.previous(i), i, line_.next(i)})
        touches = touches || (j != WallLine::none && active_[j] && !again_[j]);
    }
    return touches ? outside : std::vector<std::int32_t>{};
  }

  Point along(std::int32_t i) const {
    const Point n = line_[i].direction;
    return {n.y, -n.x};
  }

  /// Columns lean by tan(tilt) = slope (1 - distance / reach), reach = 2 h slope: the distances of their feet
  /// on the front are half those on the wall.
  std::vector<double> leans() const {
    std::vector<double> onwards(h_.size()), backwards(h_.size());
    for (std::int32_t i = 0; i < line_.size(); ++i) {
      const Station& corner = line_[i];
      if (corner.slope == 0) continue;
      const double reach = 2 * h_[i] * std::abs(corner.slope);
      const auto take = [&](std::vector<double>& leans) {
        return [&, reach](std::int32_t j, double distance) {
          const double lean = corner.slope * (1 - distance / reach);
          if (line_[j].shape == Station::Shape::smooth && std::abs(lean) > std::abs(leans[j]))
            leans[j] = lean;
        };
      };
      const std::int32_t before = line_.previous(i);
      if (line_.goes_on(i)) line_.walk_on(i, reach, take(onwards));
      if (before != WallLine::none && line_.goes_on(before)) line_.walk_back(i, reach, take(backwards));
    }
    for (std::int32_t i = 0; i < line_.size(); ++i) onwards[i] -= backwards[i];
    return onwards;
  }

  /// The width of the front over that of the wall, between i and the next station, along the mean of the
  /// wall's directions there.
  double ratio(std::int32_t i, const std::vector<double>& lengths) const {
    const std::int32_t j = line_.next(i);
    const Point front = (line_[j].wall - line_[i].wall) +
                        (lengths[j] * columns_.direction[j] - lengths[i] * columns_.direction[i]);
    return dot(front, 0.5 * (line_[i].after + line_[j].before)) / line_.width(i);
  }
  bool has_width(std::int32_t i) const { return line_.width(i) > 0; }

  /// Relative to the normal with the larger tilt; at a convex corner to the other normal, as a column there
  /// would otherwise be longer than its neighbours.
  double cosine_of_tilt(std::int32_t i) const {
    const Station& station = line_[i];
    const auto [less, more] = std::minmax({dot(columns_.direction[i], left_of(station.before)),
                                           dot(columns_.direction[i], left_of(station.after))});
    return cross(station.before, station.after) < 0 ? more : less;
  }

  /// Sets how strongly columns converge between a station and the next: 0 to 1.
  void set_convergence(std::int32_t i) {
    if (i != WallLine::none && has_width(i))
      convergence_[i] =
          std::clamp((spreading_ratio - ratio(i, h_)) / (spreading_ratio - convergent_ratio), 0.0, 1.0);
  }

  /// L = h (1 + p (1/c - 1)): where columns converge (p = 1) the layers keep their thickness normal to the
  /// wall; where they spread (p = 0) the columns have length h.
  void set_lengths(const std::vector<std::int32_t>& stations) {
    for (const std::int32_t i : stations) {
      set_convergence(i);
      set_convergence(line_.previous(i));
    }
    for (const std::int32_t i : stations) {
      const Station& station = line_[i];
      const bool corner = station.shape == Station::Shape::concave || station.shape == Station::Shape::end;
      const bool in_fan = station.shape == Station::Shape::fan && !station.at_wake;
      const double share = in_fan ? 0 : corner ? 1 : mean_convergence(i);
      const double cosine = std::max(cosine_of_tilt(i), 0.5);
      columns_.length[i] = h_[i] * (1 + share * (1 / cosine - 1));
    }
  }

  /// The mean over half a thickness of wall on both sides.
  double mean_convergence(std::int32_t i) const {
    double on = 0, back = 0, wall_on = 0, wall_back = 0;
    const auto add = [&](std::int32_t place, double& sum, double& wall) {
      sum += line_.width(place) * convergence_[place];
      wall += line_.width(place);
    };
    line_.walk_on(i, h_[i] / 2, [&](std::int32_t j, double) { add(line_.previous(j), on, wall_on); });
    line_.walk_back(i, h_[i] / 2, [&](std::int32_t j, double) { add(j, back, wall_back); });
    if (wall_on == 0 || wall_back == 0)
      return wall_on > 0 ? on / wall_on : wall_back > 0 ? back / wall_back : 0;
    return std::min(on / wall_on, back / wall_back);
  }

  /// Stations at both ends of the places beside the given stations where columns come too close or spread too
  /// far.
  std::vector<std::int32_t> crowded_among(const std::vector<std::int32_t>& stations) {
    std::vector<std::int32_t> found;
    begin_set();
    for (const std::int32_t i : stations) {
      for (const std::int32_t place : {line_.previous(i), i}) {
        if (place == WallLine::none || !has_width(place) || !add_to_set(place)) continue;
        const double r = ratio(place, columns_.length);
        if (r < least_ratio || r > largest_ratio) found.insert(found.end(), {place, line_.next(place)});
      }
    }
    return found;
  }

  /// The stations within reach of the given ones, each once.
  template <class Reach>
  std::vector<std::int32_t> around(const std::vector<std::int32_t>& stations, const Reach& reach,
                                   bool free_only) {
    std::vector<std::int32_t> found;
    begin_set();
    const auto take = [&](std::int32_t j, double) {
      if (!(free_only && line_[j].fixed()) && add_to_set(j)) found.push_back(j);
    };
    for (const std::int32_t i : stations) {
      take(i, 0);
      line_.walk_on(i, reach(i), take);
      line_.walk_back(i, reach(i), take);
    }
    return found;
  }

  void begin_set() { ++stamp_; }
  bool add_to_set(std::int32_t i) { return std::exchange(seen_[i], stamp_) != stamp_; }

  /// Turns columns half way to the mean of their neighbours.
  void average(const std::vector<std::int32_t>& stations) {
    std::vector<Point> turned;
    turned.reserve(stations.size());
    for (const std::int32_t i : stations)
      turned.push_back(upright(i, unit(columns_.direction[i] + mean_of_neighbours(i))));
    for (std::size_t k = 0; k < stations.size(); ++k) columns_.direction[stations[k]] = turned[k];
  }

  Point mean_of_neighbours(std::int32_t i) const {
    const std::vector<Point>& directions = columns_.direction;
    const std::int32_t a = line_.previous(i), b = line_.next(i);
    if (line_.width(a) == 0) return directions[a];  // cannot occur: a fan's stations are fixed
    if (line_.width(i) == 0) return directions[b];
    return unit((1 / line_.width(a)) * directions[a] + (1 / line_.width(i)) * directions[b]);
  }

  /// Turns a direction towards the bisector until its tilt is small enough on both sides of its station, or
  /// nearly that of the bisector.
  Point upright(std::int32_t i, Point direction) const {
    constexpr int most_turns = 32;
    const Station& station = line_[i];
    const auto stands = [&](Point d) {
      return dot(d, left_of(station.before)) >= least_cosine_of_tilt &&
             dot(d, left_of(station.after)) >= least_cosine_of_tilt;
    };
    for (int turn = 0; turn < most_turns && !stands(direction); ++turn)
      direction = unit(direction + 0.25 * station.direction);
    return direction;
  }

  const WallLine& line_;
  const Communicator* sharing_;  ///< or null
  std::vector<double> h_, leans_;
  std::vector<double> convergence_;  ///< between each station and the next
  std::vector<std::int64_t> seen_;   ///< the last set that each station was added to
  std::int64_t stamp_ = 0;
  std::vector<char> active_;
  std::vector<std::int32_t> stations_;  ///< stations to recompute
  std::vector<char> again_;             ///< flags of stations_
  std::vector<std::int32_t> touched_;   ///< stations whose column length changed by turning
  std::vector<char> turned_;            ///< flags of touched_
  WallColumns columns_;
};

ColumnsOnWall::ColumnsOnWall(const WallLine& line, const Communicator* sharing)
    : columns_{std::make_unique<Columns>(line, sharing)} {}
ColumnsOnWall::~ColumnsOnWall() = default;

const WallColumns& ColumnsOnWall::fit(const std::vector<double>& thickness) {
  return columns_->fit(thickness);
}

}  // namespace quadloop
