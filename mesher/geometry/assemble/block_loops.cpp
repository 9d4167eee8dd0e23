#include "mesher/geometry/assemble/block_loops.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/base/nearest_word.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "mesher/geometry/assemble/half_edges.hpp"
#include "mesher/geometry/assemble/split_loops.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t no_block = -1;

std::string coordinates(Point p) { return fmt::format("({}, {})", p.x, p.y); }

/// What stands on an edge of the graph: the chains on it, the first of which gives name and shape.
struct EdgeLines {
  std::vector<std::int32_t> chains;
  Curve along;           ///< the shape of the even half-edge
  bool against = false;  ///< the first chain runs against the even half-edge
};

/// The chains as a planar graph.
class LineGraph {
 public:
  LineGraph(const std::vector<Chain>& chains, double near) : chains_{chains} {
    const std::vector<SplitLoop> lines = split_lines(chains, near);
    for (std::int32_t c = 0; c < size32(chains); ++c) add(c, lines);
    graph_.link();
  }

  const HalfEdges& graph() const { return graph_; }
  const EdgeLines& lines(std::int32_t h) const { return lines_[h / 2]; }
  const Chain& chain(std::int32_t h) const { return chains_[lines(h).chains.front()]; }
  Curve curve(std::int32_t h) const {
    if (h % 2 == 0) return lines(h).along;
    return reversed(std::vector<Curve>{lines(h).along}).front();
  }
  /// Whether nothing but inner lines is on the edge.
  bool is_inner_line(std::int32_t h) const { return chain(h).inner_line; }
  /// Whether the first of its chains runs along the other half-edge.
  bool runs_against(std::int32_t h) const { return lines(h).against == (h % 2 == 0); }
  bool is_on(std::int32_t h, const std::vector<std::string>& names) const {
    return std::ranges::any_of(
        lines(h).chains, [&](std::int32_t c) { return std::ranges::count(names, chains_[c].name) > 0; });
  }
  const std::vector<Chain>& chains() const { return chains_; }
  /// The inner lines on the edge that do not name it.
  std::vector<const Chain*> covered_lines(std::int32_t h) const {
    std::vector<const Chain*> found;
    for (const std::int32_t c : std::span(lines(h).chains).subspan(1)) {
      if (chains_[c].inner_line) found.push_back(&chains_[c]);
    }
    return found;
  }
  Point start(std::int32_t h) const { return graph_.point(graph_.tail(h)); }
  Point end(std::int32_t h) const { return graph_.point(graph_.head(h)); }

 private:
  void add(std::int32_t c, const std::vector<SplitLoop>& lines) {
    const Chain& chain = chains_[c];
    const SplitLoop& line = lines[c];
    const std::size_t points = line.points.size();
    for (std::size_t i = 0; i < line.segment.size(); ++i) {
      const Point from = line.points[i], to = line.points[(i + 1) % points];
      const std::int32_t h = graph_.add(from, to), segment = line.segment[i];
      lines_.resize(graph_.size() / 2);
      EdgeLines& edge = lines_[h / 2];
      const bool is_new = edge.chains.empty();
      if (is_new || edge.chains.back() != c) edge.chains.push_back(c);
      if (is_new) edge.against = h % 2 != 0;
      if (!is_new || chain.curves.empty() || chain.curves[segment].straight()) continue;
      const bool whole = std::ranges::count(line.segment, segment) == 1;
      if (!whole) refuse_split_curve(chain, to, lines);
      const Curve& curve = chain.curves[segment];
      edge.along = h % 2 == 0 ? curve : reversed(std::vector<Curve>{curve}).front();
    }
  }

  /// For a point on a piece of a curve that is not its end: split_curves_at_crossings() makes crossings and
  /// ends on curves ends of pieces, so that two curves are closer than the tolerance there.
  [[noreturn]] void refuse_split_curve(const Chain& chain, Point p,
                                       const std::vector<SplitLoop>& lines) const {
    const auto text_of = [](const Chain& c) {
      return fmt::format("{} '{}'", c.inner_line ? "inner line" : "boundary", c.name);
    };
    std::string other = "itself";
    for (std::size_t c = 0; c < lines.size(); ++c) {
      if (&chains_[c] != &chain && std::ranges::count(lines[c].points, p) > 0) other = text_of(chains_[c]);
    }
    throw InputError(
        fmt::format("{}: {} is closer than geometry.join to {} at {}, in the middle of a curve; move them "
                    "apart, let both have a point there, or make geometry.join smaller",
                    chain.source, text_of(chain), other, coordinates(p)));
  }

  const std::vector<Chain>& chains_;
  HalfEdges graph_;
  std::vector<EdgeLines> lines_;
};

