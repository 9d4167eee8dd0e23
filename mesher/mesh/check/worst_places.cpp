#include "mesher/mesh/check/worst_places.hpp"

#include <array>
#include <limits>

#include "mesher/mesh/check/corner_range.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

namespace {

class WorstCells {
 public:
  WorstCells(const Mesh& mesh, const LayerPlaces& layers) : mesh_{mesh}, layers_{layers} {
    look_at(mesh.triangles);
    look_at(mesh.quads);
  }
  const WorstPlaces& places() const { return places_; }

 private:
  template <std::size_t width>
  void look_at(const std::vector<std::array<NodeId, width>>& cells) {
    for (const auto& nodes : cells) {
      if (!layers_.empty() && is_layer_cell(layers_, nodes)) continue;
      std::array<Point, width> cell;
      Point sum;
      for (std::size_t k = 0; k < width; ++k) {
        cell[k] = mesh_.point(nodes[k]);
        sum = sum + cell[k];
      }
      look_at_corners(cell);
      const double quality = quality_of(cell);
      if (quality >= worst_) continue;
      worst_ = quality;
      places_.worst_quality = 1.0 / width * sum;
    }
  }

  template <std::size_t width>
  void look_at_corners(const std::array<Point, width>& cell) {
    for (std::size_t k = 0; k < width; ++k) {
      const double smallest = angles_.smallest(), largest = angles_.largest();
      angles_.include({cell[(k + width - 1) % width], cell[k], cell[(k + 1) % width]});
      if (angles_.smallest() < smallest) places_.smallest_angle = cell[k];
      if (angles_.largest() > largest) places_.largest_angle = cell[k];
    }
  }

  const Mesh& mesh_;
  const LayerPlaces& layers_;
  CornerRange angles_;
  double worst_ = std::numeric_limits<double>::infinity();
  WorstPlaces places_;
};

Point place_of_largest_ratio(const Mesh& mesh, const MeshTopology& topology) {
  const std::vector<double> areas = cell_areas(mesh);
  double largest = 0;
  Point place;
  auto beyond = topology.beyond().begin();
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    const std::int32_t other = *beyond++;
    if (other < 0 || to < from) return;
    const double ratio = area_ratio(areas[cell], areas[other]);
    if (ratio <= largest) return;
    largest = ratio;
    place = 0.5 * (mesh.point(from) + mesh.point(to));
  });
  return place;
}

}  // namespace

WorstPlaces worst_places(const Mesh& whole_mesh, const MeshTopology& topology, const LayerPlaces& places) {
  WorstPlaces worst = WorstCells(whole_mesh, places).places();
  worst.largest_area_ratio = place_of_largest_ratio(whole_mesh, topology);
  return worst;
}

}  // namespace quadloop
