#include "mesher/geometry/assemble/rounded_ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/chain_segments.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"

namespace quadloop {

namespace {

constexpr double units_in_last_place = 16;

/// The distance along each axis that counts as rounding.
double rounding_of(const std::vector<Chain>& chains) {
  double largest = 0;
  for (const Chain& chain : chains) {
    for (const Point p : chain.points) {
      if (std::isfinite(p.x) && std::isfinite(p.y))
        largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    }
  }
  return units_in_last_place * std::numeric_limits<double>::epsilon() * largest;
}

/// Ends of open chains that coincide exactly with no other end, by place. Number 2 * chain is the first
/// point, 2 * chain + 1 the last.
class LooseEnds {
 public:
  LooseEnds(std::vector<Chain>& chains, double most) : chains_{chains}, most_{most} {
    std::map<Point, std::vector<std::size_t>>& at = all_;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      if (!chains[c].open || chains[c].points.size() < 2) continue;
      at[chains[c].points.front()].push_back(2 * c);
      at[chains[c].points.back()].push_back(2 * c + 1);
    }
    for (const auto& [place, ends] : at) {
      if (ends.size() == 1) loose_.emplace(place, ends.front());
    }
  }

  /// Joins all pairs; returns their number and the first place in the order of input. Throws InputError where
  /// more than two ends meet.
  std::pair<std::int64_t, Point> join() {
    std::map<std::size_t, std::size_t> later_to_earlier;
    for (const auto& [place, end] : loose_) {
      const std::vector<std::size_t> near = others_near(place);
      if (near.size() != 1 || near.front() > end || others_near(point(near.front())).size() != 1 ||
          too_short(end, near.front()))
        continue;
      later_to_earlier.emplace(end, near.front());
    }
    refuse_forks(later_to_earlier);
    std::pair<std::int64_t, Point> joined{0, {}};
    std::size_t first = std::numeric_limits<std::size_t>::max();
    for (const auto& [later, earlier] : later_to_earlier) {
      ++joined.first;
      if (earlier < first) joined.second = point(earlier);
      first = std::min(first, earlier);
      point(later) = point(earlier);
    }
    return joined;
  }

 private:
  Point& point(std::size_t end) const {
    auto& points = chains_[end / 2].points;
    return end % 2 == 0 ? points.front() : points.back();
  }

  /// Calls `take` with each entry of a map by places that is near another place.
  template <class Map, class Take>
  void for_each_near(const Map& map, Point place, Take take) const {
    for (auto at = map.lower_bound({place.x - most_, -std::numeric_limits<double>::infinity()});
         at != map.end() && at->first.x <= place.x + most_; ++at) {
      if (at->first != place && std::abs(at->first.y - place.y) <= most_) take(*at);
    }
  }

  std::vector<std::size_t> others_near(Point place) const {
    std::vector<std::size_t> found;
    for_each_near(loose_, place, [&](const auto& other) { found.push_back(other.second); });
    return found;
  }

  /// An end that stays loose although several others are near it.
  void refuse_forks(const std::map<std::size_t, std::size_t>& later_to_earlier) const {
    std::set<std::size_t> loose;
    for (const auto& [place, end] : loose_) loose.insert(end);
    for (const auto& [later, earlier] : later_to_earlier) {
      loose.erase(later);
      loose.erase(earlier);
    }
    for (const std::size_t end : loose) {
      std::vector<std::size_t> near;
      for_each_near(all_, point(end),
                    [&](const auto& at) { near.insert(near.end(), at.second.begin(), at.second.end()); });
      if (near.size() < 2) continue;
      const Chain& chain = chains_[end / 2];
      std::string names = fmt::format("'{}'", chain.name);
      for (const std::size_t other : near) names += fmt::format(", '{}'", chains_[other / 2].name);
      throw InputError(
          fmt::format("{}: boundary '{}': {} chains end within {:.2g} of ({}, {}) ({}), where two should; "
                      "give each piece "
                      "of the outline once, or make geometry.join smaller if they are different points",
                      chain.source, chain.name, near.size() + 1, most_, point(end).x, point(end).y, names));
    }
  }

  /// A chain that closes on itself needs three points besides the repeated one.
  bool too_short(std::size_t one, std::size_t other) const {
    return one / 2 == other / 2 && chains_[one / 2].points.size() < 4;
  }