/// The faces of the graph, holes included; inner lines divide no face. Face `outside()` is the unbounded one.
class Faces {
 public:
  explicit Faces(const LineGraph& lines) : lines_{lines}, graph_{lines.graph()} {
    parent_.resize(graph_.walks() + 1);
    std::iota(parent_.begin(), parent_.end(), 0);
    for (const std::int32_t h : graph_.outermost()) {
      const std::int32_t within = walk_at(lines.start(h));
      parent_[root_of(graph_.walk_of(h))] = root_of(within);
    }
    for (std::int32_t h = 0; h < graph_.size(); h += 2) {
      if (lines.is_inner_line(h)) parent_[root_of(graph_.walk_of(h))] = root_of(graph_.walk_of(h + 1));
    }
    for (std::int32_t& parent : parent_) parent = root_of(parent);
  }

  std::int32_t count() const { return size32(parent_); }
  std::int32_t outside() const { return parent_[graph_.walks()]; }
  std::int32_t left_of(std::int32_t h) const { return parent_[graph_.walk_of(h)]; }
  std::int32_t at(Point p) const { return parent_[walk_at(p)]; }

 private:
  std::int32_t root_of(std::int32_t walk) const {
    while (parent_[walk] != walk) walk = parent_[walk];
    return walk;
  }

  /// The walk whose edge a ray to the left from the point meets first. The ray is slightly higher than the
  /// point.
  std::int32_t walk_at(Point p) const {
    std::int32_t nearest = -1;
    for (std::int32_t e = 0; e < graph_.size(); e += 2) {
      const std::int32_t up = lines_.start(e).y < lines_.end(e).y ? e : e + 1;
      const Point low = lines_.start(up), high = lines_.end(up);
      if (low.y > p.y || high.y <= p.y || orientation(low, high, p) >= 0) continue;
      if (nearest < 0 || is_right_of(up, nearest)) nearest = up;
    }
    return nearest < 0 ? graph_.walks() : graph_.walk_of(nearest ^ 1);
  }

  /// Of two upward edges that one horizontal line meets.
  bool is_right_of(std::int32_t s, std::int32_t t) const {
    const Point s_low = lines_.start(s), s_high = lines_.end(s), t_low = lines_.start(t),
                t_high = lines_.end(t);
    const int low =
        s_low.y >= t_low.y ? orientation(t_low, t_high, s_low) : -orientation(s_low, s_high, t_low);
    if (low != 0) return low < 0;
    return (s_high.y <= t_high.y ? orientation(t_low, t_high, s_high) : -orientation(s_low, s_high, t_high)) <
           0;
  }

  const LineGraph& lines_;
  const HalfEdges& graph_;
  std::vector<std::int32_t> parent_;  ///< of each walk: another walk of the same face
};

/// The block of each face.
class FaceBlocks {
 public:
  FaceBlocks(const std::vector<Chain>& chains, const std::vector<BlockRule>& rules, const LineGraph& lines)
      : chains_{chains}, lines_{lines}, graph_{lines.graph()}, faces_{lines} {
    block_.assign(faces_.count(), no_block);
    for (const BlockRule& rule : rules) apply(rule);
    for (const BlockRule& rule : rules) {
      enclosing_.insert(enclosing_.end(), rule.boundaries.begin(), rule.boundaries.end());
      if (!rule.loop.empty()) enclosing_.push_back(rule.loop);
    }
    for (std::int32_t b = 0; b < size32(names_); ++b) {
      if (std::ranges::count(block_, b) == 0) refuse_covered(rules, names_[b]);
    }
  }

  const std::vector<std::string>& names() const { return names_; }
  std::int32_t left_of(std::int32_t h) const { return block_[faces_.left_of(h)]; }
  /// Whether the half-edge has a block to its left, and bounds it or belongs to an inner line.
  bool bounds(std::int32_t h) const {
    return left_of(h) != no_block && (left_of(h) != left_of(h ^ 1) || lines_.is_inner_line(h));
  }
  /// Whether one block is on both sides of a boundary that encloses a block: a later block covers it there.
  bool is_covered(std::int32_t h) const {
    return left_of(h) != no_block && left_of(h) == left_of(h ^ 1) && lines_.is_on(h, enclosing_);
  }

 private:
  void apply(const BlockRule& rule) {
    std::vector<std::string> boundaries = rule.boundaries;
    if (!rule.loop.empty()) boundaries.push_back(rule.loop);
    for (const std::string& name : boundaries) require_known(rule, name);
    const auto known = std::ranges::find(names_, rule.name);
    const auto block = static_cast<std::int32_t>(known - names_.begin());
    if (known == names_.end()) names_.push_back(rule.name);
    if (rule.inside) {
      block_[face_of_point(rule)] = block;
      return;
    }
    require_closed(rule, boundaries);
    const std::vector<char> covered = faces_within(boundaries);
    for (std::size_t face = 0; face < covered.size(); ++face) {
      if (covered[face] != 0) block_[face] = block;
    }
  }

