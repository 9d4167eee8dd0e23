#include "mesher/cut/hole_triangulation.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace quadloop {

namespace {

enum class Region : char { unknown, inside, outside };

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel,
                                                CGAL::Triangulation_face_base_with_info_2<Region, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Face = Triangulation::Face_handle;

/// Every loop edge passed once separates inside from outside; the infinite face is outside.
template <class Separates>
void label_regions(const Triangulation& triangulation, const Separates& separates) {
  for (const Face f : triangulation.all_face_handles()) f->info() = Region::unknown;
  std::vector<Face> open{triangulation.infinite_face()};
  open.back()->info() = Region::outside;
  while (!open.empty()) {
    const Face f = open.back();
    open.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Face next = f->neighbor(k);
      if (next->info() != Region::unknown) continue;
      const bool across = f->is_constrained(k) && separates(f, k);
      next->info() = (f->info() == Region::inside) != across ? Region::inside : Region::outside;
      open.push_back(next);
    }
  }
}

}  // namespace

void triangulate_region(std::span<const Point> points, std::span<const std::span<const std::int32_t>> loops,
                        std::vector<std::array<std::int32_t, 3>>& triangles) {
  Triangulation triangulation;
  std::map<std::int32_t, Triangulation::Vertex_handle> vertices;
  const auto vertex = [&](std::int32_t node) {
    auto& handle = vertices[node];
    if (handle == nullptr) {
      const Point p = points[node];
      handle = triangulation.insert({p.x, p.y});
      handle->info() = node;
    }
    return handle;
  };
  std::set<std::pair<std::int32_t, std::int32_t>> passed_once;
  for (const auto loop : loops) {
    if (loop.size() == 1) vertex(loop[0]);
    for (std::size_t i = 0; loop.size() > 1 && i < loop.size(); ++i) {
      const auto [passed, is_new] = passed_once.insert(std::minmax({loop[i], loop[(i + 1) % loop.size()]}));
      if (!is_new) passed_once.erase(passed);
      const auto from = vertex(loop[i]), to = vertex(loop[(i + 1) % loop.size()]);
      triangulation.insert_constraint(from, to);
    }
  }
  label_regions(triangulation, [&](Face f, int k) {
    const auto ends = std::minmax({f->vertex(f->cw(k))->info(), f->vertex(f->ccw(k))->info()});
    return passed_once.contains(ends);
  });
  for (const Face f : triangulation.finite_face_handles()) {
    if (f->info() != Region::inside) continue;
    triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
  }
}

}  // namespace quadloop
