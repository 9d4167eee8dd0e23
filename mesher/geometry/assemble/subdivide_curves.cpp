#include "mesher/geometry/assemble/subdivide_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/assemble/chain_segments.hpp"
#include "mesher/geometry/assemble/united_islands.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

/// Largest turning angle of a curve over its chord, as a fraction of the turning angle per cell.
constexpr double turn_share = 0.25;
/// Largest distance of a curve from its chord, as a fraction of the requested cell size (by default cells are
/// not smaller than half of it), and of the thickness of layers.
constexpr double height_share = 1.0 / 32, height_in_layers = 1.0 / 500;
/// Curves shorter than this fraction of the extent are not subdivided.
constexpr double shortest_share = 1e-12;
/// Curves that touch are separated by a move of this multiple of the length below which points are joined.
constexpr double clear_of_join = 100;
/// Pieces that may be added to separate curves. Those that run along each other double at each step.
constexpr std::size_t most_added = 20000;

/// A segment, while it is subdivided.
struct Piece {
  CurvedSegment segment;
  std::int32_t whole = 0;  ///< number of the segment that it is a part of

  Piece with(CurvedSegment half) const { return {std::move(half), whole}; }
};

/// The largest turning angle of a curve over its chord, and its largest height above it.
struct ChordLimits {
  double degrees = std::numeric_limits<double>::infinity(), height = degrees;

  void tighten(const ChordLimits& other) {
    degrees = std::min(degrees, other.degrees);
    height = std::min(height, other.height);
  }
  bool hold(const CurvedSegment& segment) const {
    return turning_of_hull(segment) <= degrees &&
           height_of_hull(segment) <= std::min(height, height_share * segment.curve.spacing);
  }
};

/// The chord limits of the boundaries.
class ChordLimitsByName {
 public:
  ChordLimitsByName(const std::vector<Chain>& chains, const AssembleOptions& options) {
    std::vector<std::string> names;
    for (const Chain& chain : chains) {
      if (limits_.try_emplace(chain.name).second) names.push_back(chain.name);
    }
    for (const Boundary& b : boundaries_by_rules(names, options.rules, options.default_corner_degrees))
      limits_.at(b.name) = limits_of(b, options);
  }

  const ChordLimits& at(const std::string& name) const { return limits_.at(name); }

 private:
  static ChordLimits limits_of(const Boundary& b, const AssembleOptions& options) {
    ChordLimits limits{turn_share * std::min(options.cell_degrees, degrees_of_cell), options.chord_height};
    for (const double size : {b.spacing, b.corner_spacing}) {
      if (size > 0) limits.height = std::min(limits.height, height_share * size);
    }
    if (b.layers) limits.height = std::min(limits.height, height_in_layers * layers_thickness(*b.layers));
    return limits;
  }

  std::map<std::string, ChordLimits> limits_;
};

/// Convex hull of the control points, counter-clockwise (Andrew 1979); two points if they are collinear.
std::vector<Point> hull_of(const CurvedSegment& segment) {
  std::vector<Point> points = segment.curve.inner;
  points.insert(points.end(), {segment.from, segment.to});
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Point> hull;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t base = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= base + 2 && orientation(hull[hull.size() - 2], hull.back(), *first) <= 0)
        hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

Box box_of(std::span<const Point> points) {
  Box box;
  for (const Point p : points) box.include(p);
  return box;
}

bool contains(std::span<const Point> hull, Point p) {
  if (hull.size() < 3) return false;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (orientation(hull[i], hull[(i + 1) % hull.size()], p) < 0) return false;
  }
  return true;
}

bool hulls_meet(std::span<const Point> a, std::span<const Point> b) {
  if (contains(a, b.front()) || contains(b, a.front())) return true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (segments_meet(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()])) return true;
    }
  }
  return false;
}

/// The directions from a common corner within which a hull lies: from `right` counter-clockwise to `left`.
struct Cone {
  Point corner, right, left;

