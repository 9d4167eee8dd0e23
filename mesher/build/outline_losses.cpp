#include "mesher/build/outline_losses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "mesher/mesh/check/validate_geometry.hpp"

namespace quadloop {

namespace {

std::string text(Point p) { return fmt::format("({:.6g}, {:.6g})", p.x, p.y); }

/// Returns which of the flags are set on any rank. *Collective.*
std::vector<char> seen_anywhere(const Communicator& comm, const std::vector<char>& here) {
  std::vector<std::int32_t> ids;
  for (std::int32_t i = 0; i < std::ssize(here); ++i) {
    if (here[i] != 0) ids.push_back(i);
  }
  std::vector<char> seen(here.size(), 0);
  for (const std::int32_t i : comm.all_gather_values<std::int32_t>(ids)) seen[i] = 1;
  return seen;
}

/// Returns the vertices that should be nodes, by position; of several loops that touch there the first.
std::map<Point, std::int32_t> kept_vertices(const Geometry& geometry) {
  std::map<Point, std::int32_t> vertices;
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    if (geometry.kept(v)) vertices.emplace(geometry.point(v), v);
  }
  return vertices;
}

void warn_of_lost_corners(const Communicator& comm, const Geometry& geometry, const Mesh& mesh,
                          MeshReport& report) {
  const std::map<Point, std::int32_t> kept = kept_vertices(geometry);
  std::vector<char> is_node(geometry.size(), 0);
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& edge : boundary.edges) {
      for (const NodeId node : edge) {
        const auto at = kept.find(mesh.point(node));
        if (at != kept.end()) is_node[at->second] = 1;
      }
    }
  }
  is_node = seen_anywhere(comm, is_node);
  std::int32_t first = -1;
  for (const auto& [place, v] : kept) {
    if (is_node[v] != 0) continue;
    ++report.corners_lost;
    first = first < 0 ? v : std::min(first, v);
  }
  if (report.corners_lost == 0) return;
  const std::string& name = geometry.boundary(geometry.boundary_of(first)).name;
  report.warnings.insert(
      report.warnings.begin(),  // before a list of islands
      fmt::format(
          "boundary '{}': {} of {} feature point{} {} no node of the mesh, the first at {}: several lie in "
          "one smallest cell; reduce spacing.min, or increase 'corner' if they need not be kept",
          name, report.corners_lost, kept.size(), kept.size() == 1 ? "" : "s",
          report.corners_lost == 1 ? "is" : "are", text(geometry.point(first))));
}

/// Returns the bounding box of each boundary; empty if it has no segments.
std::vector<Box> boxes_of_boundaries(const Geometry& geometry) {
  std::vector<Box> boxes(geometry.boundaries().size());
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    Box& box = boxes[geometry.boundary_of(s).value()];
    box.include(geometry.point(s));
    box.include(geometry.point(geometry.next(s)));
  }
  return boxes;
}

Box box_of_boundary(const Geometry& geometry, const std::string& name) {
  const auto found = std::ranges::find(geometry.boundaries(), name, &Boundary::name);
  return boxes_of_boundaries(geometry)[found - geometry.boundaries().begin()];
}

/// Returns the boundaries without mesh edges. If the geometry is the outer edge of layers and has no segment
/// of a boundary with layers, the edges are added with the layers (e.g. those of a blunt base where a wake
/// begins), or its loops were dropped before.
std::vector<std::string> vanished_from(const Geometry& geometry, const std::vector<char>& has_edges) {
  const std::vector<Box> boxes = boxes_of_boundaries(geometry);
  std::vector<std::string> vanished;
  for (std::size_t b = 0; b < has_edges.size(); ++b) {
    const Boundary& boundary = geometry.boundaries()[b];
    const bool is_below_front = boundary.layers && !(boxes[b].low.x <= boxes[b].high.x);
    if (has_edges[b] == 0 && !is_below_front) vanished.push_back(boundary.name);
  }
  return vanished;
}

/// Returns twice the contribution of each edge to the enclosed area, relative to `centre`, one list per
/// boundary; empty for one between blocks.
std::vector<std::vector<double>> shares_of_area(const Mesh& mesh, Point centre) {
  std::vector<std::vector<double>> shares;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    auto& list = shares.emplace_back();
    if (boundary.two_sided()) continue;
    for (const auto& edge : boundary.edges)
      list.push_back(cross(mesh.point(edge[0]) - centre, mesh.point(edge[1]) - centre));
  }
  return shares;
}