  std::int32_t face_of_point(const BlockRule& rule) const {
    const Point p = *rule.inside;
    for (std::int32_t e = 0; e < graph_.size(); e += 2) {
      if (lines_.is_inner_line(e)) continue;
      const Point from = lines_.start(e), to = lines_.end(e);
      constexpr double rounding = 1e-9;
      if (length(nearest_on_segment(p, from, to) - p) <= rounding * length(to - from))
        throw InputError(fmt::format("{}: block '{}': the point {} lies on boundary '{}'; move it",
                                     rule.where, rule.name, coordinates(p), lines_.chain(e).name));
    }
    const std::int32_t face = faces_.at(p);
    if (face != faces_.outside()) return face;
    throw InputError(fmt::format(
        "{}: block '{}': the point {} lies outside all boundaries; move it, or add a boundary around it",
        rule.where, rule.name, coordinates(p)));
  }

  void require_known(const BlockRule& rule, const std::string& name) const {
    const auto named = std::ranges::find(chains_, name, &Chain::name);
    if (named != chains_.end() && !named->inner_line) return;
    if (named != chains_.end())
      throw InputError(
          fmt::format("{}: block '{}': '{}' is an inner line, which bounds no block; give its points as a "
                      "boundary of the geometry instead",
                      rule.where, rule.name, name));
    std::vector<std::string> names;
    for (const Chain& chain : chains_) names.push_back(chain.name);
    throw InputError(fmt::format("{}: block '{}': the geometry has no boundary '{}'{}", rule.where, rule.name,
                                 name, guess_for(name, names)));
  }

  /// Each point must have an even number of the boundaries' edges.
  void require_closed(const BlockRule& rule, const std::vector<std::string>& boundaries) const {
    std::vector<char> odd(graph_.vertices(), 0);
    for (std::int32_t h = 0; h < graph_.size(); ++h) {
      if (lines_.is_on(h, boundaries)) odd[graph_.tail(h)] ^= 1;
    }
    const auto loose = std::ranges::find(odd, 1);
    if (loose == odd.end()) return;
    const Point p = graph_.point(static_cast<std::int32_t>(loose - odd.begin()));
    throw InputError(
        fmt::format("{}: block '{}': its boundaries do not close: one ends at {}; name all boundaries around "
                    "the block",
                    rule.where, rule.name, coordinates(p)));
  }

  /// Flags the faces with an odd number of the boundaries' edges between them and the outside.
  std::vector<char> faces_within(const std::vector<std::string>& boundaries) const {
    std::vector<std::vector<std::int32_t>> round(faces_.count());
    for (std::int32_t h = 0; h < graph_.size(); ++h) round[faces_.left_of(h)].push_back(h);
    std::vector<char> within(faces_.count(), 0), known(faces_.count(), 0);
    std::vector<std::int32_t> waiting{faces_.outside()};
    known[faces_.outside()] = 1;
    while (!waiting.empty()) {
      const std::int32_t face = waiting.back();
      waiting.pop_back();
      for (const std::int32_t h : round[face]) {
        const std::int32_t other = faces_.left_of(h ^ 1);
        if (std::exchange(known[other], 1) != 0) continue;
        within[other] = within[face] ^ (lines_.is_on(h, boundaries) ? 1 : 0);
        waiting.push_back(other);
      }
    }
    return within;
  }

  [[noreturn]] static void refuse_covered(const std::vector<BlockRule>& rules, const std::string& name) {
    const auto rule = std::ranges::find(rules, name, &BlockRule::name);
    throw InputError(fmt::format(
        "{}: block '{}' has no region of its own: later blocks cover it; give it before them, or remove it",
        rule->where, name));
  }

  const std::vector<Chain>& chains_;
  const LineGraph& lines_;
  const HalfEdges& graph_;
  Faces faces_;
  std::vector<std::string> names_;
  std::vector<std::int32_t> block_;     ///< of each face
  std::vector<std::string> enclosing_;  ///< the boundaries that rules name
};

/// Names the edges and walks round the blocks.
class LoopMaker {
 public:
  LoopMaker(const LineGraph& lines, const FaceBlocks& blocks)
      : lines_{lines}, graph_{lines.graph()}, blocks_{blocks} {
    for (std::int32_t h = 0; h < graph_.size(); ++h) {
      if (blocks.bounds(h) && !is_inner(h)) sides_of_[lines.chain(h).name].insert(sides(h));
    }
  }

  BlockOutline run() {
    BlockOutline result;
    result.names = blocks_.names();
    for (std::int32_t block = 0; block < size32(result.names); ++block) add_loops_of(block, result);
    return result;
  }

