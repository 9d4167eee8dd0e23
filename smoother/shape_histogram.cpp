#include "smoother/shape_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/mesh/check/quality.hpp"
#include "smoother/objective/condition_number.hpp"

namespace quadloop::smoother {

namespace {

constexpr double flat_degrees = 180;

template <std::size_t width>
constexpr double ideal_degrees = width == 3 ? 60 : 90;

enum ShapeMeasure : std::size_t { angle, aspect, skewness, condition };

template <std::size_t width>
void add_cell(const std::array<Point, width>& cell, std::vector<Histogram>& histograms) {
  constexpr double ideal = ideal_degrees<width>;
  const auto targets = ideal_targets<width>();
  double longest = 0, shortest = std::numeric_limits<double>::infinity(), skew = 0, worst = 0;
  for (std::size_t k = 0; k < width; ++k) {
    const Point &next = cell[(k + 1) % width], &previous = cell[(k + width - 1) % width];
    const double degrees = corner_degrees(previous, cell[k], next), edge = length(next - cell[k]);
    histograms[angle].add(degrees);
    longest = std::max(longest, edge);
    shortest = std::min(shortest, edge);
    skew = std::max({skew, (degrees - ideal) / (flat_degrees - ideal), (ideal - degrees) / ideal});
    const CornerForm form = corner_form(cell[k], next, previous);
    worst = std::max(worst, is_inverted(form) ? std::numeric_limits<double>::infinity()
                                              : condition_number(form, targets[k]));
  }
  histograms[aspect].add(longest / shortest);
  histograms[skewness].add(skew);
  histograms[condition].add(worst);
}

}  // namespace

void Histogram::add(double value) {
  ++counts[std::upper_bound(limits.begin(), limits.end(), value) - limits.begin()];
}

std::vector<Histogram> shape_histograms(const Communicator& comm, const Mesh& mesh) {
  std::vector<Histogram> histograms{{"angle", {0, 15, 20, 25, 30, 45, 60, 75, 90, 105, 120, 135, 150}, {}},
                                    {"aspect ratio", {1.25, 1.5, 2, 3, 5, 10}, {}},
                                    {"skewness", {0.1, 0.25, 0.5, 0.75, 0.9, 1}, {}},
                                    {"condition number", {1.05, 1.1, 1.25, 1.5, 2, 5, 10}, {}}};
  for (Histogram& h : histograms) h.counts.assign(h.limits.size() + 1, 0);
  const auto add_cells = [&](const auto& cells) {
    for (const auto& nodes : cells) {
      std::array<Point, std::tuple_size_v<std::remove_cvref_t<decltype(nodes)>>> points;
      for (std::size_t k = 0; k < nodes.size(); ++k) points[k] = mesh.point(nodes[k]);
      add_cell(points, histograms);
    }
  };
  add_cells(mesh.triangles);
  add_cells(mesh.quads);
  for (Histogram& h : histograms) h.counts = comm.sum(h.counts);
  return histograms;
}

}  // namespace quadloop::smoother
