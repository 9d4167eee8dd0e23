#include "mesher/forest/size_tree.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop {

namespace {

constexpr int slope_bits = 20;
constexpr double turning_unit = 0x1p-20;  // degrees; integers, so that a sum does not depend on its order

}  // namespace

SizeTree::SizeTree(const ShiftedOutline& outline, const Lattice& lattice, const SizeOptions& options,
                   Unresolved unresolved, const DemandedSplits& demanded)
    : outline_{&outline},
      lattice_{&lattice},
      options_{options},
      demanded_{&demanded},
      unresolved_{std::move(unresolved)},
      finest_of_case_{lattice.finest_level(options.min)},
      finest_{std::max(finest_of_case_, demanded.finest_level())},
      coarsest_{1},
      slope_{std::llround((options.gradation - 1) / 2 * static_cast<double>(1 << slope_bits))} {
  while (coarsest_ < finest_of_case_ && lattice.edge(coarsest_) > options.max) ++coarsest_;
  const Geometry& g = outline.geometry();
  const auto line_after = [](std::int64_t line, double at, double coordinate) {
    return at < coordinate ? line + 1 : line;
  };
  const std::int64_t right = lattice.column_at(g.box().high.x), top = lattice.row_at(g.box().high.y);
  domain_ = {lattice.column_at(g.box().low.x), line_after(right, lattice.x(right), g.box().high.x),
             lattice.row_at(g.box().low.y), line_after(top, lattice.y(top), g.box().high.y)};
  if (options.gap) gap_test_.emplace(g);
  for (std::int32_t s = 0; s < g.size(); ++s) {
    spacing_.push_back(g.spacing_of(s));
    corner_spacing_.push_back(g.corner_spacing_of(s));
    if (corner_spacing_.back() > 0) corners_.push_back(s);
    turning_.push_back(g.kept(s) ? 0 : std::llround(g.turn_degrees(s) / turning_unit));
  }
  Node whole;
  whole.corners_end = static_cast<std::int32_t>(corners_.size());
  for (int ty = 0; ty < lattice.trees_y(); ++ty) {
    for (int tx = 0; tx < lattice.trees_x(); ++tx) {
      Node root;
      root.place = {std::int64_t{tx} << Quadrant::unit_level, std::int64_t{ty} << Quadrant::unit_level, 0};
      root.demanded = demanded.root(tx, ty);
      root.segments_begin = static_cast<std::int32_t>(segments_.size());
      const Box box = lattice.box_of(root.place);
      for (std::int32_t s = 0; s < g.size(); ++s) {
        if (outline.meets(s, box)) segments_.push_back(s);
      }
      root.segments_end = static_cast<std::int32_t>(segments_.size());
      take_corners(root, whole, box);
      judge(root, box);
      roots_.push_back(static_cast<std::int32_t>(nodes_.size()));
      nodes_.push_back(root);
    }
  }
}

std::int32_t SizeTree::root_of(const Quadrant& q) const {
  const auto tx = q.x >> Quadrant::unit_level, ty = q.y >> Quadrant::unit_level;
  return roots_[static_cast<std::size_t>(ty * lattice_->trees_x() + tx)];
}

bool SizeTree::is_split(std::int32_t node) {
  if (nodes_[static_cast<std::size_t>(node)].children == Node::unknown) grow(node);
  return nodes_[static_cast<std::size_t>(node)].children >= 0;
}

void SizeTree::grow(std::int32_t node) {
  const Node parent = nodes_[static_cast<std::size_t>(node)];
  if (!wants_split(parent)) {
    nodes_[static_cast<std::size_t>(node)].children = Node::leaf;
    return;
  }
  nodes_[static_cast<std::size_t>(node)].children = static_cast<std::int32_t>(nodes_.size());
  for (const Corner quarter : corners_along_curve) {
    Node child;
    child.place = parent.place.child(quarter);
    child.parent = node;
    if (parent.demanded != DemandedSplits::none) child.demanded = demanded_->child(parent.demanded, quarter);
    child.segments_begin = static_cast<std::int32_t>(segments_.size());
    const Box box = lattice_->box_of(child.place);
    for (std::int32_t i = parent.segments_begin; i < parent.segments_end; ++i) {
      const std::int32_t s = segments_[static_cast<std::size_t>(i)];
      if (outline_->meets(s, box)) segments_.push_back(s);
    }
    child.segments_end = static_cast<std::int32_t>(segments_.size());
    take_corners(child, parent, box);
    judge(child, box);
    nodes_.push_back(child);
  }
  for (std::int32_t n = node;
       n >= 0 && nodes_[static_cast<std::size_t>(n)].deepest_split < parent.place.level;
       n = nodes_[static_cast<std::size_t>(n)].parent) {
    nodes_[static_cast<std::size_t>(n)].deepest_split = parent.place.level;
  }
}

/// Those of the parent's corners that touch the node. A corner on a lattice line touches the leaves on both
/// its sides, so that mirror images agree.
void SizeTree::take_corners(Node& node, const Node& parent, const Box& box) {
  node.corners_begin = static_cast<std::int32_t>(corners_.size());
  for (std::int32_t i = parent.corners_begin; i < parent.corners_end; ++i) {
    const std::int32_t vertex = corners_[static_cast<std::size_t>(i)];
    if (box.contains(outline_->geometry().point(vertex))) corners_.push_back(vertex);
  }
  node.corners_end = static_cast<std::int32_t>(corners_.size());
}

std::span<const std::int32_t> SizeTree::corners_of(const Node& node) const {
  return {corners_.data() + node.corners_begin,
          static_cast<std::size_t>(node.corners_end - node.corners_begin)};
}

