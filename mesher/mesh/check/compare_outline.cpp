#include "mesher/mesh/check/compare_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

namespace {

constexpr double sharp_degrees = 30;
/// Maximum ratio of a quadtree cell to its fragments, and their maximum distance from a loop in sizes.
constexpr double fragments = 2, loop_reach = 4;

/// Segments with a nearest-segment search.
class SegmentSet {
 public:
  void add(Point a, Point b, const Curve& curve = {}) {
    if (!curve.straight()) curves_.resize(segments_.size());
    if (!curve.straight() || !curves_.empty()) curves_.push_back(curve);
    segments_.emplace_back(a, b);
  }
  void build() {
    std::vector<Box> boxes;
    for (const auto& [a, b] : segments_) boxes.push_back(box_of(a, b));
    tree_ = BoxTree(boxes);
  }
  /// Returns the nearest segment, the lowest number of equals, and its distance, from a curve along the
  /// normal of its chord; infinite if there is none.
  std::pair<std::uint32_t, double> nearest(Point p) const {
    if (segments_.empty()) return {0, std::numeric_limits<double>::infinity()};
    const std::uint32_t found = tree_.nearest(p, [&](std::int32_t number) {
      const auto& [a, b] = segments_[number];
      return place_on_segment(p, a, b).squared_distance;
    });
    const auto& [a, b] = segments_[found];
    if (!curves_.empty() && !curves_[found].straight())
      return {found, length(p - above_chord({a, curves_[found], b}, p).point)};
    return {found, distance_to_segment(p, a, b)};
  }

 private:
  std::vector<std::pair<Point, Point>> segments_;
  std::vector<Curve> curves_;  ///< of each segment; empty: all are straight
  BoxTree tree_;
};

/// All chains of one name.
struct NamedOutline {
  std::vector<std::size_t> chains;         ///< indices of the chains
  std::vector<std::size_t> segment_chain;  ///< chain of each segment
  SegmentSet segments;
};

template <class Visit>
void for_each_segment(const Chain& chain, const Visit& visit) {
  const std::size_t count = chain.points.size();
  for (std::size_t i = 0; i + (chain.open ? 1 : 0) < count; ++i)
    visit(chain.points[i], chain.points[(i + 1) % count], chain.curves.empty() ? Curve{} : chain.curves[i]);
}

std::map<std::string, NamedOutline> outlines_of(std::span<const Chain> geometry) {
  std::map<std::string, NamedOutline> outlines;
  for (std::size_t c = 0; c < geometry.size(); ++c) {
    NamedOutline& outline = outlines[geometry[c].name];
    outline.chains.push_back(c);
    for_each_segment(geometry[c], [&](Point a, Point b, const Curve& curve) {
      outline.segments.add(a, b, curve);
      outline.segment_chain.push_back(c);
    });
  }
  for (auto& [name, outline] : outlines) outline.segments.build();
  return outlines;
}

std::vector<Point> sharp_points(std::span<const Chain> geometry) {
  std::vector<Point> sharp;
  for (const Chain& chain : geometry) {
    const auto& p = chain.points;
    if (p.empty()) continue;
    if (chain.open) sharp.insert(sharp.end(), {p.front(), p.back()});
    for (std::size_t i = 0; i < p.size() && !chain.open; ++i) {
      const Point in = p[i] - p[(i + p.size() - 1) % p.size()], out = p[(i + 1) % p.size()] - p[i];
      const double turn = 180 - std::abs(corner_degrees(p[i] - in, p[i], p[i] + out));
      if (turn > sharp_degrees) sharp.push_back(p[i]);
    }
  }
  return sharp;
}

/// Compares boundaries and geometry, boundary by boundary.
class Comparison {
 public:
  Comparison(const MeshOutline& outline, std::span<const Chain> geometry, double tolerance)
      : outline_{outline},
        mesh_{outline.boundaries},
        geometry_{geometry},
        outlines_{outlines_of(geometry)},
        met_(geometry.size(), 0),
        centre_{outline.box.centre()},
        tolerance_{tolerance * std::max(outline.box.width(), outline.box.height())} {
    std::size_t first = 0;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      if (boundary.inner_line) lines_.insert(boundary.name);
      first_edges_.push_back(first);
      first += boundary.edges.size();
    }
  }

