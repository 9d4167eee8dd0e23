#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "adapt/morph/morph_derivative.hpp"
#include "adapt/morph/morph_mesh.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "quadloop/quadloop.hpp"

namespace quadloop {

namespace {

double signed_area(std::span<const Point> loop) {
  double twice = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) twice += cross(loop[i], loop[(i + 1) % loop.size()]);
  return twice / 2;
}

/// Whether the edges of a boundary, with the domain to their left, turn counter-clockwise. *Collective.*
bool turns_left(const Communicator& comm, const Mesh& mesh, const std::string& boundary) {
  double twice = 0;
  for (const BoundaryEdges& edges : mesh.boundaries) {
    if (edges.name != boundary) continue;
    for (const auto& [a, b] : edges.edges) twice += cross(mesh.point(a), mesh.point(b));
  }
  double sum = 0;
  for (const double part : comm.all_gather(twice)) sum += part;
  return sum > 0;
}

void require_boundary(const Communicator& comm, const Mesh& mesh, const std::string& boundary) {
  comm.together([&] {
    if (std::ranges::find(mesh.boundaries, boundary, &BoundaryEdges::name) == mesh.boundaries.end())
      throw InputError(fmt::format("the mesh has no boundary '{}'", boundary));
  });
}

/// Loops as a geometry; those that are flagged in reverse order.
Geometry outline_of(const std::vector<MovingLoop>& loops, const std::vector<char>& reversed) {
  std::vector<Chain> chains;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    Chain chain{loops[i].boundary, false, loops[i].points, "outline '" + loops[i].boundary + "'"};
    if (reversed[i] != 0) std::ranges::reverse(chain.points);
    chains.push_back(std::move(chain));
  }
  AssembleOptions options;
  options.domain_is_known = true;
  std::vector<std::string> warnings;
  return assemble(std::move(chains), options, warnings);
}

void require_like(const std::vector<MovingLoop>& from, const std::vector<MovingLoop>& to) {
  const auto is_like = [](const MovingLoop& a, const MovingLoop& b) {
    return a.boundary == b.boundary && a.points.size() == b.points.size();
  };
  if (from.empty() || !std::ranges::equal(from, to, is_like))
    throw InputError("the new outline must have the loops of the old one, with as many points");
  for (std::size_t i = 0; i < from.size(); ++i) {
    if ((signed_area(from[i].points) > 0) != (signed_area(to[i].points) > 0))
      throw InputError(
          fmt::format("the points of the new outline '{}' run in the other direction than the old ones; "
                      "reverse them",
                      to[i].boundary));
  }
}

/// The vertex of the geometry at each point of a loop.
std::vector<std::int32_t> vertices_of(const Geometry& geometry, const MovingLoop& loop) {
  std::map<std::pair<double, double>, std::int32_t> at;
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    if (geometry.boundary(geometry.boundary_of(v)).name == loop.boundary)
      at.try_emplace({geometry.point(v).x, geometry.point(v).y}, v);
  }
  std::vector<std::int32_t> vertices;
  for (const Point& p : loop.points) {
    const auto found = at.find({p.x, p.y});
    if (found == at.end())
      throw InputError(fmt::format("outline '{}': its point ({}, {}) is too close to another one",
                                   loop.boundary, p.x, p.y));
    vertices.push_back(found->second);
  }
  return vertices;
}

}  // namespace

struct Morph::Parts {
  Parts(const Communicator& comm_of_morph, const Mesh& before, const std::vector<MovingLoop>& from,
        const std::vector<MovingLoop>& to)
      : comm{comm_of_morph}, mesh{std::make_shared<Mesh>(before)} {
    std::vector<char> reversed;
    for (const MovingLoop& loop : from) {
      require_boundary(comm, before, loop.boundary);
      reversed.push_back((signed_area(loop.points) > 0) != turns_left(comm, before, loop.boundary) ? 1 : 0);
    }
    comm.together([&] {
      require_like(from, to);
      old_outline = outline_of(from, reversed);
      new_outline = outline_of(to, reversed);
      for (const MovingLoop& loop : to) vertices.push_back(vertices_of(*new_outline, loop));
    });
    change.emplace(adapt::OutlineChange{*new_outline, "the new outline", &*old_outline, "the old outline"});
    derivative.emplace(comm, before, *change);
    report = adapt::morph_mesh(comm, *mesh, *change);
  }

  void require_derivative() const {
    if (report.smoothed)
      throw InputError("the mesh had to be smoothed on the new outline, so its nodes have no derivative");
  }

