#include "smoother/outline/boundary_slide.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "smoother/node/untangle.hpp"

namespace quadloop::smoother {

namespace {

/// Fractions of the distance to the neighbour on that side.
constexpr std::array<double, 4> shares{0.3, 0.12, 0.04, 0.01};
constexpr double straight_sine = 1e-10;
/// Allowed deviation of the geometry from a chord, as a fraction of the shorter chord; the same as in
/// cutting.
constexpr double stray_share = 0.15;
/// Larger ratios of neighbouring edges show in the flow: kinks in the pressure of a node-centred solver.
constexpr double most_uneven = 1.5;
/// Step per visit, as a fraction of the length difference; and the difference, as a fraction of the sum, that
/// ends the steps.
constexpr double step_to_middle = 0.125, even_enough = 1e-3;
/// A chord is not examined if the part of the geometry that it represents is more than this many times as
/// long.
constexpr double longest_way = 20;

}  // namespace

BoundarySlide::BoundarySlide(const Communicator& comm, const HaloMesh& mesh,
                             const std::vector<BoundaryEdges>& boundaries, const OutlinePath* outline,
                             const NodeFlags& pinned, const PeriodicMesh* joined)
    : mesh_{mesh},
      boundaries_{boundaries},
      outline_{outline},
      joined_{joined},
      freedom_(mesh.owned_nodes(), NodeFreedom::interior),
      slot_(mesh.points().size(), -1) {
  for (const HaloEdge& edge : mesh.edges_in_place()) slot_[edge.from] = slot_[edge.to] = 0;
  std::int32_t slots = 0;
  for (std::int32_t& slot : slot_) {
    if (slot >= 0) slot = slots++;
  }
  nodes_.resize(slots);
  for (const BoundaryEdges& boundary : boundaries)
    outlined_.push_back(outline != nullptr && outline->has(boundary.name) ? 1 : 0);
  if (outline != nullptr) find_tight_segments(comm);
  find_rails(pinned);
}

std::optional<OutlinePath::Chord> BoundarySlide::chord_of(const HaloEdge& edge) {
  if (!is_outlined(edge.boundary)) return std::nullopt;
  const OutlinePath::Chord chord{place_of(edge.from, edge.boundary), place_of(edge.to, edge.boundary),
                                 point(edge.from), point(edge.to)};
  if (!chord.from.valid() || chord.from.loop != chord.to.loop) return std::nullopt;
  return chord;
}

void BoundarySlide::find_tight_segments(const Communicator& comm) {
  std::vector<std::int32_t> own;
  OutlinePath::Segments near;
  for (const HaloEdge& edge : mesh_.edges_in_place()) {
    if (!is_outlined(edge.boundary)) continue;
    outline_->find_segments_near(box_of(point(edge.from), point(edge.to)), near);
    for (const NodeId node : {edge.from, edge.to}) {
      if (nodes_[slot_[node]].located.boundary < 0) remember(node, point(node), edge.boundary, near);
    }
    const auto chord = chord_of(edge);
    if (!chord) continue;
    const auto met = outline_->met_elsewhere(*chord, near);
    if (met.empty()) continue;
    const auto stands_for = outline_->segments_between(chord->from, chord->to);
    own.insert(own.end(), met.begin(), met.end());
    own.insert(own.end(), stands_for.begin(), stands_for.end());
  }
  tight_segments_ = comm.all_gather_values(std::span<const std::int32_t>(own));
  std::sort(tight_segments_.begin(), tight_segments_.end());
  tight_segments_.erase(std::unique(tight_segments_.begin(), tight_segments_.end()), tight_segments_.end());
}

bool BoundarySlide::is_tight(const Places& places) const {
  bool found = false;
  const bool few = outline_->walk(places.before, places.after, [&](std::int32_t s) {
    found = found || std::binary_search(tight_segments_.begin(), tight_segments_.end(), s);
  });
  return found || !few;
}

namespace {

/// The boundary edges at an owned node.
struct EdgesAt {
  HaloEdge in, out;  ///< the incoming and the outgoing edge
  int ins = 0, outs = 0;

