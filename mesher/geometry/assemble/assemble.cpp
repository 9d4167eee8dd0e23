#include "mesher/geometry/assemble/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <span>

#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "mesher/geometry/assemble/join_chains.hpp"
#include "mesher/geometry/assemble/rounded_ends.hpp"
#include "mesher/geometry/assemble/split_curves.hpp"
#include "mesher/geometry/assemble/stray_chains.hpp"
#include "mesher/geometry/assemble/subdivide_curves.hpp"
#include "mesher/geometry/assemble/united_islands.hpp"
#include "mesher/geometry/validate.hpp"

namespace quadloop {

namespace {

/// Reverses the loop, keeping its first point.
void turn_round(OutlineLoop& loop) {
  std::reverse(loop.points.begin() + 1, loop.points.end());
  std::reverse(loop.boundary.begin(), loop.boundary.end());
  loop.curves = reversed(std::move(loop.curves));
}

std::string turned_text(const Outline& outline, const OutlineLoop& loop, const LoopNesting& nesting) {
  const std::string& name = outline.names[loop.boundary.front().value()];
  const Point p = loop.points.front();
  std::string text = fmt::format(
      "boundary '{}': the loop from ({}, {}) had the wrong orientation and was reversed", name, p.x, p.y);
  if (nesting.depth == 0)
    text +=
        "; nothing encloses it, so the domain is its inside (to mesh the outside, set geometry.far_field = "
        "..., or add a boundary around it)";
  return text;
}

void orient(Outline& outline, const std::vector<LoopNesting>& nestings, Warnings& warnings) {
  constexpr std::int64_t most_named = 5;
  std::int64_t turned = 0;
  for (std::size_t l = 0; l < outline.loops.size(); ++l) {
    const bool outer = nestings[l].depth % 2 == 0;
    if (outer == nestings[l].counter_clockwise) continue;
    if (outline.loops[l].directed && ++turned <= most_named)
      warnings.push_back(turned_text(outline, outline.loops[l], nestings[l]));
    turn_round(outline.loops[l]);
  }
  if (turned > most_named)
    warnings.push_back(
        fmt::format("reversed {} with the wrong orientation", counted(turned - most_named, "more loop")));
}

const std::string& name_of(const Outline& outline, std::size_t loop) {
  return outline.names[outline.loops[loop].boundary.front().value()];
}

/// Several regions may be intended (a lake on an island) or result from a loop with wrong coordinates.
void warn_of_regions(const Outline& outline, const std::vector<LoopNesting>& nestings, Warnings& warnings) {
  std::vector<std::size_t> enclosing;  // one per region
  for (std::size_t l = 0; l < nestings.size(); ++l) {
    if (nestings[l].depth % 2 == 0) enclosing.push_back(l);
  }
  if (enclosing.size() < 2) return;
  const auto place_of = [&](std::size_t loop) {
    const Point at = outline.loops[loop].points.front();
    return fmt::format("boundary '{}', at ({}, {})", name_of(outline, loop), at.x, at.y);
  };
  warnings.push_back(fmt::format(
      "the domain has {} regions that are not connected; the first is inside {}, the second inside {}; "
      "a body must lie within the outer boundary",
      enclosing.size(), place_of(enclosing[0]), place_of(enclosing[1])));
}

/// Rejects a loop within a loop within the far field, which encloses a domain separate from that of the far
/// field.
void require_far_field_only(const Outline& outline, const std::vector<LoopNesting>& nestings,
                            const std::string& far_field) {
  const auto inner = std::ranges::find(nestings, 2, &LoopNesting::depth);
  if (far_field.empty() || inner == nestings.end()) return;
  const std::size_t loop = inner - nestings.begin();
  const Point at = outline.loops[loop].points.front();
  throw InputError(fmt::format(
      "{}: boundary '{}' already encloses a domain, with boundary '{}' at ({}, {}) in it; remove far_field, "
      "or that inner boundary if '{}' is a solid body",
      far_field, name_of(outline, inner->parent), name_of(outline, loop), at.x, at.y,
      name_of(outline, inner->parent)));
}

void require_outer_boundary(const Outline& outline, const std::vector<LoopNesting>& nestings,
                            const std::vector<std::string>& bodies) {
  for (std::size_t l = 0; l < nestings.size(); ++l) {
    if (nestings[l].depth > 0 || std::ranges::count(bodies, name_of(outline, l)) == 0) continue;
    throw InputError(fmt::format(
        "{}: boundary '{}' has no outer boundary around it; set geometry.far_field to add one, or "
        "geometry.inside = true to mesh the inside of '{}'",
        outline.loops[l].source, name_of(outline, l), name_of(outline, l)));
  }
}

/// Drops boundaries of which a union has left nothing; their rules count as matched.
std::vector<Boundary> boundaries_of(Outline& outline, const AssembleOptions& options) {
  std::vector<Boundary> all =
      boundaries_by_rules(outline.names, options.rules, options.default_corner_degrees);
  std::vector<char> used(all.size(), 0);
  for (const OutlineLoop& loop : outline.loops) {
    for (const BoundaryId b : loop.boundary) used[b.value()] = 1;
  }
  std::vector<Boundary> left;
  std::vector<BoundaryId> new_ids;
  for (std::size_t b = 0; b < all.size(); ++b) {
    new_ids.push_back(BoundaryId{size32(left)});
    if (used[b] != 0) left.push_back(std::move(all[b]));
  }
  for (OutlineLoop& loop : outline.loops) {
    for (BoundaryId& b : loop.boundary) b = new_ids[b.value()];
  }
  return left;
}

std::string right_side_of(const LineRule& baffle) { return baffle.name + "__right"; }

/// The right side of a baffle is a boundary of its own, for which the rules of the left one hold first.
void name_right_sides(Outline& outline, AssembleOptions& options) {
  for (const LineRule& line : options.lines) {
    const auto left = std::ranges::find(outline.names, line.name);
    if (!line.baffle || left == outline.names.end()) continue;
    const BoundaryId of_left{static_cast<std::int32_t>(left - outline.names.begin())};
    const BoundaryId of_right{size32(outline.names)};
    outline.names.push_back(right_side_of(line));
    for (OutlineLoop& loop : outline.loops) {
      for (std::size_t i = 0; i < loop.returns.size(); ++i) {
        if (loop.returns[i] != 0 && loop.boundary[i] == of_left) loop.boundary[i] = of_right;
      }
    }
    const std::vector<BoundaryRule> rules = options.rules;
    for (BoundaryRule rule : rules) {
      if (rule.pattern != line.name) continue;
      rule.pattern = right_side_of(line);
      rule.must_match = false;
      options.rules.insert(options.rules.begin(), rule);
    }
  }
}

void set_kinds_of_lines(const std::vector<LineRule>& lines, std::vector<Boundary>& boundaries) {
  for (Boundary& boundary : boundaries) {
    const auto line = std::ranges::find_if(lines, [&](const LineRule& rule) {
      return boundary.name == rule.name || (rule.baffle && boundary.name == right_side_of(rule));
    });
    if (line == lines.end()) continue;
    boundary.baffle = line->baffle;
    const auto refuse = [&](const std::string& what) {
      throw InputError(fmt::format("{}: inner line '{}' {}", line->where, line->name, what));
    };
    if (boundary.layers) refuse("cannot have layers; remove 'layers' of its boundary");
    if (!line->baffle && boundary.condition != BoundaryCondition{})
      refuse(
          fmt::format("has flow on both sides and takes no bc; remove bc = \"{}\", or set kind = \"baffle\"",
                      boundary.condition.word()));
  }
}

Geometry to_geometry(BlockOutline blocks, AssembleOptions options) {
  Outline& outline = blocks.outline;
  name_right_sides(outline, options);
  std::vector<Boundary> boundaries = boundaries_of(outline, options);
  set_kinds_of_lines(options.lines, boundaries);
  GeometryBuilder builder;
  for (std::size_t l = 0; l < outline.loops.size(); ++l) {
    OutlineLoop& loop = outline.loops[l];
    for (std::size_t i = 0; i < loop.points.size(); ++i)
      builder.add(loop.points[i], loop.boundary[i], loop.curves.empty() ? Curve{} : loop.curves[i],
                  !loop.returns.empty() && loop.returns[i] != 0);
    builder.end_loop(blocks.names.empty() ? 0 : blocks.block_of_loop[l]);
    loop = {};  // frees a long loop at once
  }
  return std::move(builder).geometry(std::move(boundaries), std::move(blocks.names));
}

/// Areas of a much smaller geometry exceed the range of double precision.
void require_extent(const Geometry& g) {
  constexpr double smallest_extent = 1e-100;
  if (std::max(g.box().width(), g.box().height()) >= smallest_extent) return;
  throw InputError(
      fmt::format("boundary '{}' near ({}, {}): the geometry is smaller than 1e-100, out of the range of "
                  "double precision; scale it up",
                  g.boundary(g.boundary_of(0)).name, g.point(0).x, g.point(0).y));
}

void require_countable(const std::vector<Chain>& chains) {
  if (chains.empty())
    throw InputError(
        "the geometry has no boundary, so there is no domain to mesh; name a file with at least one closed "
        "outline");
  std::size_t size = 0;
  for (const Chain& chain : chains) size += chain.points.size();
  if (size > std::numeric_limits<std::int32_t>::max() / 2) {
    throw InputError(fmt::format("the geometry has {} points, more than can be numbered; thin it out", size));
  }
}

/// Boundaries between blocks get their names later.
AssembleOptions without_required_rules(AssembleOptions options) {
  for (BoundaryRule& rule : options.rules) rule.must_match = false;
  return options;
}

/// The tolerance `join` as a length.
double join_length(std::span<const Chain> chains, const AssembleOptions& options) {
  const Box box = box_of(chains);
  return options.join * std::max(box.width(), box.height());
}

/// The loops of blocks and inner lines, which are chains of their own.
BlockOutline loops_with_lines(const std::vector<Chain>& chains, const std::vector<BlockRule>& blocks,
                              const AssembleOptions& options, Warnings& warnings) {
  require_countable(chains);
  return block_loops(chains, blocks, join_length(chains, options), warnings);
}

/// Splits curves at crossings and subdivides them, together with those of inner lines.
void divide_curves(std::vector<Chain>& chains, std::vector<Chain>& lines, SplitChains which,
                   const AssembleOptions& options, Warnings& warnings) {
  const std::size_t count = chains.size();
  std::ranges::move(lines, std::back_inserter(chains));
  split_curves_at_crossings(chains, join_length(chains, options), which);
  subdivide_curves(chains, options, warnings);
  lines.assign(std::make_move_iterator(chains.begin() + std::ptrdiff_t(count)),
               std::make_move_iterator(chains.end()));
  chains.resize(count);
}

BlockOutline outline_of_blocks(std::vector<Chain> chains, std::vector<Chain> lines,
                               const AssembleOptions& options, Warnings& warnings) {
  Warnings of_twins;  // a line between two blocks may be given for each of them
  join_rounded_ends(chains, options.join, of_twins);
  divide_curves(chains, lines, SplitChains::all, without_required_rules(options), warnings);
  std::ranges::move(lines, std::back_inserter(chains));
  return loops_with_lines(chains, options.blocks, options, warnings);
}

/// The outline of a domain of one block; curves of inner lines are divided with those of the outline.
Outline outline_of_domain(std::vector<Chain> chains, std::vector<Chain>& lines,
                          const AssembleOptions& options, Warnings& warnings) {
  join_rounded_ends(chains, options.join, warnings);
  leave_out_strays(chains, options.far_field, warnings);
  divide_curves(chains, lines, options.unite_islands ? SplitChains::all : SplitChains::inner_lines,
                options.lines.empty() ? options : without_required_rules(options), warnings);
  require_countable(chains);
  Outline outline = join_chains(std::move(chains));
  if (options.unite_islands) outline = united_islands(outline, options.join, warnings);
  match_outlines(outline, options.pairs, warnings);
  const std::vector<LoopNesting> nestings = validate(outline, options.unite_islands ? "" : union_remedy);
  require_far_field_only(outline, nestings, options.far_field);
  require_outer_boundary(outline, nestings, options.bodies);
  Warnings of_domain;
  orient(outline, nestings, of_domain);
  warn_of_regions(outline, nestings, of_domain);
  if (!options.domain_is_known) warnings.insert(warnings.end(), of_domain.begin(), of_domain.end());
  return outline;
}

Chain chain_of_path(const LineRule& rule, double corner_degrees) {
  Chain chain{rule.name, true, rule.path, rule.where};
  if (rule.path.size() > 1 && rule.path.front() == rule.path.back()) {
    chain.open = false;
    chain.points.pop_back();
  }
  if (rule.spline) join_by_splines(chain, corner_degrees);
  return chain;
}

/// Refuses names that would stand for a baffle, or for its right side, and for something else as well.
void require_own_names(const std::vector<Chain>& chains, const std::vector<LineRule>& lines) {
  std::map<std::string, const LineRule*> first_of, baffle_of_right_side;
  for (const LineRule& line : lines) {
    const LineRule& first = *first_of.emplace(line.name, &line).first->second;
    if (line.baffle != first.baffle)
      throw InputError(fmt::format(
          "{}: line '{}' has the name of a line of another kind ({}); give one of them another name",
          line.where, line.name, first.where));
    if (line.baffle) baffle_of_right_side.emplace(right_side_of(line), &line);
  }
  const auto require_other = [&](const std::string& where, const std::string& name) {
    const auto found = baffle_of_right_side.find(name);
    if (found == baffle_of_right_side.end()) return;
    throw InputError(
        fmt::format("{}: '{}' is also the name of the right side of baffle '{}' ({}); give one of "
                    "them another name",
                    where, name, found->second->name, found->second->where));
  };
  for (const LineRule& line : lines) require_other(line.where, line.name);
  for (const Chain& chain : chains) require_other(chain.source, chain.name);
}

/// Moves the chains of inner lines out of `chains`, and adds those of paths.
std::vector<Chain> take_lines(std::vector<Chain>& chains, const AssembleOptions& options) {
  std::vector<Chain> lines;
  for (const LineRule& rule : options.lines) {
    const std::size_t before = lines.size();
    std::erase_if(chains, [&](Chain& chain) {
      if (chain.name != rule.name && chain.name != rule.boundary) return false;
      if (rule.boundary.empty())
        throw InputError(
            fmt::format("{}: line '{}': the geometry has a boundary of this name already; give the "
                        "line another name, or set boundary = \"{}\" instead of a path",
                        rule.where, rule.name, rule.name));
      lines.push_back(std::move(chain));
      return true;
    });
    if (!rule.boundary.empty() && lines.size() == before)
      throw InputError(fmt::format("{}: line '{}': the geometry has no boundary '{}'", rule.where, rule.name,
                                   rule.boundary));
    if (rule.boundary.empty()) lines.push_back(chain_of_path(rule, options.default_corner_degrees));
    for (std::size_t l = before; l < lines.size(); ++l) {
      lines[l].name = rule.name;
      lines[l].inner_line = true;
    }
  }
  require_own_names(chains, options.lines);
  return lines;
}

/// The parts of the loops on one boundary each, as chains.
std::vector<Chain> chains_of(const Outline& outline) {
  std::vector<Chain> chains;
  for (const OutlineLoop& loop : outline.loops) {
    const std::size_t count = loop.points.size();
    const auto changes = [&](std::size_t i) {
      return loop.boundary[i] != loop.boundary[(i + count - 1) % count];
    };
    std::size_t first = 0;
    while (first < count && !changes(first)) ++first;
    const bool closed = first == count;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = (first + k) % count;
      if (k == 0 || changes(i)) {
        if (k > 0) chains.back().points.push_back(loop.points[i]);
        chains.push_back({outline.names[loop.boundary[i].value()], !closed, {}, loop.source, loop.directed});
      }
      chains.back().points.push_back(loop.points[i]);
      if (!loop.curves.empty()) chains.back().curves.push_back(loop.curves[i]);
    }
    if (!closed) chains.back().points.push_back(loop.points[first]);
  }
  return chains;
}

BlockOutline with_lines(const Outline& outline, std::vector<Chain> lines, const AssembleOptions& options,
                        Warnings& warnings) {
  BlockRule domain{"domain", outline.names, {}, {}, {}};
  std::vector<Chain> chains = chains_of(outline);
  std::move(lines.begin(), lines.end(), std::back_inserter(chains));
  BlockOutline result = loops_with_lines(chains, {domain}, options, warnings);
  result.names.clear();
  return result;
}

}  // namespace

Geometry assemble(std::vector<Chain> chains, const AssembleOptions& options, Warnings& warnings) {
  std::vector<Chain> lines = take_lines(chains, options);
  clean_chains(chains, warnings);
  clean_chains(lines, warnings);
  BlockOutline outline;
  if (!options.blocks.empty()) {
    outline = outline_of_blocks(std::move(chains), std::move(lines), options, warnings);
  } else {
    outline.outline = outline_of_domain(std::move(chains), lines, options, warnings);
    if (!lines.empty()) outline = with_lines(outline.outline, std::move(lines), options, warnings);
  }
  Geometry geometry = to_geometry(std::move(outline), options);
  require_extent(geometry);
  return geometry;
}

}  // namespace quadloop
