#include "mesher/layers/front/wall_runs.hpp"

#include <fmt/format.h>

#include <utility>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

/// Whether a column can lie on the adjacent segment; directions of consecutive segments in loop order.
bool can_hold_column(Point before, Point after) {
  constexpr double cosine_of_45 = 0.70710678118654757;
  return cross(before, after) > 0 && std::abs(dot(before, after)) <= cosine_of_45;
}

class Runs {
 public:
  Runs(const Geometry& geometry, const std::vector<std::int32_t>& bare)
      : g_{geometry}, layers_(geometry.points().size()), bare_(geometry.points().size(), 0) {
    for (const std::int32_t s : bare) bare_[s] = 1;
    for (std::int32_t s = 0; s < g_.size(); ++s) {
      if (asks(s)) layers_[s] = g_.boundary_of(s);
    }
  }

  std::vector<WallRun> found() {
    for (std::int32_t s = 0; s < g_.size(); ++s) {
      if (asks(s)) extend(s);
    }
    require_clear_of_lines();
    require_one_count();
    require_own_layers();
    std::vector<WallRun> runs;
    for (std::int32_t loop = 0; loop < g_.loop_count(); ++loop) add_runs_of(loop, runs);
    return runs;
  }

 private:
  bool asks(std::int32_t s) const { return g_.asks_for_layers(s) && !bare_[s]; }
  bool carries(std::int32_t s) const { return layers_[s].valid(); }
  Point direction(std::int32_t s) const { return direction_of(g_.point(s), g_.point(g_.next(s))); }

  /// Extends the layers of segment s to the following and the preceding segments, as long as no column can
  /// lie on them.
  void extend(std::int32_t s) {
    for (std::int32_t from = s, to = g_.next(s);
         !carries(to) && !bare_[to] && !can_hold_column(direction(from), direction(to));
         from = to, to = g_.next(to))
      layers_[to] = layers_[s];
    for (std::int32_t to = s, from = g_.previous(s);
         !carries(from) && !bare_[from] && !can_hold_column(direction(from), direction(to));
         to = from, from = g_.previous(from))
      layers_[from] = layers_[s];
  }

  void require_one_count() const {
    for (std::int32_t s = 0; s < g_.size(); ++s) {
      const std::int32_t t = g_.next(s);
      if (!carries(s) || !carries(t)) continue;
      const Boundary &a = g_.boundary(layers_[s]), &b = g_.boundary(layers_[t]);
      if (a.layers->count == b.layers->count) continue;
      throw InputError(fmt::format(
          "boundaries {} and {} meet at ({:.6g}, {:.6g}), but one has {} layers and the other {}; give "
          "both the same count",
          a.name, b.name, g_.point(t).x, g_.point(t).y, a.layers->count, b.layers->count));
    }
  }

  /// Throws InputError if an inner line begins or ends on a wall with layers.
  void require_clear_of_lines() const {
    for (std::int32_t s = 0; s < g_.size(); ++s) {
      const std::int32_t next = g_.next(s);
      if (g_.is_inner_line(s) == g_.is_inner_line(next)) continue;
      const auto [line, wall] = g_.is_inner_line(s) ? std::pair(s, next) : std::pair(next, s);
      if (!carries(wall)) continue;
      const std::string& with_layers = g_.boundary(layers_[wall]).name;
      throw InputError(fmt::format(
          "inner line '{}' meets boundary {} at ({:.6g}, {:.6g}), where the layers of boundary {} lie; end "
          "the line outside the layers, or remove layers from [boundary.{}]",
          g_.boundary(g_.boundary_of(line)).name, g_.boundary(g_.boundary_of(wall)).name, g_.point(next).x,
          g_.point(next).y, with_layers, with_layers));
    }
  }

  /// Throws InputError if layers continue along, or end on, a boundary between two blocks that has none in
  /// their block: the nodes of the other block would not match.
  void require_own_layers() const {
    for (std::int32_t s = 0; s < g_.size(); ++s) {
      if (g_.twin(s) < 0 || asks(s)) continue;
      const bool at_start = carries(g_.previous(s));
      if (!at_start && !carries(g_.next(s))) continue;
      const std::int32_t wall = at_start ? g_.previous(s) : g_.next(s);
      const Point at = g_.point(at_start ? s : wall);
      const std::string& block = g_.block_names()[g_.block_of(s)];
      throw InputError(fmt::format(
          "boundary {}: its layers in block '{}' end at ({:.6g}, {:.6g}) on boundary {} between two blocks, "
          "which has none there; add [boundary.{}] layers with the same count and layers_in = \"{}\"",
          g_.boundary(layers_[wall]).name, block, at.x, at.y, g_.boundary(g_.boundary_of(s)).name,
          g_.boundary(g_.boundary_of(s)).name, block));
    }
  }

  void add_runs_of(std::int32_t loop, std::vector<WallRun>& runs) const {
    const std::int32_t begin = g_.loop_start(loop), end = g_.loop_start(loop + 1);
    bool whole = true;
    for (std::int32_t s = begin; s < end; ++s) {
      whole = whole && carries(s);
      if (carries(s) && !carries(g_.previous(s))) runs.push_back(run_from(s, false));
    }
    if (whole) runs.push_back(run_from(begin, true));
  }

  WallRun run_from(std::int32_t first, bool closed) const {
    WallRun run{closed, {}, {}};
    std::int32_t s = first;
    do {
      run.segments.push_back(s);
      run.layers.push_back(layers_[s]);
      s = g_.next(s);
    } while (carries(s) && s != first);
    return run;
  }

  const Geometry& g_;
  std::vector<BoundaryId> layers_;  ///< for each segment the boundary that specifies its layers, if any
  std::vector<char> bare_;
};

}  // namespace

std::vector<WallRun> wall_runs(const Geometry& geometry, const std::vector<std::int32_t>& bare) {
  return Runs(geometry, bare).found();
}

Point direction_of(Point from, Point to) {
  const Point along = to - from;
  return (1 / length(along)) * along;
}

}  // namespace quadloop
