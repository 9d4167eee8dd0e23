#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "adapt/morph/morph_derivative.hpp"
#include "adapt/morph/morph_mesh.hpp"
#include "adapt/morph/outline_pieces.hpp"
#include "io/input/geometry_file.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "quadloop/quadloop.hpp"

namespace quadloop {

/// The lines, and the closed loops that they form, if they do.
struct MorphGeometry::Parts {
  Parts(std::vector<Chain> given, std::string path, Warnings of_file)
      : chains{std::move(given)}, file{std::move(path)}, warnings{std::move(of_file)} {
    AssembleOptions options;
    options.domain_is_known = true;
    Warnings of_loops;
    try {
      loops = assemble(chains, options, of_loops);
      warnings.insert(warnings.end(), of_loops.begin(), of_loops.end());
    } catch (const InputError& error) {
      fault = error.what();
    }
  }

  std::vector<Chain> chains;
  std::string file;  ///< empty if there is none
  Warnings warnings;
  std::optional<Geometry> loops;
  std::string fault;  ///< why the lines form no closed loops
};

namespace {

std::vector<Chain> chains_from(std::vector<GeometryLine> lines) {
  std::vector<Chain> chains;
  for (GeometryLine& line : lines) {
    for (const Point& p : line.points) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        throw InputError(fmt::format("line '{}': has a point that is not finite", line.boundary));
    }
    const std::string source = "line '" + line.boundary + "'";
    chains.push_back({std::move(line.boundary), line.open, std::move(line.points), source});
  }
  return chains;
}

/// Whether any line of a geometry is a boundary of the mesh. The same on every rank.
bool has_boundary_of(const Mesh& mesh, const std::vector<Chain>& chains) {
  std::set<std::string> names;
  for (const BoundaryEdges& boundary : mesh.boundaries) names.insert(boundary.name);
  return std::ranges::any_of(chains, [&](const Chain& chain) { return names.contains(chain.name); });
}

/// The vertex of the geometry at each point of the lines; -1 if it has none there, as ends of lines that
/// nearly meet are joined, or at an earlier point.
std::vector<std::vector<std::int32_t>> vertices_of(const Geometry& geometry,
                                                   const std::vector<Chain>& chains) {
  std::map<Point, std::int32_t> left;
  for (std::int32_t v = 0; v < geometry.size(); ++v) left.try_emplace(geometry.point(v), v);
  std::vector<std::vector<std::int32_t>> vertices;
  for (const Chain& chain : chains) {
    vertices.emplace_back();
    for (const Point& p : chain.points) {
      const auto found = left.find(p);
      vertices.back().push_back(found == left.end() ? -1 : found->second);
      if (found != left.end()) left.erase(found);
    }
  }
  return vertices;
}

/// Whether the chains have as many points, chain by chain.
bool correspond(const std::vector<Chain>& from, const std::vector<Chain>& to) {
  return std::ranges::equal(from, to, [](const Chain& a, const Chain& b) {
    return a.name == b.name && a.points.size() == b.points.size() && a.curves.empty() && b.curves.empty();
  });
}

/// The chains between two states that correspond.
std::vector<Chain> chains_between(const std::vector<Chain>& from, std::vector<Chain> to, double share) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    for (std::size_t k = 0; k < to[i].points.size(); ++k)
      to[i].points[k] = from[i].points[k] + share * (to[i].points[k] - from[i].points[k]);
  }
  return to;
}

}  // namespace

MorphGeometry::MorphGeometry(std::vector<GeometryLine> lines)
    : parts_{std::make_shared<const Parts>(chains_from(std::move(lines)), "", Warnings{})} {}

MorphGeometry::MorphGeometry(const Communicator& comm, const std::string& path) {
  comm.together([&] {
    Warnings warnings;
    std::vector<Chain> chains = io::read_geometry(path, warnings);
    parts_ = std::make_shared<const Parts>(std::move(chains), path, std::move(warnings));
  });
}

std::vector<GeometryLine> MorphGeometry::lines() const {
  std::vector<GeometryLine> lines;
  for (const Chain& chain : parts_->chains) lines.push_back({chain.name, chain.points, chain.open});
  return lines;
}

const std::vector<std::string>& MorphGeometry::warnings() const { return parts_->warnings; }

struct Morph::Parts {
  using Geometries = std::shared_ptr<const MorphGeometry::Parts>;

  Parts(const Communicator& comm_of_morph, Mesh before, Geometries old_geometry, Geometries new_geometry,
        double least_quality)
      : comm{comm_of_morph},
        from{std::move(old_geometry)},
        to{std::move(new_geometry)},
        mesh{std::make_shared<Mesh>(std::move(before))},
        places{mesh->points} {
    const bool closed = adapt::has_closed_boundaries(comm, *mesh);
    comm.together([&] { choose_geometries(closed); });
    report =
        adapt::morph_mesh(comm, *mesh, change(), correspond(from->chains, to->chains) ? 0 : least_quality);
  }

  Mesh original() const {
    Mesh before = *mesh;
    before.points = places;
    return before;
  }