  /// Warns about chains, or parts of them, that bound no block, and about those of inner lines that lie on
  /// other chains. Throws InputError for an inner line of which nothing is left.
  void warn_of_dropped(std::vector<std::string>& warnings) const {
    std::map<std::string, std::pair<std::int64_t, Point>> bare, outside, covered;
    std::map<std::string, std::int32_t> standing;
    const auto note = [&](auto& dropped, const std::string& name, std::int32_t e) {
      ++dropped.try_emplace(name, 0, lines_.start(e)).first->second.first;
    };
    for (std::int32_t e = 0; e < graph_.size(); e += 2) {
      const std::string& name = lines_.chain(e).name;
      if (blocks_.bounds(e) || blocks_.bounds(e + 1))
        ++standing[name];
      else if (!blocks_.is_covered(e))
        note(lines_.chain(e).inner_line ? outside : bare, name, e);
      for (const Chain* chain : lines_.covered_lines(e)) note(covered, chain->name, e);
    }
    for (const Chain& chain : lines_.chains()) {
      if (chain.inner_line && !standing.contains(chain.name))
        throw InputError(fmt::format(
            "{}: inner line '{}' near {} lies outside the domain or on its boundary; move it, or remove it",
            chain.source, chain.name, coordinates(chain.points.front())));
    }
    const auto warn = [&](const auto& dropped, const char* what) {
      for (const auto& [name, found] : dropped)
        warnings.push_back(fmt::format("boundary '{}': {} segment{} {} {} left out, the first at {}", name,
                                       found.first, found.first == 1 ? "" : "s", what,
                                       found.first == 1 ? "was" : "were", coordinates(found.second)));
    };
    warn(bare, "with the same block, or none, on both sides");
    warn(outside, "of the inner line outside the domain");
    warn(covered, "of the inner line that lie on another boundary or line");
  }

 private:
  void add_loops_of(std::int32_t block, BlockOutline& result) const {
    std::vector<char> used(graph_.size(), 0);
    for (std::int32_t h = 0; h < graph_.size(); ++h) {
      if (used[h] != 0 || !blocks_.bounds(h) || blocks_.left_of(h) != block) continue;
      OutlineLoop loop;
      loop.source = lines_.chain(h).source;
      loop.directed = false;
      for (std::int32_t along = h; std::exchange(used[along], 1) == 0; along = next(along)) {
        loop.points.push_back(lines_.start(along));
        loop.boundary.push_back(number_of(name_of(along), result.outline.names));
        loop.curves.push_back(lines_.curve(along));
        loop.returns.push_back(is_inner(along) && lines_.runs_against(along) ? 1 : 0);
      }
      if (std::ranges::all_of(loop.curves, &Curve::straight)) loop.curves.clear();
      result.outline.loops.push_back(std::move(loop));
      result.block_of_loop.push_back(block);
    }
  }

  bool is_inner(std::int32_t h) const { return blocks_.left_of(h) == blocks_.left_of(h ^ 1); }

  std::pair<std::int32_t, std::int32_t> sides(std::int32_t h) const {
    return std::minmax({blocks_.left_of(h), blocks_.left_of(h ^ 1)});
  }

  std::string name_of(std::int32_t h) const {
    const auto [low, high] = sides(h);
    if (low == high) return lines_.chain(h).name;
    const std::string& name = lines_.chain(h).name;
    if (low == no_block || sides_of_.at(name).size() == 1) return name;
    return blocks_.names()[low] + "__" + blocks_.names()[high];
  }

  static BoundaryId number_of(const std::string& name, std::vector<std::string>& names) {
    const auto found = std::ranges::find(names, name);
    const BoundaryId number{static_cast<std::int32_t>(found - names.begin())};
    if (found == names.end()) names.push_back(name);
    return number;
  }

  /// The first edge that bounds the block, clockwise from the reverse of h.
  std::int32_t next(std::int32_t h) const {
    std::int32_t turned = graph_.before(h ^ 1);
    while (!blocks_.bounds(turned) || blocks_.left_of(turned) != blocks_.left_of(h))
      turned = graph_.before(turned);
    return turned;
  }

  const LineGraph& lines_;
  const HalfEdges& graph_;
  const FaceBlocks& blocks_;
  /// For each boundary the pairs of blocks beside its edges.
  std::map<std::string, std::set<std::pair<std::int32_t, std::int32_t>>> sides_of_;
};

}  // namespace

BlockOutline block_loops(const std::vector<Chain>& chains, const std::vector<BlockRule>& rules, double near,
                         std::vector<std::string>& warnings) {
  const LineGraph lines(chains, near);
  const FaceBlocks blocks(chains, rules, lines);
  LoopMaker loops(lines, blocks);
  loops.warn_of_dropped(warnings);
  return loops.run();
}

}  // namespace quadloop
