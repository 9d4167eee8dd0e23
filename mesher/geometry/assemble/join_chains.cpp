#include "mesher/geometry/assemble/join_chains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"

namespace quadloop {

namespace {

std::string text(Point p) { return fmt::format("({}, {})", p.x, p.y); }

constexpr double largest_coordinate = 1e100;

void require_finite(const Chain& chain) {
  for (std::size_t i = 0; i < chain.points.size(); ++i) {
    const double size = std::max(std::abs(chain.points[i].x), std::abs(chain.points[i].y));
    if (size > largest_coordinate && std::isfinite(size)) {
      throw InputError(
          fmt::format("{}: boundary '{}': point {} is {}, beyond 1e100, where areas leave the range of "
                      "double precision; scale it down",
                      chain.source, chain.name, i + 1, text(chain.points[i])));
    }
    if (std::isfinite(chain.points[i].x) && std::isfinite(chain.points[i].y)) continue;
    throw InputError(
        fmt::format("{}: boundary '{}': point {} is {}, which is not finite; correct the coordinates or the "
                    "transformation",
                    chain.source, chain.name, i + 1, text(chain.points[i])));
  }
}

/// The dropped points of one boundary.
struct Dropped {
  std::string name;
  std::int64_t count = 0;
  Point first;
};

/// The ends of open chains, numbered 2 * chain for the first point and 2 * chain + 1 for the last.
class ChainEnds {
 public:
  explicit ChainEnds(const std::vector<Chain>& chains) : chains_{chains} {
    for (std::size_t c = 0; c < chains.size(); ++c) {
      if (!chains[c].open) continue;
      at_[chains[c].points.front()].push_back(2 * c);
      at_[chains[c].points.back()].push_back(2 * c + 1);
    }
  }

  Point point(std::size_t end) const {
    const auto& points = chains_[end / 2].points;
    return end % 2 == 0 ? points.front() : points.back();
  }

  /// Checks that every point where chains end has exactly two ends; rejects the first other point in the
  /// order of input.
  void require_closed() const {
    for (std::size_t end = 0; end < 2 * chains_.size(); ++end) {
      if (!chains_[end / 2].open) continue;
      const auto& ends = at_.at(point(end));
      if (ends.size() == 1) refuse_loose(end);
      if (ends.size() > 2) refuse_fork(end, ends);
    }
  }

  /// The other end at the same point.
  std::size_t partner(std::size_t end) const {
    const auto& ends = at_.at(point(end));
    return ends[0] == end ? ends[1] : ends[0];
  }

 private:
  [[noreturn]] void refuse_loose(std::size_t end) const {
    const Chain& chain = chains_[end / 2];
    std::string nearest;
    double distance = 0;
    for (const auto& [p, ends] : at_) {
      const double d = length(p - point(end));
      if (ends.size() != 1 || p == point(end) || (!nearest.empty() && d >= distance)) continue;
      distance = d;
      nearest = fmt::format("; the nearest other loose end is {} of boundary '{}', {} away", text(p),
                            chains_[ends[0] / 2].name, d);
    }
    throw InputError(fmt::format(
        "{0}: boundary '{1}' is not watertight: its {2} point {3} joins no other chain{4}; make the "
        "end points of the chains identical, give the chain as a closed loop, or, if it is a line "
        "inside the domain, declare it: [[line]] with boundary = \"{1}\"",
        chain.source, chain.name, end % 2 == 0 ? "first" : "last", text(point(end)), nearest));
  }

  [[noreturn]] void refuse_fork(std::size_t end, const std::vector<std::size_t>& ends) const {
    const Chain& chain = chains_[end / 2];
    std::string names;
    for (const std::size_t other : ends)
      names += fmt::format("{}'{}'", names.empty() ? "" : ", ", chains_[other / 2].name);
    throw InputError(fmt::format(
        "{}: boundary '{}': {} chains end at {} ({}), where two should; give each piece of the outline once",
        chain.source, chain.name, ends.size(), text(point(end)), names));
  }

