#include "adapt/remesh/boundary_layer/measured_thickness.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>

#include "adapt/remesh/boundary_layer/layer_edge.hpp"
#include "adapt/remesh/boundary_layer/wall_pieces.hpp"
#include "adapt/sensor/recovery/node_gradients.hpp"
#include "adapt/transfer/locate/cell_triangles.hpp"
#include "adapt/transfer/point_values.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::adapt {

namespace {

constexpr double first_sample = 0.005, last_sample = 10;  // thicknesses of the layers of the case
constexpr double sample_ratio = 1.1;
constexpr double share_of_gap = 0.5;

std::optional<std::array<std::size_t, 2>> velocity_among(const std::vector<std::string>& names) {
  const auto x = only_variable_like(names, "x_velocity"), y = only_variable_like(names, "y_velocity");
  if (!x || !y) return {};
  return {{*x, *y}};
}

/// Velocity and vorticity at owned nodes and ghosts. *Collective.*
Field velocity_and_vorticity(const Communicator& comm, const Mesh& mesh, const Field& solution) {
  const auto [x, y] = *velocity_among(solution.names);
  const Field with_all = with_ghosts(comm, mesh, solution);
  const std::vector<double> u = with_all.column(x), v = with_all.column(y);
  const std::vector<Point> of_u = node_gradients(comm, mesh, u), of_v = node_gradients(comm, mesh, v);
  Field field{{"x_velocity", "y_velocity", "vorticity"}, {}, {}};
  for (std::size_t i = 0; i < u.size(); ++i)
    field.values.insert(field.values.end(), {u[i], v[i], of_v[i].x - of_u[i].y});
  return field;
}

/// A wall node and the ray along its normal, in which the flow is sampled.
struct Ray {
  Point foot, normal;
  double first = 0, reach = 0;
};

/// The boundaries of a geometry, for the distance along a ray.
class Boundaries {
 public:
  explicit Boundaries(const Geometry& geometry)
      : geometry_{geometry}, tree_(geometry.size(), [&](std::int32_t s) {
          return box_of(geometry.point(s), geometry.point(geometry.next(s)));
        }) {}

  /// The distance of the nearest boundary beyond the first sample, at most `reach`.
  double distance(const Ray& ray, double reach) const {
    const Point from = ray.foot + ray.first * ray.normal, to = ray.foot + reach * ray.normal;
    double nearest = reach;
    tree_.for_each_meeting(box_of(from, to), [&](std::int32_t s) {
      const Point a = geometry_.point(s), b = geometry_.point(geometry_.next(s));
      const double across = cross(to - from, b - a);
      if (across == 0 || !segments_meet(from, to, a, b)) return;
      // mean from both ends, so that the result does not depend on the direction of the segment
      const double share = (cross(a - from, b - a) + cross(b - from, b - a)) / (2 * across);
      nearest = std::min(nearest, ray.first + share * (reach - ray.first));
    });
    return nearest;
  }

 private:
  const Geometry& geometry_;
  BoxTree tree_;
};

/// The walls whose layers follow the flow, and the thickness of these layers in the case.
struct FollowingWalls {
  explicit FollowingWalls(const Geometry& geometry) {
    for (const Boundary& boundary : geometry.boundaries()) {
      if (!boundary.layers || !boundary.layers->follows_flow) continue;
      names.push_back(boundary.name);
      thickness.push_back(layers_thickness(*boundary.layers));
    }
  }
  std::vector<std::string> names;
  std::vector<double> thickness;
};

/// This rank's equal share of the rays at all wall nodes.
std::vector<Ray> own_rays(const Communicator& comm, const Geometry& geometry, const FollowingWalls& walls,
                          const std::vector<WallPiece>& pieces) {
  const Boundaries boundaries(geometry);
  std::size_t all = 0, number = 0;
  for (const WallPiece& piece : pieces) all += piece.points.size();
  const std::size_t begin = all * comm.rank() / comm.size(), end = all * (comm.rank() + 1) / comm.size();
  std::vector<Ray> rays;
  for (const WallPiece& piece : pieces) {
    const double thickness = walls.thickness[piece.wall];
    for (std::size_t k = 0; k < piece.points.size(); ++k, ++number) {
      if (number < begin || number >= end) continue;
      Ray ray{piece.points[k], piece.normal(k), first_sample * thickness};
      const double most = last_sample * thickness, distance = boundaries.distance(ray, most / share_of_gap);
      ray.reach = std::min(most, share_of_gap * distance);
      rays.push_back(ray);
    }
  }
  return rays;
}

/// The heights of the samples along a ray.
std::vector<double> sample_heights(const Ray& ray) {
  std::vector<double> heights;
  for (double height = ray.first; height <= ray.reach; height *= sample_ratio) heights.push_back(height);
  return heights;
}

/// The distances of the edge along the rays, 0 where there is none. *Collective.*
std::vector<double> edges_along(const Communicator& comm, const Mesh& mesh, const Field& flow,
                                const std::vector<Ray>& rays) {
  std::vector<Point> places;
  for (const Ray& ray : rays) {
    for (const double height : sample_heights(ray)) places.push_back(ray.foot + height * ray.normal);
  }
  const auto owned = std::span(mesh.points).first(mesh.owned_nodes);
  const CurvePartition shares(comm, owned, places);
  const PointValues values(comm, mesh, flow, centre_of_nodes(comm, mesh), shares);
  const PointValues::Answers found = values.at(places);
  std::vector<double> edges;
  std::size_t place = 0;
  for (const Ray& ray : rays) {
    const Point along{ray.normal.y, -ray.normal.x};
    std::vector<ProfileSample> profile;
    bool is_inside = true;
    for (const double height : sample_heights(ray)) {
      const auto row = std::span(found.values).subspan(flow.width() * place, flow.width());
      is_inside = is_inside && found.is_inside[place] != 0;
      ++place;
      if (is_inside) profile.push_back({height, dot({row[0], row[1]}, along), -row[2]});
    }
    edges.push_back(layer_edge(profile).value_or(0));
  }
  return edges;
}

}  // namespace

bool has_velocity(const Field& solution) { return velocity_among(solution.names).has_value(); }

std::vector<MeasuredThickness> measured_thickness(const Communicator& comm, const Geometry& geometry,
                                                  const SolvedMesh& solved) {
  if (!has_velocity(solved.solution)) return {};
  const FollowingWalls walls(geometry);
  const std::vector<WallPiece> pieces = wall_pieces(comm, solved.mesh, walls.names);
  const Field flow = velocity_and_vorticity(comm, solved.mesh, solved.solution);
  const std::vector<double> own =
      edges_along(comm, solved.mesh, flow, own_rays(comm, geometry, walls, pieces));
  const std::vector<double> all = comm.all_gather_values(std::span<const double>(own));
  std::vector<MeasuredThickness> measured;
  auto first = all.begin();
  for (const WallPiece& piece : pieces) {
    const auto last = first + std::ssize(piece.points);
    const std::vector<double> values = smoothed(piece, {first, last});
    first = last;
    for (std::size_t k = 0; k < piece.edges(); ++k) {
      const std::size_t next = piece.next(k);
      const auto or_other = [&](std::size_t end, std::size_t other) {
        return values[end] > 0 ? values[end] : values[other];
      };
      measured.push_back({piece.points[k], piece.points[next], or_other(k, next), or_other(next, k)});
    }
  }
  return measured;
}

}  // namespace quadloop::adapt
