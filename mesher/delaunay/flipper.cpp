#include "mesher/delaunay/flipper.hpp"

#include <utility>

#include "mesher/geometry/blunt_corners.hpp"

namespace quadloop {

void Flipper::flip_to_delaunay(std::span<const Point> points, const RankOf& rank_of,
                               std::span<Triangle> triangles, std::span<const char> open,
                               std::span<const std::int32_t> blocks, std::span<const char> moved) {
  points_ = points;
  triangles_ = triangles;
  join(blocks);
  close(open);
  list_firm(moved);
  list_blunt();
  flip_below(edges(), rank_of);
}

void Flipper::flip_first(std::span<const Point> points, const RankOf& rank_of, std::span<Triangle> triangles,
                         std::size_t count, std::span<const std::int32_t> blocks) {
  points_ = points;
  triangles_ = triangles;
  join(blocks);
  close({});
  list_firm({});
  list_blunt();
  flip_below(static_cast<Edge>(3 * count), rank_of);
}

/// Corrects the edges with numbers below `end`, and those that become wrong by this.
void Flipper::flip_below(Edge end, const RankOf& rank_of) {
  for (Edge e = 0; e < end; ++e) {  // edges made wrong by flips are checked in flip_from()
    if (across(e) > e && (is_blunt(e) || is_blunt(across(e))) && !is_firm(e)) flip_from(e, rank_of);
  }
}

/// Flips an edge if it is wrong, then edges made wrong by this.
void Flipper::flip_from(Edge first, const RankOf& rank_of) {
  waiting_.assign(1, first);
  while (!waiting_.empty()) {
    const Edge e = waiting_.back();
    waiting_.pop_back();
    if (across(e) < 0 || !is_wrong(e, rank_of)) continue;
    const Edge s = e - e % 3, t = across(e) - across(e) % 3;
    flip(e);
    waiting_.insert(waiting_.end(), {s, t, s + 2, t + 2});  // not the shared edge, which is now right
  }
}

/// Finds the triangles across the edges. Edges whose other triangle has not been found yet are chained by
/// their lower node; meanwhile across_ holds the next of the chain.
void Flipper::join(std::span<const std::int32_t> blocks) {
  across_.assign(3 * triangles_.size(), border);
  last_low_.assign(points_.size(), border);
  for (Edge e = 0; e < edges(); ++e) {
    Edge* link = &last_low_[low(e)];
    while (*link >= 0 && high(*link) != high(e)) link = &across_[*link];
    const Edge other = *link;
    if (other < 0) {
      across_[e] = std::exchange(last_low_[low(e)], e);
    } else {
      *link = std::exchange(across_[other], border);
      const bool one_block = blocks.empty() || blocks[triangle_of(e)] == blocks[triangle_of(other)];
      if (one_block && !is_kept(e)) set_across(e, other);
    }
  }
}

/// Edges left in the chains have no triangle across.
void Flipper::close(std::span<const char> open) {
  for (Edge e : last_low_) {
    while (e >= 0)
      e = std::exchange(across_[e], !open.empty() && open[triangle_of(e)] != 0 ? open_border : border);
  }
}

void Flipper::list_firm(std::span<const char> moved) {
  firm_.assign(moved.empty() ? 0 : across_.size(), 0);
  if (moved.empty()) return;
  moved_.clear();
  for (const auto& [i, j, k] : triangles_) moved_.push_back(moved[i] != 0 || moved[j] != 0 || moved[k] != 0);
  for (Edge e = 0; e < edges(); ++e) {
    if (across(e) > e && moved_[triangle_of(e)] == 0 && moved_[triangle_of(across(e))] == 0)
      firm_[e] = firm_[across(e)] = 1;
  }
}

void Flipper::list_blunt() {
  blunt_.resize(triangles_.size());
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [i, j, k] = triangles_[t];
    blunt_[t] = static_cast<std::uint8_t>(blunt_corners(points_[i], points_[j], points_[k]));
  }
}

/// The ends of the edge, then the opposite nodes.
std::array<std::size_t, 4> Flipper::nodes_of_both(Edge e) const {
  return {static_cast<std::size_t>(node(e, 1)), static_cast<std::size_t>(node(e, 2)),
          static_cast<std::size_t>(node(e, 0)), static_cast<std::size_t>(node(across(e), 0))};
}

bool Flipper::is_wrong(Edge e, const RankOf& rank_of) const {
  const auto n = nodes_of_both(e);
  const Point &a = points_[n[0]], &b = points_[n[1]], &c = points_[n[2]], &d = points_[n[3]];
  if (surely_acute(a, c, b) && surely_acute(a, d, b)) return false;  // d then lies outside the circle
  if (is_firm(e) && in_circle(a, b, c, d) == 0) return false;
  return should_flip(a, b, c, d, [&](std::size_t k) { return rank_of(static_cast<std::int32_t>(n[k])); });
}

void Flipper::set_across(Edge e, Edge other) {
  across_[e] = other;
  if (other >= 0) across_[other] = e;
}

/// Moves the flags of the outer edges of two triangles to where flip() puts these edges.
void Flipper::keep_firm(Edge e, Edge f) {
  const auto next = [](Edge edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; };
  const Edge s = e - e % 3, t = f - f % 3;
  const char bc = firm_[next(e)], ca = firm_[next(next(e))], ad = firm_[next(f)], db = firm_[next(next(f))];
  firm_[s] = ad;
  firm_[s + 2] = ca;
  firm_[t] = bc;
  firm_[t + 2] = db;
  firm_[s + 1] = firm_[t + 1] = 0;
}

/// The triangles c a b and d b a become c a d and d b c.
void Flipper::flip(Edge e) {
  const Edge f = across(e);
  const auto next = [](Edge edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; };
  const std::int32_t c = node(e, 0), a = node(e, 1), b = node(e, 2), d = node(f, 0);
  const Edge beyond_bc = across(next(e)), beyond_ca = across(next(next(e)));  // opposite a, opposite b
  const Edge beyond_ad = across(next(f)), beyond_db = across(next(next(f)));  // opposite b, opposite a
  const Edge s = e - e % 3, t = f - f % 3;
  if (!firm_.empty()) keep_firm(e, f);
  triangles_[triangle_of(s)] = {c, a, d};
  triangles_[triangle_of(t)] = {d, b, c};
  set_across(s, beyond_ad);
  set_across(s + 2, beyond_ca);
  set_across(t, beyond_bc);
  set_across(t + 2, beyond_db);
  set_across(s + 1, t + 1);
}

}  // namespace quadloop