  const std::vector<Chain>& chains_;
  std::map<Point, std::vector<std::size_t>> at_;
};

/// The number of distinct points, counted up to three.
std::size_t distinct_up_to_three(const std::vector<Point>& points) {
  std::array<Point, 3> found;
  std::size_t count = 0;
  for (const Point p : points) {
    if (std::find(found.begin(), found.begin() + count, p) != found.begin() + count) continue;
    found[count++] = p;
    if (count == found.size()) break;
  }
  return count;
}

class Joiner {
 public:
  explicit Joiner(std::vector<Chain> chains)
      : chains_{std::move(chains)}, ends_{chains_}, used_(chains_.size()) {}

  Outline run() {
    ends_.require_closed();
    for (const Chain& chain : chains_) number(chain.name);
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      if (used_[c]) continue;
      OutlineLoop loop;
      loop.source = chains_[c].source;
      loop.directed = chains_[c].directed;
      if (chains_[c].open) {
        join_from(c, loop);
      } else {
        loop.points = std::move(chains_[c].points);
        loop.boundary.assign(loop.points.size(), numbers_.at(chains_[c].name));
        loop.curves = std::move(chains_[c].curves);
      }
      require_area(chains_[c], loop);
      outline_.loops.push_back(std::move(loop));
    }
    return std::move(outline_);
  }

 private:
  void number(const std::string& name) {
    if (!numbers_.try_emplace(name, BoundaryId{size32(outline_.names)}).second) return;
    outline_.names.push_back(name);
  }

  /// Follows chains until the first one is reached again; a chain reached at its last point is traversed
  /// backwards.
  void join_from(std::size_t first, OutlineLoop& loop) {
    std::size_t entered = 2 * first;
    do {
      const std::size_t c = entered / 2;
      std::vector<Point> points = chains_[c].points;
      std::vector<Curve> curves = chains_[c].curves;
      if (entered % 2 == 1) {
        std::reverse(points.begin(), points.end());
        curves = reversed(std::move(curves));
      }
      used_[c] = 1;
      append(std::move(curves), loop);
      loop.points.insert(loop.points.end(), points.begin(), points.end() - 1);
      if (!loop.curves.empty()) loop.curves.resize(loop.points.size());
      loop.boundary.resize(loop.points.size(), numbers_.at(chains_[c].name));
      entered = ends_.partner(entered ^ 1);
    } while (entered != 2 * first);
  }

  /// Appends the shapes of segments, before their points are appended.
  static void append(std::vector<Curve> curves, OutlineLoop& loop) {
    if (curves.empty()) return;
    loop.curves.resize(loop.points.size());
    std::ranges::move(curves, std::back_inserter(loop.curves));
  }

  static void require_area(const Chain& chain, const OutlineLoop& loop) {
    const std::size_t count = distinct_up_to_three(loop.points);
    if (count == 3) return;
    const std::string place = loop.points.empty() ? "" : " near " + text(loop.points.front());
    throw InputError(
        fmt::format("{}: boundary '{}'{} is a loop of {} distinct point{}; a loop needs at least three",
                    chain.source, chain.name, place, count, count == 1 ? "" : "s"));
  }

  std::vector<Chain> chains_;
  ChainEnds ends_;
  std::vector<char> used_;
  std::unordered_map<std::string, BoundaryId> numbers_;
  Outline outline_;
};

}  // namespace

void clean_chains(std::vector<Chain>& chains, std::vector<std::string>& warnings) {
  std::vector<Dropped> dropped;
  for (Chain& chain : chains) {
    require_finite(chain);
    const auto [count, first] = drop_repeats(chain, 0);
    if (count == 0) continue;
    auto of_name =
        std::find_if(dropped.begin(), dropped.end(), [&](const Dropped& d) { return d.name == chain.name; });
    if (of_name == dropped.end()) of_name = dropped.insert(of_name, {chain.name, 0, first});
    of_name->count += count;
  }
  std::erase_if(chains, [](const Chain& chain) { return chain.open && chain.points.size() < 2; });
  for (const Dropped& d : dropped) {
    warnings.push_back(
        fmt::format("boundary '{}': dropped {} point{} that repeat{} the one before, the first at {}", d.name,
                    d.count, d.count == 1 ? "" : "s", d.count == 1 ? "s" : "", text(d.first)));
  }
}

Outline join_chains(std::vector<Chain> chains) { return Joiner(std::move(chains)).run(); }

}  // namespace quadloop