std::vector<double> outline_shares(const Geometry& geometry, Point centre) {
  std::vector<double> shares(geometry.boundaries().size(), 0);
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    shares[geometry.boundary_of(s).value()] +=
        cross(geometry.point(s) - centre, geometry.point(geometry.next(s)) - centre);
  }
  return shares;
}

/// Returns for each boundary whether it consists of complete loops and thus encloses an area. The two
/// directions of one between blocks cancel.
std::vector<char> encloses_area(const Geometry& geometry) {
  std::vector<char> whole(geometry.boundaries().size(), 1);
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    const BoundaryId here = geometry.boundary_of(s), next = geometry.boundary_of(geometry.next(s));
    if (here != next) whole[here.value()] = whole[next.value()] = 0;
    if (geometry.twin(s) >= 0) whole[here.value()] = 0;
  }
  return whole;
}

/// The area of the domain may hide that of a body: that of an airfoil is negligible in a wide far field.
void warn_of_lost_shapes(const Communicator& comm, const Geometry& geometry, const Mesh& mesh,
                         MeshReport& report) {
  const Point centre = geometry.box().centre();
  const std::vector<double> wanted = outline_shares(geometry, centre);
  const std::vector<char> whole = encloses_area(geometry);
  const std::vector<std::vector<double>> shares = shares_of_area(mesh, centre);
  QUADLOOP_REQUIRE(shares.size() == wanted.size(), "a mesh has its outline's boundaries", shares.size(),
                   wanted.size());
  std::int64_t edges = 0;
  for (const std::vector<double>& list : shares) edges += std::ssize(list);
  const double farthest = geometry.box().width() + geometry.box().height();
  ReproducibleSums sums(shares.size(), farthest * farthest, comm.sum(edges));
  for (std::size_t b = 0; b < shares.size(); ++b) {
    for (const double share : shares[b]) sums.add(b, share);
  }
  const std::vector<double> meshed = sums.over(comm);
  const std::vector<Box> boxes = boxes_of_boundaries(geometry);
  for (std::size_t b = 0; b < shares.size(); ++b) {
    const double error = meshed[b] / wanted[b] - 1;
    if (whole[b] == 0 || wanted[b] == 0 || std::abs(error) <= largest_area_error || meshed[b] == 0) continue;
    const std::string& name = geometry.boundaries()[b].name;
    report.warnings.push_back(
        fmt::format("boundary '{0}' near {1}: the boundary edges of the mesh enclose {2:.0f} percent {3} "
                    "area than the geometry: its cells are too coarse to resolve the shape; set a smaller "
                    "spacing in [boundary.{0}], or reduce spacing.min",
                    name, text(boxes[b].centre()), 100 * std::abs(error), error < 0 ? "less" : "more"));
  }
}

[[noreturn]] void refuse_area(const Communicator& comm, const Geometry& geometry, const Mesh& mesh,
                              double error, bool smoothed) {
  const Point centre = geometry.box().centre();
  const std::vector<std::vector<double>> meshed = shares_of_area(mesh, centre);
  const std::vector<double> wanted = outline_shares(geometry, centre);
  QUADLOOP_REQUIRE(meshed.size() == wanted.size(), "a mesh has its outline's boundaries", meshed.size(),
                   wanted.size());
  std::size_t worst = 0;
  double most = -1;
  for (std::size_t b = 0; b < meshed.size(); ++b) {
    const double missed = std::abs(reproducible_sum(comm, meshed[b]) - wanted[b]);
    if (missed > most) worst = b;
    most = std::max(most, missed);
  }
  const std::string& name = geometry.boundaries()[worst].name;
  const std::string cause =
      smoothed ? "nodes slid along it during smoothing, where it is narrow; set smooth.sweeps = 0, or"
               : "its cells are too coarse there;";
  throw InputError(
      fmt::format("boundary '{}' near {}: the area of the mesh differs by {:.1f} percent from that of the "
                  "geometry, more than the {:.0f} allowed: {} set a smaller spacing in [boundary.{}], set "
                  "spacing.curvature, or reduce spacing.min or spacing.max",
                  name, text(box_of_boundary(geometry, name).centre()), 100 * error, 100 * largest_area_error,
                  cause, name));
}