  const Communicator& comm;
  std::shared_ptr<Mesh> mesh;
  std::optional<Geometry> old_outline, new_outline;
  std::vector<std::vector<std::int32_t>> vertices;  ///< of new_outline, at the points of each loop
  std::optional<adapt::OutlineChange> change;
  std::optional<adapt::MorphDerivative> derivative;
  adapt::MorphReport report;
};

namespace {

/// The loops between two states.
std::vector<MovingLoop> between(const std::vector<MovingLoop>& from, const std::vector<MovingLoop>& to,
                                double share) {
  std::vector<MovingLoop> loops = to;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    for (std::size_t k = 0; k < loops[i].points.size(); ++k)
      loops[i].points[k] = from[i].points[k] + share * (to[i].points[k] - from[i].points[k]);
  }
  return loops;
}

/// The share of the change up to which the worst quality stays above a bound, by bisection, rounded down.
double share_with_quality(const Communicator& comm, const Mesh& mesh, const std::vector<MovingLoop>& from,
                          const std::vector<MovingLoop>& to, double least_quality) {
  constexpr int halvings = 6;
  double low = 0, high = 1;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    const Morph part(comm, mesh, from, between(from, to, middle));
    (part.worst_quality() >= least_quality ? low : high) = middle;
  }
  return low;
}

}  // namespace

Morph::Morph(const Communicator& comm, const Mesh& mesh, const std::vector<MovingLoop>& from,
             const std::vector<MovingLoop>& to, double least_quality)
    : parts_{std::make_unique<Parts>(comm, mesh, from, to)} {
  const adapt::MorphReport& report = parts_->report;
  if (!report.valid())
    throw TooFar(fmt::format("the cells near ({:g}, {:g}) become inverted after {:.0f} % of the change; use "
                             "smaller steps, or generate a new mesh",
                             report.worst_place.x, report.worst_place.y, 100 * report.possible_way),
                 report.possible_way);
  if (report.worst_after >= least_quality) return;
  if (report.worst_before < least_quality)
    throw TooFar(
        fmt::format("the quality of the worst cell of the mesh itself is {:.3g}, below {:.3g}; generate "
                    "a better mesh, or accept this quality",
                    report.worst_before, least_quality),
        0);
  const double share = share_with_quality(comm, mesh, from, to, least_quality);
  throw TooFar(
      fmt::format("the quality of the worst cell falls from {:.3g} to {:.3g}, and below {:.3g} after "
                  "{:.0f} % of the change; use smaller steps, or generate a new mesh",
                  report.worst_before, report.worst_after, least_quality, 100 * share),
      share);
}

Morph::~Morph() = default;

std::shared_ptr<const Mesh> Morph::mesh() const { return parts_->mesh; }

double Morph::worst_quality() const { return parts_->report.worst_after; }

bool Morph::smoothed() const { return parts_->report.smoothed; }

std::vector<Point> Morph::push_forward(const std::vector<std::vector<Point>>& of_points) const {
  parts_->require_derivative();
  std::vector<Point> of_vertices(parts_->new_outline->size());
  if (of_points.size() != parts_->vertices.size())
    throw InputError("give the velocities of the points of each loop of the outline");
  for (std::size_t i = 0; i < of_points.size(); ++i) {
    const std::vector<std::int32_t>& vertices = parts_->vertices[i];
    if (of_points[i].size() != vertices.size())
      throw InputError(fmt::format("{} velocities for {} points", of_points[i].size(), vertices.size()));
    for (std::size_t k = 0; k < vertices.size(); ++k) of_vertices[vertices[k]] = of_points[i][k];
  }
  return parts_->derivative->velocity(of_vertices);
}

std::vector<std::vector<Point>> Morph::pull_back(std::span<const Point> of_nodes) const {
  parts_->comm.together([&] {
    parts_->require_derivative();
    if (of_nodes.size() == static_cast<std::size_t>(parts_->mesh->owned_nodes)) return;
    throw InputError(fmt::format("the gradient has {} rows on rank {}, which owns {} nodes", of_nodes.size(),
                                 parts_->comm.rank(), parts_->mesh->owned_nodes));
  });
  const std::vector<Point> of_vertices = parts_->derivative->gradient(of_nodes);
  std::vector<std::vector<Point>> of_points;
  for (const std::vector<std::int32_t>& vertices : parts_->vertices) {
    of_points.emplace_back();
    for (const std::int32_t v : vertices) of_points.back().push_back(of_vertices[v]);
  }
  return of_points;
}

}  // namespace quadloop
