#include "mesher/geometry/geometry.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numbers>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/geometry/point_table.hpp"

namespace quadloop {

namespace {

/// FNV-1a hash of the added bytes.
class Digest {
 public:
  void add(std::uint64_t word) {
    int byte = 0;
    for (; word != 0; ++byte, word >>= 8) hash_ = (hash_ ^ (word & 0xff)) * prime;
    hash_ *= powers_of_prime[8 - byte];  // for the zero bytes
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const std::string& text) {
    add(text.size());
    for (const unsigned char byte : text) add(std::uint64_t{byte});
  }
  std::uint64_t value() const { return hash_; }

 private:
  static constexpr std::uint64_t prime = 0x100000001b3ULL;
  static constexpr std::array<std::uint64_t, 9> powers_of_prime = [] {
    std::array<std::uint64_t, 9> powers{1};
    for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * prime;
    return powers;
  }();
  std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

void digest_layers(const LayerSpec& layers, Digest& digest) {
  digest.add(layers.first);
  digest.add(layers.growth);
  digest.add(layers.growth_to);
  digest.add(std::uint64_t(layers.count));
  digest.add(std::uint64_t(layers.equal));
  // Added only if set, so that hashes of older trees remain valid.
  if (layers.y_plus > 0) digest.add(layers.y_plus);
}

void digest_curve(const Curve& curve, Digest& digest) {
  digest.add(std::uint64_t{curve.inner.size()});
  for (const Point p : curve.inner) {
    digest.add(p.x);
    digest.add(p.y);
  }
  for (const double weight : curve.weights) digest.add(weight);
  digest.add(curve.spacing);
}

const std::string& name_of(const Geometry& geometry, std::int32_t segment) {
  return geometry.boundary(geometry.boundary_of(segment)).name;
}

/// In degrees, 0 to 180.
double turn_between(Point in, Point out) {
  return std::abs(std::atan2(cross(in, out), dot(in, out))) * (180 / std::numbers::pi);
}

/// Compares turning angles with a limit; nearly all are decided by products, without an arc tangent.
class TurnLimit {
 public:
  explicit TurnLimit(double degrees)
      : degrees_{degrees}, tangent_{degrees < 89 ? std::tan(degrees * (std::numbers::pi / 180)) : 0} {}

  bool exceeded_by(Point in, Point out) const {
    const double across = std::abs(cross(in, out)), along = tangent_ * dot(in, out);
    return !surely_less(across, along) && turn_between(in, out) > degrees_;
  }
  bool undercut_by(Point in, Point out) const {
    const double across = std::abs(cross(in, out)), along = tangent_ * dot(in, out);
    return !surely_less(along, across) && turn_between(in, out) < degrees_;
  }

 private:
  static bool surely_less(double a, double b) { return b > 1e-290 && (1 + 1e-12) * a < b; }