  /// The share of the change up to which the worst quality stays above a bound, rounded down. By bisection
  /// between points that correspond; otherwise that of the movement. *Collective.*
  double share_with_quality(double least_quality) const {
    if (!correspond(from->chains, to->chains)) return report.possible_way;
    constexpr int halvings = 6;
    double low = 0, high = 1;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      const auto between = std::make_shared<const MorphGeometry::Parts>(
          chains_between(from->chains, to->chains, middle), to->file, Warnings{});
      const Parts part(comm, original(), from, between, 0);
      (part.report.worst_after >= least_quality ? low : high) = middle;
    }
    return low;
  }

  // in messages
  std::string name() const { return to->file.empty() ? "the new geometry" : to->file; }
  std::string old_name() const { return from->file.empty() ? "the old geometry" : from->file; }

  bool knows_from() const { return !from->chains.empty(); }

  /// Uses the geometries line by line if the boundaries and inner lines of the mesh are no closed loops, else
  /// as loops.
  void choose_geometries(bool closed) {
    if (!closed && knows_from()) {
      pieces = adapt::pieces_of(from->chains, to->chains);
      if (pieces) return;
      throw InputError(fmt::format(
          "{}: its pieces are not those of {}, with the same names and numbers of points in the "
          "same order, as a mesh with inner lines, or with blocks that touch its boundary, requires",
          name(), old_name()));
    }
    if (!to->loops && closed) throw InputError(to->fault);
    if (!to->loops)
      throw InputError(to->fault +
                       "; for a mesh with inner lines, or with blocks that touch its boundary, give --from "
                       "OLD.geom with the same pieces and numbers of points");
    if (knows_from() && !from->loops) throw InputError(from->fault);
    if (knows_from() && !has_boundary_of(*mesh, from->chains))
      throw InputError(old_name() + ": has none of the boundaries of the mesh; give them the same names");
  }

  adapt::OutlineChange change() const {
    if (pieces) return {pieces->to, name(), &pieces->from, old_name(), true};
    return {*to->loops, name(), knows_from() ? &*from->loops : nullptr, old_name()};
  }

  /// *Collective.*
  const adapt::MorphDerivative& derivative() {
    if (derivative_) return *derivative_;
    comm.together([&] {
      if (report.smoothed) throw InputError(adapt::text_of_smoothing(name()));
    });
    original_ = original();
    change_.emplace(change());
    derivative_.emplace(comm, original_, *change_);
    places = {};
    vertices = vertices_of(*to->loops, to->chains);
    return *derivative_;
  }

  const Communicator& comm;
  Geometries from, to;
  std::optional<adapt::OutlinePieces> pieces;
  std::shared_ptr<Mesh> mesh;
  std::vector<Point> places;  ///< of its nodes before the morph
  adapt::MorphReport report;
  std::vector<std::vector<std::int32_t>> vertices;  ///< of the new geometry, at the points of its lines

 private:
  Mesh original_;
  std::optional<adapt::OutlineChange> change_;
  std::optional<adapt::MorphDerivative> derivative_;
};

Morph::Morph(const Communicator& comm, Mesh mesh, const MorphGeometry& from, const MorphGeometry& to,
             double least_quality)
    : parts_{std::make_unique<Parts>(comm, std::move(mesh), from.parts_, to.parts_, least_quality)} {
  const adapt::MorphReport& report = parts_->report;
  if (!report.valid())
    throw TooFar(adapt::text_of_inversion(report) + "; use smaller steps, or generate a new mesh",
                 report.possible_way);
  if (report.worst_after >= least_quality) return;
  if (report.worst_before < least_quality)
    throw TooFar(
        fmt::format("the quality of the worst cell of the mesh itself is {:.3g}, below {:.3g}; generate "
                    "a better mesh, or accept this quality",
                    report.worst_before, least_quality),
        0);
  const double share = parts_->share_with_quality(least_quality);
  throw TooFar(
      fmt::format("the quality of the worst cell falls from {:.3g} to {:.3g}, and below {:.3g} after "
                  "{:.0f} % of the change; use smaller steps, or generate a new mesh",
                  report.worst_before, report.worst_after, least_quality, 100 * share),
      share);
}

Morph::~Morph() = default;

std::shared_ptr<const Mesh> Morph::mesh() const { return parts_->mesh; }

const MorphReport& Morph::report() const { return parts_->report; }

std::vector<Point> Morph::push_forward(const std::vector<std::vector<Point>>& of_points) const {
  const adapt::MorphDerivative& derivative = parts_->derivative();
  std::vector<Point> of_vertices(parts_->to->loops->size());
  parts_->comm.together([&] {
    if (of_points.size() != parts_->vertices.size())
      throw InputError(fmt::format("{} lists of velocities for {} lines of the geometry", of_points.size(),
                                   parts_->vertices.size()));
    for (std::size_t i = 0; i < of_points.size(); ++i) {
      const std::vector<std::int32_t>& vertices = parts_->vertices[i];
      if (of_points[i].size() != vertices.size())
        throw InputError(fmt::format("{} velocities for {} points", of_points[i].size(), vertices.size()));
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        if (vertices[k] >= 0) of_vertices[vertices[k]] = of_points[i][k];
      }
    }
  });
  return derivative.velocity(of_vertices);
}

std::vector<std::vector<Point>> Morph::pull_back(std::span<const Point> of_nodes) const {
  const adapt::MorphDerivative& derivative = parts_->derivative();
  parts_->comm.together([&] {
    if (of_nodes.size() == static_cast<std::size_t>(parts_->mesh->owned_nodes)) return;
    throw InputError(fmt::format("the gradient has {} rows on rank {}, which owns {} nodes", of_nodes.size(),
                                 parts_->comm.rank(), parts_->mesh->owned_nodes));
  });
  const std::vector<Point> of_vertices = derivative.gradient(of_nodes);
  std::vector<std::vector<Point>> of_points;
  for (const std::vector<std::int32_t>& vertices : parts_->vertices) {
    of_points.emplace_back();
    for (const std::int32_t v : vertices) of_points.back().push_back(v < 0 ? Point{} : of_vertices[v]);
  }
  return of_points;
}

}  // namespace quadloop