  Cone(Point at, std::span<const Point> hull) : corner{at} {
    bool first = true;
    for (const Point p : hull) {
      if (p == at) continue;
      if (first || orientation(at, right, p) < 0) right = p;
      if (first || orientation(at, left, p) > 0) left = p;
      first = false;
    }
  }
  bool holds(Point p) const {
    return dot(p - corner, left - corner) + dot(p - corner, right - corner) > 0 &&
           orientation(corner, right, p) >= 0 && orientation(corner, left, p) <= 0;
  }
  bool meets(const Cone& other) const {
    return holds(other.left) || holds(other.right) || other.holds(left) || other.holds(right);
  }
};

std::optional<Point> common_end(const CurvedSegment& a, const CurvedSegment& b) {
  for (const Point p : {a.from, a.to}) {
    if (p == b.from || p == b.to) return p;
  }
  return {};
}

class Subdivision {
 public:
  Subdivision(const std::vector<Chain>& chains, const AssembleOptions& options)
      : chains_{chains},
        remedy_{options.unite_islands || !options.blocks.empty() ? "" : union_remedy},
        segments_{segments_of(chains)},
        limits_(segments_.size()) {
    const ChordLimitsByName limits(chains, options);
    Box box;
    for (std::int32_t i = 0; i < size32(segments_); ++i) {
      const ChainSegment& s = segments_[i];
      box.include(s.segment.from);
      box.include(s.segment.to);
      if (s.first_equal == i) pieces_.push_back({s.segment, i});
      limits_[s.first_equal].tighten(limits.at(chains[s.chain].name));
    }
    const double extent = std::max(box.width(), box.height());
    shortest_ = shortest_share * extent;
    clear_ = clear_of_join * options.join * extent;
  }

  void run() {
    halve_while([](const Piece& piece) {
      return piece.segment.curve.spacing == 0 && turning_of_hull(piece.segment) > degrees_of_cell;
    });
    for (Piece& piece : pieces_) {
      Curve& curve = piece.segment.curve;
      if (!curve.straight() && curve.spacing == 0) curve.spacing = chord_of(piece);
    }
    halve_while([&](const Piece& piece) { return !limits_[piece.whole].hold(piece.segment); });
    most_pieces_ = pieces_.size() + most_added;
    while (separate()) {
    }
  }

  /// The interpolating curves that touch another one: number of the chain and of the segment in it.
  std::set<std::pair<std::size_t, std::size_t>> touching() const {
    std::set<std::pair<std::size_t, std::size_t>> found;
    for (const ChainSegment& s : segments_) {
      if (touching_.contains(s.first_equal)) found.emplace(s.chain, s.part);
    }
    return found;
  }

  /// The chains with the pieces as their segments.
  std::vector<Chain> chains() const {
    std::vector<std::vector<CurvedSegment>> pieces(segments_.size());
    for (const Piece& piece : pieces_) pieces[piece.whole].push_back(piece.segment);
    std::vector<Chain> chains = chains_;
    replace_segments(chains, segments_, pieces);
    return chains;
  }

 private:
  static double chord_of(const Piece& piece) { return length(piece.segment.to - piece.segment.from); }
  bool can_be_halved(const Piece& piece) const {
    return !piece.segment.curve.straight() && chord_of(piece) + height_of_hull(piece.segment) > shortest_;
  }

  /// Halves curves, and their halves, as long as `test` holds.
  template <class Test>
  void halve_while(const Test& test) {
    std::vector<Piece> halved;
    for (const Piece& piece : pieces_) {
      std::vector<Piece> waiting{piece};
      while (!waiting.empty()) {
        const Piece next = std::move(waiting.back());
        waiting.pop_back();
        if (!can_be_halved(next) || !test(next)) {
          halved.push_back(next);
          continue;
        }
        const auto [first, second] = halves(next.segment);
        waiting.push_back(next.with(second));
        waiting.push_back(next.with(first));
      }
    }
    pieces_ = std::move(halved);
  }

