#include "mesher/layers/unsound_strips.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/layers/layer_column.hpp"

namespace quadloop {

namespace {

bool turns_left(Point a, Point b, Point c) { return orientation(a, b, c) > 0; }

/// Whether the cells between two columns, given from the wall to the front, are positive.
bool are_positive(const std::vector<Point>& a, const std::vector<Point>& b) {
  for (std::size_t ring = 1; ring < a.size(); ++ring) {
    const Point corners[] = {a[ring - 1], b[ring - 1], b[ring], a[ring]};
    for (std::size_t k = 0; k < 4; ++k) {
      if (!turns_left(corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4])) return false;
    }
  }
  return true;
}

/// The stations after the first place and before the second one.
std::vector<std::int32_t> stations_between(const WallLine& line, const FrontPlace& first,
                                           const FrontPlace& second) {
  std::vector<std::int32_t> stations;
  for (std::int32_t i = first.station; i != second.station;) {
    i = line.next(i);
    if (i != second.station || !second.at_station()) stations.push_back(i);
  }
  return stations;
}

/// Whether both places are in one fan, so that no wall is between their columns.
bool in_one_fan(const WallLine& line, const FrontPlace& first, const FrontPlace& second) {
  for (std::int32_t i = first.station; i != second.station; i = line.next(i)) {
    if (line.width(i) > 0) return false;
  }
  return second.at_station() || line.width(second.station) == 0;
}

/// An edge of the wall in the final mesh, with its nodes in the mesh outside. Known to all ranks.
struct Chord {
  Point from, to;
  GlobalNodeId first, second;
  bool two_sided = false;  ///< on an inner line or between two blocks
};

class Survey {
 public:
  Survey(const LayerFront& front, const Mesh& outer,
         const std::vector<std::vector<std::int32_t>>& edge_leaves)
      : front_{front}, outer_{outer}, edge_leaves_{edge_leaves}, places_{front} {
    columns_.resize(outer_.points.size());
    for (std::size_t b = 0; b < outer_.boundaries.size(); ++b) look_at(b);
    std::exchange(columns_, {});
  }

  std::vector<UnsoundStrip> unsound(const Communicator& comm) && {
    const std::vector<Chord> all = comm.all_gather_values(std::span<const Chord>(chords_));
    mark_pinched(all);
    mark_meeting(all);
    std::vector<UnsoundStrip> found;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      if (bad_[k]) found.push_back(std::move(edges_[k]));
    }
    return found;
  }

 private:
  void look_at(std::size_t b);
  bool is_sound(const UnsoundStrip& strip, const std::array<FrontPlace, 2>& places, Chord& chord);
  /// The column from the wall to the front node, which is its last point.
  const std::vector<Point>& column_to(NodeId node, const FrontPlace& place) {
    std::vector<Point>& column = columns_[node];
    if (column.empty()) {
      column = layer_column(front_, place, outer_.point(node));
      column.push_back(outer_.point(node));
    }
    return column;
  }

  void mark_pinched(const std::vector<Chord>& all) {
    std::vector<GlobalNodeId> begins, twice;
    for (const Chord& chord : all) {
      if (!chord.two_sided) begins.push_back(chord.first);
    }
    std::ranges::sort(begins);
    for (std::size_t k = 1; k < begins.size(); ++k) {
      if (begins[k] == begins[k - 1]) twice.push_back(begins[k]);
    }
    const auto pinched = [&](GlobalNodeId node) { return std::ranges::binary_search(twice, node); };
    for (std::size_t k = 0; k < chords_.size(); ++k) {
      if (pinched(chords_[k].first) || pinched(chords_[k].second)) bad_[k] = 1;
    }
  }

  void mark_meeting(const std::vector<Chord>& all) {
    std::vector<Box> boxes;
    for (const Chord& chord : all) boxes.push_back(box_of(chord.from, chord.to));
    const BoxTree tree(boxes);
    for (std::size_t k = 0; k < chords_.size(); ++k) {
      const Chord& own = chords_[k];
      const bool meets = tree.any_meeting(box_of(own.from, own.to), [&](std::int32_t t) {
        const Chord& other = all[t];
        const bool neighbours =
            own.from == other.from || own.from == other.to || own.to == other.from || own.to == other.to;
        return !neighbours && segments_meet(own.from, own.to, other.from, other.to);
      });
      if (meets) bad_[k] = 1;
    }
  }

  const LayerFront& front_;
  const Mesh& outer_;
  const std::vector<std::vector<std::int32_t>>& edge_leaves_;
  FrontPlaces places_;
  IdVector<NodeId, std::vector<Point>> columns_;
  std::vector<UnsoundStrip> edges_;  ///< all of this rank's edges on fronts; those marked bad are unsound
  std::vector<Chord> chords_;
  std::vector<char> bad_;
};

void Survey::look_at(std::size_t b) {
  const BoundaryId boundary{static_cast<std::int32_t>(b)};
  for (std::size_t e = 0; e < outer_.boundaries[b].edges.size(); ++e) {
    const std::array<NodeId, 2> edge = outer_.boundaries[b].edges[e];
    const std::array<Point, 2> ends{outer_.point(edge[0]), outer_.point(edge[1])};
    const std::array<FrontPlace, 2> places = places_.locate_edge(ends[0], ends[1], boundary);
    const bool on_front = places_.follows(places[0], places[1]);
    // Inner lines and interfaces may begin at any node.
    if (!on_front && outer_.boundaries[b].two_sided()) continue;
    UnsoundStrip strip{edge, edge_leaves_[b][e], {}};
    Chord chord{ends[0], ends[1], outer_.global(edge[0]), outer_.global(edge[1]),
                outer_.boundaries[b].two_sided()};
    bool sound = true;
    if (on_front && !in_one_fan(front_.line, places[0], places[1])) {
      strip.stations = stations_between(front_.line, places[0], places[1]);
      sound = is_sound(strip, places, chord);
    }
    edges_.push_back(std::move(strip));
    chords_.push_back(chord);
    bad_.push_back(sound ? 0 : 1);
  }
}

/// Checks a strip on the front; sets `chord` to that of the wall.
bool Survey::is_sound(const UnsoundStrip& strip, const std::array<FrontPlace, 2>& places, Chord& chord) {
  const std::vector<Point>&a = column_to(strip.edge[0], places[0]), &b = column_to(strip.edge[1], places[1]);
  chord.from = a.front();
  chord.to = b.front();
  if (!are_positive(a, b)) return false;
  const Point along = chord.to - chord.from;
  const double farthest = 0.25 * dot(along, along);
  return std::ranges::none_of(strip.stations, [&](std::int32_t i) {
    return place_on_segment(front_.line[i].wall, chord.from, chord.to).squared_distance > farthest;
  });
}

}  // namespace

std::vector<UnsoundStrip> unsound_strips(const Communicator& comm, const LayerFront& front, const Mesh& outer,
                                         const std::vector<std::vector<std::int32_t>>& edge_leaves) {
  return Survey(front, outer, edge_leaves).unsound(comm);
}

}  // namespace quadloop
