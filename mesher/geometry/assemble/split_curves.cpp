#include "mesher/geometry/assemble/split_curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "mesher/geometry/assemble/chain_segments.hpp"
#include "mesher/geometry/assemble/curve_meetings.hpp"
#include "mesher/geometry/assemble/subdivide_curves.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/curve_parts.hpp"

namespace quadloop {

namespace {

constexpr double rounding_share = 1e-5;  // of `near`: ends this near to a curve stay

bool is_start(double parameter) { return parameter < nearest_to_end; }
bool is_end(double parameter) { return parameter > 1 - nearest_to_end; }

/// A place where a segment is split.
struct SplitPlace {
  double parameter = 0;
  std::optional<Point> point = {};  ///< none: the point of the curve
};

/// The pieces of a curve of which each turns by one cell, with the ends of their parameters.
struct CellPieces {
  std::vector<double> ends;
  std::vector<double> spacings;

  explicit CellPieces(const CurvedSegment& whole) { add(whole, 0, 1); }

  double spacing_at(double parameter) const {
    const auto end = std::ranges::upper_bound(ends, parameter);
    return spacings[std::min<std::size_t>(end - ends.begin(), ends.size() - 1)];
  }

 private:
  void add(const CurvedSegment& piece, double low, double high) {
    if (piece.curve.spacing == 0 && turning_of_hull(piece) > degrees_of_cell) {
      const auto [first, second] = halves(piece);
      const double middle = 0.5 * (low + high);
      add(first, low, middle);
      add(second, middle, high);
      return;
    }
    ends.push_back(high);
    const Curve& curve = piece.curve;
    spacings.push_back(curve.straight() || curve.spacing > 0 ? curve.spacing : length(piece.to - piece.from));
  }
};

/// A segment with the places where others meet it.
class MetSegment {
 public:
  explicit MetSegment(CurvedSegment segment) : segment_{std::move(segment)} {}

  const CurvedSegment& segment() const { return segment_; }
  bool is_met() const { return !places_.empty(); }
  /// The end at a parameter or within `near` of a point, if there is one.
  std::optional<Point> end_at(double parameter, Point p, double near) const {
    if (is_start(parameter) || length(p - segment_.from) <= near) return segment_.from;
    if (is_end(parameter) || length(p - segment_.to) <= near) return segment_.to;
    return {};
  }

  void add(double parameter, Point point, double near) {
    const auto is_near = [&](const SplitPlace& p) {
      return std::abs(p.parameter - parameter) < nearest_to_end || length(*p.point - point) <= near;
    };
    if (std::ranges::none_of(places_, is_near)) places_.push_back({parameter, point});
  }

  /// The pieces between its places; `moved`: other coordinates of points.
  std::vector<CurvedSegment> split(const std::map<Point, Point>& moved, double near) const {
    const CellPieces cells(segment_);
    const auto placed = [&](Point p) {
      const auto found = moved.find(p);
      return found == moved.end() ? p : found->second;
    };
    std::vector<CurvedSegment> pieces;
    CurvedSegment rest = segment_;
    rest.from = placed(rest.from);
    rest.to = placed(rest.to);
    double reached = 0;
    const auto take = [&](const CurvedSegment& piece, double end) {
      pieces.push_back(piece);
      pieces.back().curve.spacing = cells.spacing_at(0.5 * (reached + end));
      reached = end;
    };
    for (const SplitPlace& place : places_and_ends(cells, near)) {
      auto [before, after] = parts_at_parameter(rest, (place.parameter - reached) / (1 - reached));
      if (place.point) before.to = after.from = placed(*place.point);
      take(before, place.parameter);
      rest = std::move(after);
    }
    take(rest, 1);
    return pieces;
  }

 private:
  /// The places and those ends of cells that are not near them, in order.
  std::vector<SplitPlace> places_and_ends(const CellPieces& cells, double near) const {
    std::vector<SplitPlace> all = places_;
    for (std::size_t i = 0; i + 1 < cells.ends.size(); ++i) {
      const double parameter = cells.ends[i];
      const Point end = quadloop::point_at(segment_, parameter);
      const auto is_near = [&](const SplitPlace& p) {
        return std::abs(p.parameter - parameter) < nearest_to_end || length(*p.point - end) <= 2 * near;
      };
      if (std::ranges::none_of(places_, is_near)) all.push_back({parameter});
    }
    std::ranges::sort(all, {}, &SplitPlace::parameter);
    return all;
  }

  CurvedSegment segment_;
  std::vector<SplitPlace> places_;
};

/// The segments of chains while they are split.
class Splitting {
 public:
  Splitting(const std::vector<Chain>& chains, double near, SplitChains which)
      : chains_{chains}, segments_{segments_of(chains)}, near_{near}, which_{which} {
    for (const ChainSegment& s : segments_) met_.emplace_back(s.segment);
  }

  /// Finds all places. Returns whether there are any.
  bool find() {
    const auto box_at = [&](std::int32_t i) { return box_of(segments_[i].segment); };
    const BoxTree tree(size32(segments_), box_at);
    for (std::int32_t i = 0; i < size32(segments_); ++i) {
      if (segments_[i].first_equal != i) continue;
      const Box box = box_at(i);
      const Point margin{near_, near_};
      tree.for_each_meeting({box.low - margin, box.high + margin}, [&](std::int32_t j) {
        if (j > i && segments_[j].first_equal == j && may_meet(i, j)) meet(i, j);
      });
    }
    return !moved_.empty() || std::ranges::any_of(met_, &MetSegment::is_met);
  }