  bool is_through() const { return ins == 1 && outs == 1 && in.boundary == out.boundary; }
  /// The boundary passes the node more than once, so that its place on the geometry is ambiguous.
  bool is_pinched() const { return ins + outs > 2; }
};

}  // namespace

void BoundarySlide::find_rails(const NodeFlags& pinned) {
  std::vector<EdgesAt> edges_at(nodes_.size());
  for (const HaloEdge& edge : mesh_.edges_in_place()) {
    EdgesAt &at_from = edges_at[slot_[edge.from]], &at_to = edges_at[slot_[edge.to]];
    at_from.out = edge;
    at_to.in = edge;
    ++at_from.outs;
    ++at_to.ins;
  }
  NodeFlags pinched(mesh_.points().size(), 0);
  for (const HaloEdge& edge : mesh_.edges_in_place()) {
    for (const NodeId node : {edge.from, edge.to}) {
      if (!mesh_.owns(node)) continue;
      freedom_[node] = NodeFreedom::fixed;
      pinched[node] = edges_at[slot_[node]].is_pinched() ? 1 : 0;
    }
  }
  mesh_.exchange().update(pinched);
  for_each_flagged(pinned, [&](NodeId node) { freedom_[node] = NodeFreedom::fixed; });
  for (const HaloEdge& edge : mesh_.edges_in_place()) {
    const NodeId node = edge.to;
    if (!mesh_.owns(node) || (!pinned.empty() && pinned[node] != 0)) continue;
    const EdgesAt& at = edges_at[slot_[node]];
    const Rail rail{node, at.in.from, at.out.to, edge.boundary};
    if (!at.is_through() || pinched[rail.before] != 0 || pinched[rail.after] != 0 || !may_slide(rail))
      continue;
    freedom_[node] = NodeFreedom::sliding;
    nodes_[slot_[node]].rail = rail;
  }
}

bool BoundarySlide::is_straight(const Bend& bend) const {
  const Point in = bend.at - bend.before, out = bend.after - bend.at;
  return dot(in, out) > 0 && std::abs(cross(in, out)) <= straight_sine * length(in) * length(out);
}

/// The chords' ends may be kept vertices, whose places are those of any other point.
BoundarySlide::Places BoundarySlide::locate(const Rail& rail) {
  Places places{place_of(rail.before, rail.boundary), place_of(rail.node, rail.boundary),
                place_of(rail.after, rail.boundary)};
  if (places.at.kept) places.at = {};
  return places;
}

BoundarySlide::Places BoundarySlide::locate(const Bend& bend) const {
  const std::string& name = boundaries_[bend.boundary].name;
  Places places{outline_->locate(bend.before, name), outline_->locate(bend.at, name),
                outline_->locate(bend.after, name)};
  if (places.at.kept) places.at = {};
  return places;
}

const OppositeSide* BoundarySlide::opposite_of(std::int32_t boundary) const {
  return joined_ != nullptr && joined_->opposite[boundary].exists() ? &joined_->opposite[boundary] : nullptr;
}

/// The opposite side is walked in the other direction.
BoundarySlide::Bend BoundarySlide::partner_of(const Bend& bend, const OppositeSide& opposite) const {
  const auto image = [&](Point p) { return joined_->maps.image(opposite.shift, p); };
  return {image(bend.after), image(bend.at), image(bend.before), opposite.boundary};
}

OutlinePlace BoundarySlide::place_of(NodeId node, std::int32_t boundary) {
  const Point p = point(node);
  const Located& last = nodes_[slot_[node]].located;
  if (last.boundary != boundary || last.point != p)
    remember(node, p, boundary, outline_->segments_near({p, p}));
  return last.place;
}

/// The place of a point where the node is, or is to be; `near`: the segments near it.
void BoundarySlide::remember(NodeId node, Point p, std::int32_t boundary, const OutlinePath::Segments& near) {
  nodes_[slot_[node]].located = {p, outline_->locate(p, boundaries_[boundary].name, near), boundary};
}

bool BoundarySlide::may_slide(const Rail& rail) {
  const Bend bend = bend_of(rail);
  const OppositeSide* opposite = opposite_of(rail.boundary);
  if (opposite != nullptr && is_outlined(opposite->boundary) != is_outlined(rail.boundary)) return false;
  if (!is_outlined(rail.boundary)) return is_straight(bend);
  if (!may_slide(bend, locate(rail))) return false;
  if (opposite == nullptr) return true;
  const Bend partner = partner_of(bend, *opposite);
  return may_slide(partner, locate(partner));
}

bool BoundarySlide::may_slide(const Bend& bend, const Places& places) const {
  if (!places.at.valid() || places.before.loop != places.at.loop || places.after.loop != places.at.loop)
    return false;
  const double chord = length(bend.at - bend.before) + length(bend.after - bend.at);
  return outline_->way(places.before, places.at) + outline_->way(places.at, places.after) <=
             longest_way * chord &&
         !is_tight(places);
}

bool BoundarySlide::keeps_outline(const Rail& rail, const Places& places, const OutlinePlace& moved,
                                  Point p) {
  const Bend bend = bend_of(rail);
  if (strays(bend, places, moved, p)) return false;
  const OutlinePath::Segments near = outline_->segments_near(box_round(bend, p));
  if (!keeps_clear(bend, places, moved, p, near) || !partner_keeps_outline(bend, p)) return false;
  remember(rail.node, p, rail.boundary, near);
  return true;
}

/// Whether the chords deviate from their part of the geometry by more than now and than the tolerance, with
/// the node at p, at the place `moved`.
bool BoundarySlide::strays(const Bend& bend, const Places& places, const OutlinePlace& moved, Point p) const {
  const Point a = bend.before, b = bend.after;
  const auto deviation = [&](const OutlinePlace& at, Point middle) {
    return std::max(outline_->deviation(places.before, a, at, middle),
                    outline_->deviation(at, middle, places.after, b));
  };
  const double then = deviation(moved, p);
  return then > stray_share * std::min(length(p - a), length(b - p)) && then > deviation(places.at, bend.at);
}

/// Whether the move meets no other part of the geometry; `near`: the segments near box_round().
bool BoundarySlide::keeps_clear(const Bend& bend, const Places& places, const OutlinePlace& moved, Point p,
                                const OutlinePath::Segments& near) const {
  const Point a = bend.before, b = bend.after;
  const OutlinePath::Chord before{places.before, moved, a, p}, after{moved, places.after, p, b},
      both{places.before, places.after, a, b};
  return outline_->met_elsewhere(before, near).empty() && outline_->met_elsewhere(after, near).empty() &&
         !outline_->sweeps_over(both, bend.at, near) && !outline_->sweeps_over(both, p, near);
}

bool BoundarySlide::partner_keeps_outline(const Bend& bend, Point p) const {
  const OppositeSide* opposite = opposite_of(bend.boundary);
  if (opposite == nullptr) return true;
  const Bend partner = partner_of(bend, *opposite);
  const Point image = joined_->maps.image(opposite->shift, p);
  const OutlinePath::Segments near = outline_->segments_near(box_round(partner, image));
  const OutlinePlace moved = outline_->locate(image, boundaries_[partner.boundary].name, near);
  const Places places = locate(partner);
  return places.valid() && moved.valid() && !strays(partner, places, moved, image) &&
         keeps_clear(partner, places, moved, image, near);
}

/// `places` are used if the boundary is on the geometry.
BoundarySlide::Steps BoundarySlide::steps_along(const Rail& rail, const Places& places) const {
  const bool outlined = is_outlined(rail.boundary);
  const Point before = point(rail.before), p = point(rail.node), after = point(rail.after);
  const double back = outlined ? outline_->way(places.before, places.at) : length(p - before);
  const double ahead = outlined ? outline_->way(places.at, places.after) : length(after - p);
  const Point direction = (1 / length(after - before)) * (after - before);
  Steps steps;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    steps.by[k] = shares[k] * ahead;
    steps.by[shares.size() + k] = -shares[k] * back;
  }
  std::array<Point, Star::batch> to;
  if (outlined) outline_->points_at(places.at, steps.by, to);
  for (std::size_t k = 0; k < to.size(); ++k) {
    if (!outlined) to[k] = before + (back + steps.by[k]) * direction;
    steps.x[k] = to[k].x;
    steps.y[k] = to[k].y;
  }
  return steps;
}