  OutlineComparison run() {
    std::set<std::string> present;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      if (boundary.edges.empty()) continue;
      present.insert(boundary.name);
      const auto outline = outlines_.find(boundary.name);
      if (outline == outlines_.end()) {
        fault("the geometry has no boundary " + boundary.name, mesh_.point(boundary.edges.front()[0]));
        continue;
      }
      compare_nodes(boundary, outline->second);
      meet_single_edges(boundary, outline->second);
      compare_points(boundary, outline->second);
    }
    for (const auto& [name, outline] : outlines_) fit_.boundaries_dropped += present.contains(name) ? 0 : 1;
    if (outline_.blocks > 1 || !lines_.empty()) meet_twins();
    compare_loops();
    compare_corners();
    compare_area();
    if (outline_.blocks > 1) compare_blocks();
    return {std::move(fit_), std::move(possible_faults_)};
  }

 private:
  using Ends = std::pair<Point, Point>;

  void fault(const std::string& what, Point place) { possible_faults_.push_back({what, place}); }

  const EdgeSides& sides_of(const BoundaryEdges& boundary, std::size_t edge) const {
    return outline_.sides[first_edges_[&boundary - mesh_.boundaries.data()] + edge];
  }

  void compare_nodes(const BoundaryEdges& boundary, const NamedOutline& outline) {
    for (const auto& edge : boundary.edges) {
      for (const NodeId node : edge) {
        const auto [segment, away] = outline.segments.nearest(mesh_.point(node));
        fit_.boundary_node_distance = std::max(fit_.boundary_node_distance, away);
        if (away > tolerance_ && node == edge[0]) note_far_node(boundary, mesh_.point(node), away);
        if (segment < outline.segment_chain.size()) met_[outline.segment_chain[segment]] = 1;
      }
    }
  }

  /// Flags open chains between whose ends the mesh has a single edge: both nodes may belong to other chains
  /// too.
  void meet_single_edges(const BoundaryEdges& boundary, const NamedOutline& outline) {
    std::set<Ends> edges;
    for (const auto& edge : boundary.edges)
      edges.insert(std::minmax(mesh_.point(edge[0]), mesh_.point(edge[1])));
    for (const std::size_t c : outline.chains) {
      const Chain& chain = geometry_[c];
      if (chain.open && !chain.points.empty() &&
          edges.contains(std::minmax(chain.points.front(), chain.points.back())))
        met_[c] = 1;
    }
  }

  /// If the joint of two boundaries is lost within a quadtree cell, the edges of one end on the other.
  void note_far_node(const BoundaryEdges& boundary, Point p, double away) {
    fault("a node of boundary " + boundary.name + " lies off it", p);
    if (is_on_geometry(p)) possible_faults_.back().question = ReachQuestion{p, away, true};
  }

  bool is_on_geometry(Point p) {
    if (!all_segments_) {
      all_segments_.emplace();
      for (const Chain& chain : geometry_)
        for_each_segment(chain,
                         [&](Point a, Point b, const Curve& curve) { all_segments_->add(a, b, curve); });
      all_segments_->build();
    }
    return all_segments_->nearest(p).second <= tolerance_;
  }

  SegmentSet edges_of(const BoundaryEdges& boundary) const {
    SegmentSet edges;
    for (const auto& edge : boundary.edges) edges.add(mesh_.point(edge[0]), mesh_.point(edge[1]));
    edges.build();
    return edges;
  }

  /// Checks that each point of a loop in the mesh is closer to its boundary than the length of the cells
  /// around it.
  void compare_points(const BoundaryEdges& boundary, const NamedOutline& outline) {
    const SegmentSet edges = edges_of(boundary);
    for (const std::size_t c : outline.chains) {
      if (met_[c] == 0) continue;
      for (const Point p : geometry_[c].points) compare_point(boundary, edges, p);
    }
  }

  void compare_point(const BoundaryEdges& boundary, const SegmentSet& edges, Point p) {
    const auto [edge, away] = edges.nearest(p);
    fit_.geometry_distance = std::max(fit_.geometry_distance, away);
    const EdgeSides& sides = sides_of(boundary, edge);
    if (away <= tolerance_ || (sides.left != EdgeSides::none && away <= sides.longest)) return;
    fault("a point of boundary " + boundary.name + " is farther from the mesh than the cells there are long",
          p);
    possible_faults_.back().question = ReachQuestion{p, away, true};
  }

  /// Flags chains that coincide with one that a boundary node lies on, as those between two blocks and those
  /// of inner lines do.
  void meet_twins() {
    std::map<Ends, std::size_t> first_with;
    for (std::size_t c = 0; c < geometry_.size(); ++c) {
      const std::vector<Point>& points = geometry_[c].points;
      if (points.size() < 2) continue;
      const Ends ends = std::minmax(points[0], points[1]);
      for_each_segment(geometry_[c], [&](Point a, Point b, const Curve&) {
        const auto twin = first_with.emplace(std::minmax(a, b), c).first;
        if (Ends(std::minmax(a, b)) == ends && met_[twin->second] != 0) met_[c] = 1;
      });
    }
  }

  /// Compares the area of each block with that enclosed by the segments, of which a boundary edge nearby
  /// tells the blocks on both sides.
  void compare_blocks() {
    std::vector<long double> wanted(outline_.blocks, 0), meshed(outline_.blocks, 0);
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      if (boundary.edges.empty()) continue;
      const SegmentSet edges = edges_of(boundary);
      if (const auto outline = outlines_.find(boundary.name); outline != outlines_.end())
        add_enclosed(boundary, edges, outline->second, wanted);
      for (std::size_t i = 0; const auto& edge : boundary.edges)
        add_beside(sides_of(boundary, i++), false, mesh_.point(edge[0]), mesh_.point(edge[1]), meshed);
    }
    for (std::int32_t block = 0; block < outline_.blocks; ++block) {
      const double error =
          static_cast<double>(std::abs(meshed[block] - wanted[block]) / std::abs(meshed[block]));
      fit_.block_area_errors.push_back(error);
      if (!(error <= largest_area_error))
        fault(fmt::format("the area of block {} of {} differs from the geometry's by more than 5 percent",
                          block + 1, outline_.blocks),
              centre_);
    }
  }

  /// Each segment counts once, also if the geometry has it in both directions.
  void add_enclosed(const BoundaryEdges& boundary, const SegmentSet& edges, const NamedOutline& outline,
                    std::vector<long double>& areas) {
    std::set<Ends> seen;
    for (const std::size_t c : outline.chains) {
      if (met_[c] == 0) continue;
      for_each_segment(geometry_[c], [&](Point a, Point b, const Curve&) {
        const std::uint32_t nearest = edges.nearest(a + 0.5 * (b - a)).first;
        const auto& edge = boundary.edges[nearest];
        const EdgeSides& sides = sides_of(boundary, nearest);
        const bool first = seen.insert(std::minmax(a, b)).second;
        const bool turned = dot(mesh_.point(edge[1]) - mesh_.point(edge[0]), b - a) < 0;
        if (first) add_beside(sides, turned, a, b, areas);
        if (!first && sides.right == EdgeSides::none)
          fault("an edge of boundary " + boundary.name +
                    " has cells on one side only, where the geometry has a block on both",
                mesh_.point(edge[0]));
      });
    }
  }

  /// Adds the triangle of centre, a and b to the block left of an edge, and subtracts it from that on the
  /// right; `turned`: the edge runs from b to a.
  void add_beside(const EdgeSides& sides, bool turned, Point a, Point b,
                  std::vector<long double>& areas) const {
    const double area = cross(a - centre_, b - centre_) / 2;
    if (sides.left != EdgeSides::none) areas[sides.left] += turned ? -area : area;
    if (sides.right != EdgeSides::none) areas[sides.right] -= turned ? -area : area;
  }

  /// The mesher drops loops smaller than its smallest quadtree cell in both directions; a larger one must be
  /// in the mesh.
  void compare_loops() {
    for (std::size_t c = 0; c < geometry_.size(); ++c) {
      const Chain& chain = geometry_[c];
      if (met_[c] != 0 || chain.points.empty()) continue;
      ++fit_.loops_dropped;
      Box box;
      for (const Point p : chain.points) box.include(p);
      const double size = std::max(box.width(), box.height());
      fault(chain.name, box.centre());
      possible_faults_.back().question = ReachQuestion{box.centre(), loop_reach * size};
      possible_faults_.back().loop_size = {box.width(), box.height()};
    }
  }

  void compare_corners() {
    const std::vector<Point> sharp = sharp_points(geometry_);
    SegmentSet nodes;
    bool any = false;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      for (const auto& edge : boundary.edges) {
        for (const NodeId node : edge) nodes.add(mesh_.point(node), mesh_.point(node));
        any = true;
      }
    }
    nodes.build();
    fit_.sharp_corners = std::ssize(sharp);
    fit_.sharp_corners_lost = std::count_if(
        sharp.begin(), sharp.end(), [&](Point p) { return !any || nodes.nearest(p).second > tolerance_; });
  }

  void compare_area() {
    long double wanted = 0, meshed = 0;
    for (const Chain& chain : geometry_) {
      if (lines_.contains(chain.name)) continue;
      for_each_segment(
          chain, [&](Point a, Point b, const Curve&) { wanted += cross(a - centre_, b - centre_) / 2; });
    }
    for (const OuterSegment& edge : outline_.outer)
      meshed += cross(edge.from - centre_, edge.to - centre_) / 2;
    fit_.area_error = static_cast<double>(std::abs(meshed - wanted) / std::abs(wanted));
    if (!(fit_.area_error <= largest_area_error))
      fault("the area differs from the geometry's by more than 5 percent", centre_);
  }

  const MeshOutline& outline_;
  const Mesh& mesh_;
  std::span<const Chain> geometry_;
  std::map<std::string, NamedOutline> outlines_;
  std::set<std::string> lines_;           ///< names of inner lines
  std::vector<char> met_;                 ///< for each chain: whether a boundary node of its name lies on it
  std::vector<std::size_t> first_edges_;  ///< of each boundary, among all boundary edges
  std::optional<SegmentSet> all_segments_;  ///< of every boundary; built on first use
  Point centre_;
  double tolerance_;
  GeometryFit fit_;
  std::vector<PossibleFault> possible_faults_;
};

}  // namespace

OutlineComparison compare_outline(const MeshOutline& outline, std::span<const Chain> geometry,
                                  double tolerance) {
  return Comparison(outline, geometry, tolerance).run();
}

void add_confirmed(const std::vector<PossibleFault>& possible_faults, const std::vector<double>& answers,
                   GeometryFit& fit) {
  auto answer = answers.begin();
  for (const PossibleFault& possible : possible_faults) {
    std::string what = possible.what;
    if (possible.question) {
      const double cells = *answer++;
      const double size = std::max(possible.loop_size.x, possible.loop_size.y);
      if (possible.question->is_size ? possible.question->distance <= cells : size <= fragments * cells)
        continue;
      if (!possible.question->is_size)
        what = fmt::format(
            "a loop of boundary {}, {:.6g} wide and {:.6g} high, is not in the mesh, where "
            "cells are {:.6g} long",
            possible.what, possible.loop_size.x, possible.loop_size.y, cells);
    }
    fit.faults.push_back({MeshRule::geometry, what, possible.place});
  }
}

}  // namespace quadloop