  std::vector<Chain>& chains_;
  double most_;
  std::map<Point, std::vector<std::size_t>> all_;  ///< ends by place
  std::map<Point, std::size_t> loose_;
};

double extent_of(const std::vector<Chain>& chains) {
  Box box;
  for (const Chain& chain : chains) {
    for (const Point p : chain.points) {
      if (std::isfinite(p.x) && std::isfinite(p.y)) box.include(p);
    }
  }
  return std::max({0.0, box.width(), box.height()});
}

/// The coordinates of a chain, with those of its curves.
using Trace = std::vector<double>;

Trace trace_of(const std::vector<Point>& points, const std::vector<Curve>& curves) {
  Trace trace;
  for (std::size_t i = 0; i < points.size(); ++i) {
    trace.insert(trace.end(), {points[i].x, points[i].y});
    if (i >= curves.size()) continue;
    trace.push_back(static_cast<double>(curves[i].inner.size()));
    for (const Point p : curves[i].inner) trace.insert(trace.end(), {p.x, p.y});
    trace.insert(trace.end(), curves[i].weights.begin(), curves[i].weights.end());
  }
  return trace;
}

/// The same for a chain and its reverse, and for a loop from any of its points.
Trace trace_either_way(const Chain& chain) {
  std::vector<Point> points = chain.points;
  std::vector<Curve> curves = chain.curves;
  if (!chain.open) {
    const auto first = std::ranges::min_element(points) - points.begin();
    if (!curves.empty()) std::ranges::rotate(curves, curves.begin() + first);
    std::ranges::rotate(points, points.begin() + first);
  }
  const Trace forth = trace_of(points, curves);
  std::reverse(points.begin() + (chain.open ? 0 : 1), points.end());
  return std::min(forth, trace_of(points, reversed(std::move(curves))));
}

/// The name, the number of points and the smallest of them: chains are compared only if these are equal.
using Signature = std::tuple<std::string, std::size_t, Point>;

Signature signature_of(const Chain& chain) {
  return {chain.name, chain.points.size(), *std::ranges::min_element(chain.points)};
}

/// Counts the dropped lines, and keeps the place of the first one.
struct DroppedLines {
  std::int64_t count = 0;
  std::string first;

  void add(const Chain& chain) {
    if (count++ == 0)
      first = fmt::format("of boundary '{}' at ({}, {})", chain.name, chain.points[0].x, chain.points[0].y);
  }
};

void drop_repeated_chains(std::vector<Chain>& chains, DroppedLines& dropped) {
  std::map<Signature, int> alike;
  for (const Chain& chain : chains) {
    if (!chain.points.empty()) ++alike[signature_of(chain)];
  }
  std::set<std::pair<std::string, Trace>> seen;
  std::erase_if(chains, [&](const Chain& chain) {
    if (chain.points.empty() || alike.at(signature_of(chain)) == 1 ||
        seen.insert({chain.name, trace_either_way(chain)}).second)
      return false;
    dropped.add(chain);
    return true;
  });
}

/// The same for a segment and its reverse.
Trace trace_either_way(const CurvedSegment& segment) {
  const CurvedSegment back = reversed(segment);
  return std::min(trace_of({segment.from, segment.to}, {segment.curve}),
                  trace_of({back.from, back.to}, {back.curve}));
}

/// Drops open chains of drawings and maps that repeat a part of others, such as lines over the edges of a
/// polyline: those each of whose segments is part of a chain of that name with more segments.
void drop_repeated_parts(std::vector<Chain>& chains, DroppedLines& dropped) {
  const auto may_repeat = [](const Chain& chain) {
    return chain.open && !chain.directed && chain.points.size() > 1;
  };
  std::set<Point> ends;
  for (const Chain& chain : chains) {
    if (may_repeat(chain)) ends.insert(chain.points.front());
  }
  std::map<std::pair<std::string, Trace>, std::size_t> most_segments;
  for (const Chain& chain : chains) {
    if (std::ranges::none_of(chain.points, [&](Point p) { return ends.contains(p); })) continue;
    const std::vector<ChainSegment> segments = segments_of({chain});
    for (const ChainSegment& s : segments) {
      std::size_t& most = most_segments[{chain.name, trace_either_way(s.segment)}];
      most = std::max(most, segments.size());
    }
  }
  std::erase_if(chains, [&](const Chain& chain) {
    if (!may_repeat(chain)) return false;
    const std::vector<ChainSegment> segments = segments_of({chain});
    const bool repeats = std::ranges::all_of(segments, [&](const ChainSegment& s) {
      const auto known = most_segments.find({chain.name, trace_either_way(s.segment)});
      return known != most_segments.end() && known->second > segments.size();
    });
    if (repeats) dropped.add(chain);
    return repeats;
  });
}

/// Drops lines that are there twice.
void drop_repeated_lines(std::vector<Chain>& chains, std::vector<std::string>& warnings) {
  DroppedLines dropped;
  drop_repeated_chains(chains, dropped);
  drop_repeated_parts(chains, dropped);
  if (dropped.count > 0)
    warnings.push_back(fmt::format("dropped {} line{} that {} twice, the first {}", dropped.count,
                                   dropped.count == 1 ? "" : "s",
                                   dropped.count == 1 ? "is there" : "are there", dropped.first));
}

}  // namespace

void join_rounded_ends(std::vector<Chain>& chains, double share, std::vector<std::string>& warnings) {
  const double rounding = rounding_of(chains);
  std::int64_t dropped = 0;
  for (Chain& chain : chains) dropped += drop_repeats(chain, rounding).first;
  if (dropped > 0) {
    warnings.push_back(
        fmt::format("dropped {} point{} that {} no farther than rounding ({:.2g}) from the one before",
                    dropped, dropped == 1 ? "" : "s", dropped == 1 ? "is" : "are", rounding));
  }
  drop_repeated_lines(chains, warnings);
  const double most = std::max(rounding, share * extent_of(chains));
  const auto [count, first] = LooseEnds(chains, most).join();
  if (count == 0) return;
  warnings.push_back(fmt::format(
      "{} pair{} of chain ends {} no farther apart than {:.2g} and {} joined, the first at ({}, {})", count,
      count == 1 ? "" : "s", count == 1 ? "was" : "were", most, count == 1 ? "was" : "were", first.x,
      first.y));
}

}  // namespace quadloop