  void apply_to(std::vector<Chain>& chains) const {
    std::vector<std::vector<CurvedSegment>> pieces(segments_.size());
    for (std::int32_t i = 0; i < size32(segments_); ++i) {
      if (segments_[i].first_equal != i) continue;
      if (met_[i].is_met())
        pieces[i] = met_[i].split(moved_, near_);
      else
        pieces[i] = {with_moved_ends(segments_[i].segment)};
    }
    replace_segments(chains, segments_, pieces);
  }

 private:
  bool is_inner_line(std::int32_t i) const { return chains_[segments_[i].chain].inner_line; }

  bool may_meet(std::int32_t i, std::int32_t j) const {
    const ChainSegment &a = segments_[i], &b = segments_[j];
    if (a.segment.curve.straight() && b.segment.curve.straight()) return false;
    if (a.chain == b.chain) return is_inner_line(i);
    return which_ == SplitChains::all || is_inner_line(i) || is_inner_line(j);
  }

  /// Adds the common points of two segments, of which one at least is a curve.
  void meet(std::int32_t i, std::int32_t j) {
    for (const CurveMeeting& m : meetings_of(segments_[i].segment, segments_[j].segment, near_)) {
      const std::optional<Point> end_of_first = met_[i].end_at(m.on_first, m.point, near_),
                                 end_of_second = met_[j].end_at(m.on_second, m.point, near_);
      if (end_of_first && end_of_second) {
        make_equal(*end_of_first, i, *end_of_second, j);
        continue;
      }
      const Point at = end_of_first    ? end_on(*end_of_first, i, j, m.point)
                       : end_of_second ? end_on(*end_of_second, j, i, m.point)
                                       : m.point;
      if (!end_of_first) met_[i].add(m.on_first, at, near_);
      if (!end_of_second) met_[j].add(m.on_second, at, near_);
    }
  }

  /// Moves the end of an inner line onto that of another segment, from which it differs by no more than
  /// `near`.
  void make_equal(Point of_first, std::int32_t i, Point of_second, std::int32_t j) {
    if (of_first == of_second) return;
    if (is_inner_line(i))
      moved_.try_emplace(of_first, of_second);
    else if (is_inner_line(j))
      moved_.try_emplace(of_second, of_first);
  }

  /// The point that an end of segment i has on segment j.
  Point end_on(Point end, std::int32_t i, std::int32_t j, Point on_both) {
    if (!is_inner_line(i) || segments_[j].segment.curve.straight() ||
        length(end - on_both) <= rounding_share * near_)
      return end;
    return moved_.try_emplace(end, on_both).first->second;
  }

  CurvedSegment with_moved_ends(CurvedSegment segment) const {
    for (Point* const end : {&segment.from, &segment.to}) {
      if (const auto found = moved_.find(*end); found != moved_.end()) *end = found->second;
    }
    return segment;
  }

  const std::vector<Chain>& chains_;
  std::vector<ChainSegment> segments_;
  std::vector<MetSegment> met_;
  std::map<Point, Point> moved_;  ///< ends of inner lines that lie on curves
  double near_;
  SplitChains which_;
};

/// Appends the pieces of a curve of which none turns by more than one cell: they cannot meet themselves.
void append_short_turns(const CurvedSegment& segment, std::vector<CurvedSegment>& pieces) {
  if (turning_of_hull(segment) <= degrees_of_cell) {
    pieces.push_back(segment);
    Curve& curve = pieces.back().curve;
    if (!curve.straight() && curve.spacing == 0) curve.spacing = length(segment.to - segment.from);
    return;
  }
  const auto [first, second] = halves(segment);
  append_short_turns(first, pieces);
  append_short_turns(second, pieces);
}

/// Divides the curves of inner lines, which may cross themselves, into pieces that cannot.
void divide_inner_lines(std::vector<Chain>& chains) {
  const auto is_curved_line = [](const Chain& chain) { return chain.inner_line && !chain.curves.empty(); };
  if (std::ranges::none_of(chains, is_curved_line)) return;
  const std::vector<ChainSegment> segments = segments_of(chains);
  std::vector<char> of_line(segments.size(), 0);
  for (const ChainSegment& s : segments) {
    if (chains[s.chain].inner_line) of_line[s.first_equal] = 1;
  }
  std::vector<std::vector<CurvedSegment>> pieces(segments.size());
  for (std::int32_t i = 0; i < size32(segments); ++i) {
    if (segments[i].first_equal != i) continue;
    if (of_line[i] != 0)
      append_short_turns(segments[i].segment, pieces[i]);
    else
      pieces[i] = {segments[i].segment};
  }
  replace_segments(chains, segments, pieces);
}

}  // namespace

void split_curves_at_crossings(std::vector<Chain>& chains, double near, SplitChains which) {
  if (std::ranges::all_of(chains, [](const Chain& chain) { return chain.curves.empty(); })) return;
  divide_inner_lines(chains);
  Splitting splitting(chains, near, which);
  if (splitting.find()) splitting.apply_to(chains);
}

}  // namespace quadloop