double BoundarySlide::unevenness(const Rail& rail, Point p) const {
  const double back = length(p - point(rail.before)), ahead = length(point(rail.after) - p);
  return std::max(back, ahead) / std::min(back, ahead);
}

bool BoundarySlide::keeps_even(const Rail& rail, Point to) const {
  return unevenness(rail, to) <= std::max(most_uneven, unevenness(rail.node));
}

std::optional<Point> BoundarySlide::improve(NodeId node, const Star& star, Objective objective,
                                            double even_up_to) {
  const Rail& rail = rail_of(node);
  const bool outlined = is_outlined(rail.boundary);
  const Places places = outlined ? locate(rail) : Places{};
  if (outlined && !places.valid()) return std::nullopt;
  const Steps steps = steps_along(rail, places);
  for (const int k : ranked_places(star, point(node), objective, steps.x, steps.y)) {
    const Point to = steps.point(k);
    if (!keeps_even(rail, to) && star.worst_cost(point(node)) <= even_up_to) continue;
    if (!outlined || keeps_outline(rail, places, outline_->moved(places.at, steps.by[k]), to)) return to;
  }
  return std::nullopt;
}

/// Prefetches in stages: each stage needs the data fetched by the previous one.
void BoundarySlide::fetch_ahead(std::span<const NodeId> nodes, std::span<const std::int32_t> order,
                                std::size_t k) const {
  constexpr std::size_t farthest = 24, far = 18, near = 12, nearest = 6;
  const auto sliding_at = [&](std::size_t at) -> const BoundaryNode* {
    if (at >= order.size() || freedom_[nodes[order[at]]] != NodeFreedom::sliding) return nullptr;
    return &nodes_[slot_[nodes[order[at]]]];
  };
  if (k + farthest < order.size()) {
    __builtin_prefetch(&freedom_[nodes[order[k + farthest]]]);
    __builtin_prefetch(&slot_[nodes[order[k + farthest]]]);
  }
  if (const BoundaryNode* node = sliding_at(k + far)) __builtin_prefetch(node);
  if (const BoundaryNode* node = sliding_at(k + near)) {
    __builtin_prefetch(&slot_[node->rail.before]);
    __builtin_prefetch(&slot_[node->rail.after]);
    if (node->located.place.valid()) outline_->fetch(node->located.place);
  }
  if (const BoundaryNode* node = sliding_at(k + nearest)) {
    __builtin_prefetch(&nodes_[slot_[node->rail.before]]);
    __builtin_prefetch(&nodes_[slot_[node->rail.after]]);
  }
}