  double degrees_, tangent_;
};

std::vector<TurnLimit> corner_limits(const std::vector<Boundary>& boundaries) {
  std::vector<TurnLimit> limits;
  for (const Boundary& boundary : boundaries) limits.emplace_back(boundary.corner_degrees);
  return limits;
}

/// The first segment of a loop at which the boundary changes, or -1 if it never does.
std::int32_t first_change(const Geometry& geometry, std::int32_t loop) {
  for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) {
    if (geometry.boundary_of(v) != geometry.boundary_of(geometry.previous(v))) return v;
  }
  return -1;
}

/// The part of one boundary that begins with segment `first` and ends where another begins.
Chain open_chain(const Geometry& geometry, std::int32_t first) {
  Chain chain{name_of(geometry, first), true, {geometry.point(first)}, {}};
  std::int32_t v = first;
  do {
    if (geometry.has_curves()) chain.curves.push_back(geometry.curve(v));
    v = geometry.next(v);
    chain.points.push_back(geometry.point(v));
  } while (geometry.boundary_of(v) == geometry.boundary_of(first));
  return chain;
}

}  // namespace

Geometry::Geometry(std::vector<Boundary> boundaries, std::vector<Point> points,
                   std::vector<std::int32_t> loop_starts, std::vector<BoundaryId> segment_boundary,
                   std::vector<Curve> curves, LoopBlocks blocks)
    : boundaries_{std::move(boundaries)},
      points_{std::move(points)},
      loop_starts_{std::move(loop_starts)},
      segment_boundary_{std::move(segment_boundary)},
      block_names_{std::move(blocks.names)},
      block_of_loop_{std::move(blocks.of_loop)},
      returns_{std::move(blocks.returns)} {
  QUADLOOP_REQUIRE(segment_boundary_.size() == points_.size(), "a geometry has one segment for each vertex",
                   segment_boundary_.size(), points_.size());
  QUADLOOP_REQUIRE(curves.empty() || curves.size() == points_.size(), "each segment has one shape",
                   curves.size(), points_.size());
  QUADLOOP_REQUIRE(!has_blocks() || std::ssize(block_of_loop_) == loop_count(), "each loop has one block",
                   block_of_loop_.size(), loop_count());
  if (!std::ranges::all_of(curves, &Curve::straight)) curves_ = CurveTable(curves);
  for (const Point p : points_) box_.include(p);
  mark_loops();
  find_twins();
  mark_vertices();
  shorten_spacing_between_corners();
}

void Geometry::mark_loops() {
  std::vector<std::uint8_t> flags(points_.size());
  for (std::int32_t loop = 0; loop < loop_count(); ++loop) {
    flags[loop_start(loop)] |= is_first;
    flags[loop_start(loop + 1) - 1] |= is_last;
  }
  flags_ = std::move(flags);
}

struct Geometry::VertexMarks {
  std::vector<char> kept;
  std::vector<std::uint8_t> flags;
};

void Geometry::mark_vertices() {
  VertexMarks marks{std::vector<char>(points_.size()), {flags_.begin(), flags_.end()}};
  const std::vector<TurnLimit> corners = corner_limits(boundaries_);
  const TurnLimit straight(straight_degrees);
  for (std::int32_t v = 0; v < size(); ++v) {
    const Point in = direction_into(v), out = direction_out_of(v);
    const BoundaryId before = boundary_of(previous(v)), after = boundary_of(v);
    marks.kept[v] = before != after || corners[after.value()].exceeded_by(in, out);
    const bool curved = is_curved(previous(v)) || is_curved(v);
    if (before == after && !curved && straight.undercut_by(in, out)) marks.flags[v] |= is_straight;
  }
  keep_touching_points(marks);
  kept_ = std::move(marks.kept);
  flags_ = std::move(marks.flags);
}

/// Without blocks and inner lines there are none.
void Geometry::find_twins() {
  if (!has_blocks() && !has_inner_lines()) return;
  std::map<std::pair<Point, Point>, std::int32_t> by_ends;
  for (std::int32_t s = 0; s < size(); ++s) by_ends.emplace(std::pair(point(s), point(next(s))), s);
  std::vector<std::int32_t> twins(points_.size(), -1);
  for (std::int32_t s = 0; s < size(); ++s) {
    const auto found = by_ends.find({point(next(s)), point(s)});
    if (found != by_ends.end()) twins[s] = found->second;
  }
  if (std::ranges::any_of(twins, [](std::int32_t twin) { return twin >= 0; })) twins_ = std::move(twins);
}

/// Whether the two segments at the vertex have twins that are neighbours too.
bool Geometry::is_between_twins(std::int32_t v) const {
  const std::int32_t back = twin(v), back_before = twin(previous(v));
  return back >= 0 && back_before >= 0 && next(back) == back_before;
}

void Geometry::keep_touching_points(VertexMarks& marks) const {
  for (std::int32_t v = 0; has_twins() && v < size(); ++v) {
    if (is_tip(v)) marks.kept[v] = 1;
  }
  const PointTable table(points());
  if (!table.any_twice()) return;
  for (std::int32_t v = 0; v < size(); ++v) {
    const std::int32_t first = table.find(point(v));
    if (first == v || is_between_twins(v)) continue;
    for (const std::int32_t touching : {first, v}) {  // two loops touch there, in one node
      marks.kept[touching] = 1;
      marks.flags[touching] &= static_cast<std::uint8_t>(~is_straight);
    }
  }
}

std::optional<Geometry::Stretch> Geometry::stretch_shorter_than(double limit, std::int32_t v) const {
  Stretch stretch{v, 0};
  do {
    const std::int32_t from = stretch.end;
    stretch.end = next(from);
    stretch.length += length(point(stretch.end) - point(from));
  } while (!kept(stretch.end) && stretch.length < limit);
  if (stretch.length >= limit || stretch.end == v) return {};
  return stretch;
}

void Geometry::shorten_spacing_between_corners() {
  std::vector<double> spacing;
  for (std::int32_t v = 0; v < size(); ++v) {
    if (!kept(v)) continue;
    const std::optional<Stretch> stretch = stretch_shorter_than(boundary(boundary_of(v)).spacing, v);
    if (!stretch) continue;
    if (spacing.empty()) {
      for (std::int32_t s = 0; s < size(); ++s) spacing.push_back(spacing_of_boundary(s));
    }
    for (std::int32_t s = v; s != stretch->end; s = next(s)) spacing[s] = stretch->length;
  }
  spacing_ = std::move(spacing);
}

double Geometry::turn_degrees(std::int32_t v) const {
  return turn_between(direction_into(v), direction_out_of(v));
}

double Geometry::chord_turn_degrees(std::int32_t v) const {
  return turn_between(point(v) - point(previous(v)), point(next(v)) - point(v));
}

Geometry Geometry::with(LocalDemands demands) const {
  QUADLOOP_REQUIRE(demands.spacing.size() == points_.size() && demands.kept.size() == points_.size() &&
                       demands.bend_degrees.size() == points_.size(),
                   "one demand for each vertex and each segment");
  Geometry other = *this;
  other.spacing_ = std::move(demands.spacing);
  other.kept_ = std::move(demands.kept);
  other.bend_ = std::move(demands.bend_degrees);
  return other;
}

double Geometry::spacing_of_boundary(std::int32_t segment) const {
  const double wanted = boundary(boundary_of(segment)).spacing;
  if (wanted > 0) return wanted;
  if (is_curved(segment) && curves_.spacing(segment) > 0) return curves_.spacing(segment);
  return length(point(next(segment)) - point(segment));
}

double Geometry::spacing_of(std::int32_t segment) const {
  return spacing_.empty() ? spacing_of_boundary(segment) : spacing_[segment];
}

double Geometry::corner_spacing_of(std::int32_t v) const {
  double least = 0;
  for (const BoundaryId b : {boundary_of(previous(v)), boundary_of(v)}) {
    const double wanted = boundary(b).corner_spacing;
    if (wanted > 0 && (least == 0 || wanted < least) && turn_degrees(v) > boundary(b).corner_degrees)
      least = wanted;
  }
  return least;
}

std::uint64_t Geometry::digest() const { return digest_ ? *digest_ : computed_digest(); }

std::uint64_t Geometry::computed_digest() const {
  Digest digest;
  for (const Boundary& b : boundaries_) {
    digest.add(b.name);
    digest.add(b.condition.word());
    digest.add(b.spacing);
    digest.add(b.corner_degrees);
    if (b.corner_spacing > 0)
      digest.add(b.corner_spacing);  // added only if set, so that hashes of older trees remain valid
    if (b.layers) digest_layers(*b.layers, digest);
    if (!b.layers_in.empty()) digest.add(b.layers_in);
    if (b.baffle) digest.add(std::uint64_t{b.baffle});
  }
  for (const Point p : points_) {
    digest.add(p.x);
    digest.add(p.y);
  }
  for (std::int32_t s = 0; has_curves() && s < size(); ++s) digest_curve(curve(s), digest);
  for (const std::uint64_t start : loop_starts_) digest.add(start);
  for (const BoundaryId b : segment_boundary_) digest.add(static_cast<std::uint64_t>(b.value()));
  for (const std::string& name : block_names_) digest.add(name);
  for (const std::uint64_t block : block_of_loop_) digest.add(block);
  for (const std::uint64_t returns : returns_) digest.add(returns);
  return digest.value();
}

void GeometryBuilder::add(Point vertex, BoundaryId boundary, const Curve& curve, bool returns) {
  if (returns) {
    returns_.resize(points_.size());
    returns_.push_back(1);
  }
  if (!curve.straight()) curves_.resize(points_.size());
  if (!curve.straight() || !curves_.empty()) curves_.push_back(curve);
  points_.push_back(vertex);
  segment_boundary_.push_back(boundary);
}

void GeometryBuilder::end_loop(std::int32_t block) {
  if (loop_starts_.back() == size()) return;
  loop_starts_.push_back(size());
  block_of_loop_.push_back(block);
}

void GeometryBuilder::add_loop(const Geometry& geometry, std::int32_t loop) {
  const std::int32_t begin = geometry.loop_start(loop), end = geometry.loop_start(loop + 1);
  for (std::int32_t v = begin; v < end; ++v) add(geometry, v);
  end_loop(geometry.block_of(begin));
}

Geometry GeometryBuilder::geometry(std::vector<Boundary> boundaries, std::vector<std::string> blocks) && {
  LoopBlocks of_loops;
  if (!blocks.empty()) of_loops = {std::move(blocks), std::move(block_of_loop_)};
  if (!returns_.empty()) returns_.resize(points_.size());
  of_loops.returns = std::move(returns_);
  return Geometry(std::move(boundaries), std::move(points_), std::move(loop_starts_),
                  std::move(segment_boundary_), std::move(curves_), std::move(of_loops));
}

std::vector<Chain> chains_of(const Geometry& geometry) {
  std::vector<Chain> chains;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    const std::int32_t begin = geometry.loop_start(loop), end = geometry.loop_start(loop + 1),
                       change = first_change(geometry, loop);
    if (change < 0) {
      const auto points = geometry.points().subspan(begin, end - begin);
      chains.push_back({name_of(geometry, begin), false, {points.begin(), points.end()}, {}});
      for (std::int32_t v = begin; geometry.has_curves() && v < end; ++v)
        chains.back().curves.push_back(geometry.curve(v));
      continue;
    }
    std::int32_t v = change;
    do {
      chains.push_back(open_chain(geometry, v));
      for (auto segments = chains.back().points.size() - 1; segments > 0; --segments) v = geometry.next(v);
    } while (v != change);
  }
  return chains;
}

}  // namespace quadloop
