#include "smoother/outline/outline_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "mesher/base/error.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop::smoother {

namespace {

constexpr double largest_share = 0.1;  ///< of an edge: larger distances mean a different geometry, not
                                       ///< rounding or another polyline of the same curve
constexpr std::size_t most_named = 5;
constexpr const char* cure = "; give the geometry as it was meshed: `quadloop mesh --geometry-out` writes it";

using Names = std::vector<std::string>;

/// Lists the first few names.
std::string listed(const Names& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most_named, names.size()); ++i)
    text += (i == 0 ? "'" : ", '") + names[i] + "'";
  return names.size() > most_named ? text + " and " + std::to_string(names.size() - most_named) + " more"
                                   : text;
}

template <class Boundaries>
Names names_of(const Boundaries& boundaries) {
  Names names;
  for (const auto& boundary : boundaries) names.push_back(boundary.name);
  return names;
}

[[noreturn]] void refuse_node(const std::string& path, const std::string& boundary, Point p, double edge) {
  std::ostringstream message;
  message.precision(12);
  message << path << ": the boundary '" << boundary
          << "' of the mesh is not on that of the geometry: its node (" << p.x << ", " << p.y
          << ") is farther away than a tenth of its edge, which is " << edge << " long" << cure;
  throw InputError(message.str());
}

/// Distances of the nodes of one boundary from the geometry.
struct NodesOff {
  std::int64_t count = 0;
  double farthest = 0;
};

/// A node is checked from both its edges, so the shorter one decides.
NodesOff nodes_off(const OutlinePath& outline, const Mesh& mesh, const BoundaryEdges& boundary,
                   const std::string& path) {
  NodesOff off;
  for (const auto& edge : boundary.edges) {
    const double edge_length = length(mesh.point(edge[1]) - mesh.point(edge[0]));
    for (const NodeId node : edge) {
      const double away = outline.distance(mesh.point(node), boundary.name,
                                           std::max(outline.tolerance(), largest_share * edge_length));
      if (!std::isfinite(away)) refuse_node(path, boundary.name, mesh.point(node), edge_length);
      if (away <= outline.tolerance() || node != edge[0]) continue;
      ++off.count;
      off.farthest = std::max(off.farthest, away);
    }
  }
  return off;
}

std::string off_text(const std::string& path, const BoundaryEdges& boundary, const NodesOff& off) {
  std::ostringstream text;
  text << path << ": " << off.count << " of " << boundary.edges.size() << " nodes of the boundary '"
       << boundary.name << "' do not lie on the geometry, by up to " << off.farthest
       << "; they and their neighbours along it do not slide";
  return text.str();
}

}  // namespace

std::vector<std::string> require_match(const Geometry& outline, const Mesh& whole, const std::string& path) {
  const OutlinePath curves(outline);
  std::vector<std::string> warnings;
  Names absent;
  for (const BoundaryEdges& boundary : whole.boundaries) {
    if (!curves.has(boundary.name)) {
      absent.push_back(boundary.name);
      continue;
    }
    const NodesOff off = nodes_off(curves, whole, boundary, path);
    if (off.count > 0) warnings.push_back(off_text(path, boundary, off));
  }
  if (!absent.empty() && absent.size() == whole.boundaries.size()) {
    throw InputError(path + ": has none of the mesh's boundaries, " + listed(absent) + ", but " +
                     listed(names_of(outline.boundaries())) + cure);
  }
  if (!absent.empty())
    warnings.push_back(path + ": lacks these boundaries of the mesh: " + listed(absent) +
                       "; nodes there slide only where it is straight");
  return warnings;
}

std::vector<char> loops_against(const Geometry& outline, const Mesh& whole) {
  const OutlinePath curves(outline);
  std::vector<std::int64_t> votes(outline.loop_count(), 0);
  for (const BoundaryEdges& boundary : whole.boundaries) {
    for (const auto& [from, to] : boundary.edges) {
      const OutlinePlace a = curves.locate(whole.point(from), boundary.name),
                         b = curves.locate(whole.point(to), boundary.name);
      if (!a.valid() || a.loop != b.loop) continue;
      votes[a.loop] += curves.way(b, a) < curves.way(a, b) ? 1 : -1;
    }
  }
  std::vector<char> against;
  for (const std::int64_t vote : votes) against.push_back(vote > 0 ? 1 : 0);
  return against;
}

Geometry with_loops_turned(const Geometry& outline, const std::vector<char>& turned) {
  GeometryBuilder builder;
  for (std::int32_t loop = 0; loop < outline.loop_count(); ++loop) {
    const std::int32_t begin = outline.loop_start(loop), end = outline.loop_start(loop + 1);
    std::int32_t v = begin;
    for (std::int32_t count = begin; count < end; ++count) {
      const std::int32_t before = outline.previous(v);
      if (turned[loop] != 0)
        builder.add(outline.point(v), outline.boundary_of(before), reversed(outline.curve(before)));
      else
        builder.add(outline, v);
      v = turned[loop] != 0 ? before : outline.next(v);
    }
    builder.end_loop();
  }
  return std::move(builder).geometry(outline.boundaries());
}

}  // namespace quadloop::smoother