/// What can be said of a node's leaves without splitting it.
void SizeTree::judge(Node& node, const Box& box) const {
  const bool holds_outline = node.segments_begin < node.segments_end,
             demanded = node.demanded != DemandedSplits::none;
  const bool made_by_demand =
      node.parent >= 0 && nodes_[static_cast<std::size_t>(node.parent)].demanded != DemandedSplits::none;
  node.plain = !holds_outline && !demanded && !made_by_demand;
  int finest = holds_outline || demanded ? finest_ : coarsest_;
  if (made_by_demand) finest = std::max(finest, node.place.level);
  for (const Source& source : options_.sources) {
    if (!meets(source, box)) continue;
    node.plain = false;
    finest = std::max(finest, level_for(source.spacing));
  }
  for (const std::int32_t vertex : corners_of(node)) {
    node.plain = false;
    finest = std::max(finest, level_for(corner_spacing_[static_cast<std::size_t>(vertex)]));
  }
  node.finest = static_cast<std::int8_t>(finest);
}

/// Whether any of the domain can lie in the quadrant. Where none does, leaves may be larger than `max`: a
/// wide root costs nothing.
bool SizeTree::in_domains_box(const Quadrant& q) const {
  return q.x < domain_[1] && domain_[0] < q.x + q.size() && q.y < domain_[3] && domain_[2] < q.y + q.size();
}

/// As chebyshev_gap.
std::int64_t SizeTree::gap_to_domain(const Quadrant& q) const {
  return std::max({std::int64_t{0}, domain_[0] - (q.x + q.size()), q.x - domain_[1],
                   domain_[2] - (q.y + q.size()), q.y - domain_[3]});
}

/// The coarsest level that a source of this spacing is content with.
int SizeTree::level_for(double spacing) const {
  int level = coarsest_;
  while (level < finest_of_case_ && lattice_->edge(level) > spacing) ++level;
  return level;
}

bool SizeTree::wants_split(const Node& node) {
  const Quadrant& q = node.place;
  if (node.demanded != DemandedSplits::none) return true;
  if (q.level >= finest_of_case_) return false;
  const Box box = lattice_->box_of(q);
  if (q.level < coarsest_ && in_domains_box(q)) return true;
  if (node.plain) return false;
  const double size = lattice_->edge(q.level);
  for (const Source& source : options_.sources) {
    if (size > source.spacing && meets(source, box)) return true;
  }
  const auto too_large_for = [&](std::int32_t vertex) {
    return size > corner_spacing_[static_cast<std::size_t>(vertex)];
  };
  if (std::ranges::any_of(corners_of(node), too_large_for)) return true;
  const std::span<const std::int32_t> inside(
      segments_.data() + node.segments_begin,
      static_cast<std::size_t>(node.segments_end - node.segments_begin));
  if (inside.empty()) return false;
  for (const std::int32_t s : inside) {
    if (size > spacing_[static_cast<std::size_t>(s)]) return true;
  }
  if (options_.curvature && turns_too_far(inside, box)) return true;
  if (gap_test_ && gap_test_->narrower(inside, box, *options_.gap * size)) return true;
  return unresolved_(q, inside);
}

bool SizeTree::turns_too_far(std::span<const std::int32_t> segments, const Box& box) {
  const Geometry& g = outline_->geometry();
  turned_.clear();
  for (const std::int32_t v : segments) {
    const bool inside = outline_->beyond_x(v, box.low.x) && !outline_->beyond_x(v, box.high.x) &&
                        outline_->beyond_y(v, box.low.y) && !outline_->beyond_y(v, box.high.y);
    if (!inside) continue;
    const BoundaryId boundary = g.boundary_of(v);
    const auto known = std::find_if(turned_.begin(), turned_.end(),
                                    [&](const auto& entry) { return entry.first == boundary; });
    if (known == turned_.end()) {
      turned_.emplace_back(boundary, turning_[static_cast<std::size_t>(v)]);
    } else {
      known->second += turning_[static_cast<std::size_t>(v)];
    }
  }
  const auto allowed = std::llround(*options_.curvature / turning_unit);
  return std::any_of(turned_.begin(), turned_.end(),
                     [&](const auto& entry) { return entry.second > allowed; });
}

/// From the node last asked for up to one that holds q, and down again, but not into a plain one: few steps
/// along the curve.
std::int32_t SizeTree::deepest_node_at(const Quadrant& q) {
  std::int32_t node = cursor_;
  while (node >= 0 && !nodes_[static_cast<std::size_t>(node)].place.contains(q))
    node = nodes_[static_cast<std::size_t>(node)].parent;
  if (node < 0) node = root_of(q);
  while (nodes_[static_cast<std::size_t>(node)].place.level < q.level &&
         !nodes_[static_cast<std::size_t>(node)].plain && is_split(node)) {
    const Node& at = nodes_[static_cast<std::size_t>(node)];
    node = at.children + curve_index(quarter_at(q.x, q.y, at.place.level));
  }
  return cursor_ = node;
}

std::span<const std::int32_t> SizeTree::segments_in(const Quadrant& q) {
  const Node& node = nodes_[static_cast<std::size_t>(deepest_node_at(q))];
  const std::span<const std::int32_t> inside(
      segments_.data() + node.segments_begin,
      static_cast<std::size_t>(node.segments_end - node.segments_begin));
  if (inside.empty() || node.place == q) return inside;
  found_.clear();
  const Box box = lattice_->box_of(q);
  for (const std::int32_t s : inside) {
    if (outline_->meets(s, box)) found_.push_back(s);
  }
  return found_;
}

int SizeTree::wanted_level(const Quadrant& leaf) {
  return std::min(leaf.level,
                  std::max(nodes_[static_cast<std::size_t>(deepest_node_at(leaf))].place.level, coarsest_));
}

}  // namespace quadloop