/// Whether cells on its two sides are not neighbours: there is one side only, or it is a baffle.
bool separates(const Geometry& geometry, std::int32_t segment) {
  return geometry.twin(segment) < 0 || geometry.boundary(geometry.boundary_of(segment)).baffle;
}

/// The next segment that separates, around the same connected part of the domain: through all blocks at the
/// vertex between them.
std::int32_t next_around(const Geometry& geometry, std::int32_t segment) {
  std::int32_t next = geometry.next(segment);
  while (!separates(geometry, next)) next = geometry.next(geometry.twin(next));
  return next;
}

}  // namespace

void refuse_vanished(const Geometry& geometry, const std::vector<std::string>& vanished,
                     const std::string& why) {
  const Box box = box_of_boundary(geometry, vanished.front());
  const std::string more =
      vanished.size() == 1 ? "" : fmt::format(", nor would {}", counted(vanished.size() - 1, "other curve"));
  throw InputError(
      fmt::format("boundary '{}' near {}, {:.6g} wide and {:.6g} high, {} and would have no edge in the "
                  "mesh{}; reduce spacing.min, or allow it by vanish = \"allow\" in [geometry]",
                  vanished.front(), text(box.centre()), box.width(), box.height(), why, more));
}

void report_losses(const Communicator& comm, const Geometry& geometry, const Mesh& mesh, bool may_vanish,
                   MeshReport& report) {
  std::vector<char> has_edges(mesh.boundaries.size(), 0);
  for (std::size_t b = 0; b < has_edges.size(); ++b) has_edges[b] = mesh.boundaries[b].edges.empty() ? 0 : 1;
  has_edges = seen_anywhere(comm, has_edges);
  std::vector<std::string> vanished = vanished_from(geometry, has_edges);
  if (!may_vanish && !vanished.empty())
    refuse_vanished(geometry, vanished, "lies within cells that cannot resolve it");
  report.boundaries_vanished = std::move(vanished);
  warn_of_lost_corners(comm, geometry, mesh, report);
  warn_of_lost_shapes(comm, geometry, mesh, report);
}

double area_of_loop(const Geometry& geometry, std::int32_t loop) {
  const Point origin = geometry.point(geometry.loop_start(loop));
  double twice = 0;
  for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) {
    twice += cross(geometry.point(v) - origin, geometry.point(geometry.next(v)) - origin);
  }
  return twice / 2;
}

std::int64_t regions_of(const Geometry& geometry) {
  std::vector<std::int32_t> walk_of(geometry.size(), -1), starts;
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    if (walk_of[s] >= 0 || !separates(geometry, s)) continue;
    for (std::int32_t v = s; walk_of[v] < 0; v = next_around(geometry, v)) walk_of[v] = size32(starts);
    starts.push_back(s);
  }
  std::vector<double> twice(starts.size(), 0);  // areas; what is walked there and back encloses none
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    const std::int32_t walk = walk_of[s], twin = geometry.twin(s);
    if (walk < 0 || (twin >= 0 && walk_of[twin] == walk)) continue;
    const Point origin = geometry.point(starts[walk]);
    twice[walk] += cross(geometry.point(s) - origin, geometry.point(geometry.next(s)) - origin);
  }
  return std::ranges::count_if(twice, [](double area) { return area > 0; });
}

void require_area(const Communicator& comm, const Geometry& geometry, double dropped, const Mesh& mesh,
                  bool smoothed) {
  std::vector<double> shares;
  for (const std::vector<double>& list : shares_of_area(mesh, geometry.box().centre()))
    shares.insert(shares.end(), list.begin(), list.end());
  const double meshed = reproducible_sum(comm, shares) / 2;
  double given = 0;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) given += area_of_loop(geometry, loop);
  for (const double wanted : {given, given - dropped}) {
    const double error = std::abs(meshed - wanted) / std::abs(wanted);
    if (!(error <= largest_area_error)) refuse_area(comm, geometry, mesh, error, smoothed);
  }
}

}  // namespace quadloop
