#include "mesher/layers/front/wall_runs.hpp"

#include <fmt/format.h>

#include <string>

#include "mesher/layers/front/layer_end_error.hpp"

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
    require_layers_across();
    require_one_count();
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
      if (!carries(s)) continue;
      const std::int32_t next = g_.next(s),
                         t = carries(next) || g_.twin(next) < 0 ? next : g_.next(g_.twin(next));
      if (!carries(t)) continue;
      const Boundary &a = g_.boundary(layers_[s]), &b = g_.boundary(layers_[t]);
      if (a.layers->count == b.layers->count) continue;
      throw InputError(fmt::format(
          "boundaries {} and {} meet at ({:.6g}, {:.6g}), but one has {} layers and the other {}; give "
          "both the same count",
          a.name, b.name, g_.point(next).x, g_.point(next).y, a.layers->count, b.layers->count));
    }
  }

  /// Throws LayerEndError where layers end on an inner line, or on a boundary between two blocks without
  /// layers in their block, but no layers end on its other side.
  void require_layers_across() const {
    for (std::int32_t s = 0; s < g_.size(); ++s) {
      if (g_.twin(s) < 0 || asks(s)) continue;
      if (carries(g_.previous(s))) require_layers_across(g_.previous(s), s, g_.point(s));
      if (carries(g_.next(s))) require_layers_across(g_.next(s), s, g_.point(g_.next(s)));
    }
  }

  /// `wall` has layers and meets segment `line` at `foot`.
  void require_layers_across(std::int32_t wall, std::int32_t line, Point foot) const {
    const std::int32_t twin = g_.twin(line),
                       across = g_.next(wall) == line ? g_.next(twin) : g_.previous(twin);
    const Boundary &own = g_.boundary(layers_[wall]), &other = g_.boundary(g_.boundary_of(across));
    const auto refuse = [&](const std::string& why) {
      throw LayerEndError(own.name,
                          fmt::format("boundary {}: its layers{} end at ({:.6g}, {:.6g}) on {}, {}", own.name,
                                      in_block(wall), foot.x, foot.y, name_of(line), why));
    };
    if (carries(line) || carries(twin))
      refuse("to which they must have an angle of 45 to 135 degrees; turn this line, or remove the layers");
    if (g_.twin(wall) >= 0)
      refuse("which must not end on a boundary between two blocks with layers; remove the layers");
    if (g_.twin(across) >= 0)
      refuse(
          fmt::format("and {} ends there too; separate the two ends by more than the thickness of the "
                      "layers, or remove the layers",
                      name_of(across)));
    if (!carries(across))
      refuse(
          fmt::format("on the other side of which boundary {} has none{}; add layers with the same count {}",
                      other.name, in_block(across), cure_of(line)));
  }

  std::string in_block(std::int32_t s) const {
    return g_.has_blocks() ? " in block '" + g_.block_names()[g_.block_of(s)] + "'" : "";
  }
  std::string cure_of(std::int32_t line) const {
    if (g_.is_inner_line(line)) return "there, or end the line outside the layers";
    return fmt::format("there, or to [boundary.{}] with layers_in = \"{}\"",
                       g_.boundary(g_.boundary_of(line)).name, g_.block_names()[g_.block_of(line)]);
  }

  std::string name_of(std::int32_t line) const {
    const std::string& name = g_.boundary(g_.boundary_of(line)).name;
    return g_.is_inner_line(line) ? "inner line '" + name + "'" : "boundary " + name + " between two blocks";
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