  /// Halves all curves whose hull meets that of another piece. Returns whether there were any.
  bool separate() {
    std::vector<std::vector<Point>> hulls;
    for (const Piece& piece : pieces_) hulls.push_back(hull_of(piece.segment));
    const BoxTree tree(size32(hulls), [&](std::int32_t i) { return box_of(hulls[i]); });
    std::vector<char> meets(pieces_.size(), 0);
    for (std::int32_t i = 0; i < size32(pieces_); ++i) {
      if (pieces_[i].segment.curve.straight()) continue;
      tree.for_each_meeting(box_of(hulls[i]), [&](std::int32_t j) {
        if (i != j && overlap(i, j, hulls)) meets[i] = meets[j] = 1;
      });
    }
    std::vector<Piece> separated;
    bool any = false;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (meets[i] == 0 || !can_be_halved(pieces_[i])) {
        separated.push_back(std::move(pieces_[i]));
        continue;
      }
      any = true;
      const auto [first, second] = halves(pieces_[i].segment);
      separated.push_back(pieces_[i].with(first));
      separated.push_back(pieces_[i].with(second));
    }
    pieces_ = std::move(separated);
    return any;
  }

  /// Whether two pieces have more in common than an end and may be separated. If they are too short to be
  /// halved, or too many, they are touching() or an InputError is thrown; pieces with a common end may touch
  /// each other there in a cusp.
  bool overlap(std::int32_t i, std::int32_t j, const std::vector<std::vector<Point>>& hulls) {
    const Piece &a = pieces_[i], &b = pieces_[j];
    const std::optional<Point> corner = common_end(a.segment, b.segment);
    const bool meet =
        corner ? Cone(*corner, hulls[i]).meets(Cone(*corner, hulls[j])) : hulls_meet(hulls[i], hulls[j]);
    if (!meet) return false;
    if (pieces_.size() <= most_pieces_ && (corner || can_be_halved(a) || can_be_halved(b))) return true;
    if (a.segment.curve.interpolates) touching_.insert(a.whole);
    if (b.segment.curve.interpolates) touching_.insert(b.whole);
    if (!touching_.empty()) return false;
    const Point at = a.segment.from;
    const Chain &of_a = chains_[segments_[a.whole].chain], &of_b = chains_[segments_[b.whole].chain];
    throw InputError(
        fmt::format("{}: boundaries '{}' and '{}' touch, cross or run along each other at ({}, {}); move "
                    "them apart by {:.1g} or more, or remove one{}",
                    of_a.source, of_a.name, of_b.name, at.x, at.y, clear_, remedy_));
  }

  const std::vector<Chain>& chains_;
  const char* remedy_;  ///< added to the advice for boundaries that touch
  std::vector<ChainSegment> segments_;
  std::vector<ChordLimits> limits_;  ///< of each segment, for all that are equal to it
  std::vector<Piece> pieces_;        ///< of the segments without an earlier equal one
  std::set<std::int32_t> touching_;
  double shortest_ = 0;
  double clear_ = 0;  ///< a distance that separates curves that touch
  std::size_t most_pieces_ = 0;
};

}  // namespace

void subdivide_curves(std::vector<Chain>& chains, const AssembleOptions& options, Warnings& warnings) {
  const auto is_curved = [](const Chain& chain) { return !chain.curves.empty(); };
  if (std::ranges::none_of(chains, is_curved)) return;
  std::size_t straightened = 0;
  Point first;
  for (;;) {
    Subdivision subdivision(chains, options);
    subdivision.run();
    if (subdivision.touching().empty()) {
      chains = subdivision.chains();
      break;
    }
    for (const auto& [chain, part] : subdivision.touching()) {
      if (straightened++ == 0) first = chains[chain].points[part];
      chains[chain].curves[part] = {};
    }
  }
  if (straightened > 0)
    warnings.push_back(
        fmt::format("{} of a spline through points, the first at ({:.6g}, {:.6g}): the points are joined by "
                    "straight lines there, as the spline would touch itself or another curve",
                    counted(std::int64_t(straightened), "segment"), first.x, first.y));
}

}  // namespace quadloop