bool BoundarySlide::lies_on(NodeId node, std::span<const double> heights) {
  const Rail& rail = rail_of(node);
  if (!is_outlined(rail.boundary)) return false;
  const Places places = locate(rail);
  if (!places.valid()) return false;
  // Tests from the middle of one edge to the middle of the other: a neighbour at an end of the flagged
  // segments may be located on an unflagged one.
  const double back = outline_->way(places.before, places.at), ahead = outline_->way(places.at, places.after);
  const auto between = outline_->segments_between(outline_->moved(places.at, -back / 2),
                                                  outline_->moved(places.at, ahead / 2));
  return !between.empty() && std::ranges::all_of(between, [&](std::int32_t s) { return heights[s] > 0; });
}

double BoundarySlide::height_at(const HaloEdge& edge, std::span<const double> heights) {
  const auto chord = chord_of(edge);
  if (!chord) return 0;
  const double half_way = outline_->way(chord->from, chord->to) / 2;
  return heights[outline_->moved(chord->from, half_way).segment];
}

std::vector<Point> BoundarySlide::widths_at_fixed(std::span<const double> heights) {
  std::vector<Point> widths(mesh_.points().size());
  for (const HaloEdge& edge : mesh_.edges_in_place()) {
    const auto is_fixed = [&](NodeId n) { return mesh_.owns(n) && freedom_[n] == NodeFreedom::fixed; };
    if ((!is_fixed(edge.from) && !is_fixed(edge.to)) || !(height_at(edge, heights) > 0)) continue;
    const double width = length(point(edge.to) - point(edge.from));
    if (is_fixed(edge.from)) widths[edge.from.value()].y = width;
    if (is_fixed(edge.to)) widths[edge.to.value()].x = width;
  }
  mesh_.exchange().update(widths);
  return widths;
}

std::optional<Point> BoundarySlide::towards_middle(NodeId node, const Star& star,
                                                   std::span<const Point> fixed) {
  const Rail& rail = rail_of(node);
  const Places places = locate(rail);
  if (!places.valid()) return std::nullopt;
  const double back = outline_->way(places.before, places.at), ahead = outline_->way(places.at, places.after);
  const double beyond_back = fixed[rail.before.value()].x, beyond_ahead = fixed[rail.after.value()].y;
  double middle = (back + ahead) / 2;
  if (beyond_back > 0) middle = std::min(middle, std::sqrt(beyond_back * ahead));
  if (beyond_ahead > 0) middle = std::max(middle, back + ahead - std::sqrt(beyond_ahead * back));
  const double step = step_to_middle * 2 * (middle - back);
  if (std::abs(step) <= even_enough * (ahead + back)) return std::nullopt;
  const OutlinePlace moved = outline_->moved(places.at, step);
  const Point to = outline_->point_at(moved);
  const StarCost<1> now = star.cost(point(node), Objective::power), then = star.cost(to, Objective::power);
  const double flattest = std::max(cotangent_of_28, now.largest_cotangent[0]);
  if (!then.valid[0] || then.largest_cotangent[0] > flattest) return std::nullopt;
  if (!keeps_outline(rail, places, moved, to)) return std::nullopt;
  return to;
}

}  // namespace quadloop::smoother
