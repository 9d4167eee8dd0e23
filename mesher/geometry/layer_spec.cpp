#include "mesher/geometry/layer_spec.hpp"

#include <algorithm>

namespace quadloop {

namespace {

constexpr int layers_before_rise = 5;
constexpr double rise = 1.05;

/// Visits the heights over the first one, when the excess of each growth is scaled by `share`.
template <class Visit>
void for_relative_heights(const LayerSpec& spec, double share, const Visit& visit) {
  double height = 1, growth = spec.growth;
  for (int layer = 0; layer < spec.count; ++layer) {
    if (layer >= spec.equal) {
      height *= 1 + share * (growth - 1);
      if (layer - spec.equal + 1 >= layers_before_rise) growth = std::min(spec.growth_to, rise * growth);
    }
    visit(height);
  }
}

std::vector<double> relative_heights(const LayerSpec& spec, double share) {
  std::vector<double> heights;
  heights.reserve(spec.count);
  for_relative_heights(spec, share, [&](double height) { heights.push_back(height); });
  return heights;
}

double relative_thickness(const LayerSpec& spec, double share) {
  double sum = 0;
  for_relative_heights(spec, share, [&](double height) { sum += height; });
  return sum;
}

/// The share of the growths by which the layers are so many times as thick as the first one.
double share_for(const LayerSpec& spec, double thickness) {
  if (relative_thickness(spec, 1) <= thickness) return 1;
  constexpr int halvings = 80;
  double low = 0, high = 1;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;  // no double between them: nothing would change any more
    (relative_thickness(spec, middle) <= thickness ? low : high) = middle;
  }
  return low;
}

}  // namespace

std::vector<double> layer_heights(const LayerSpec& spec) {
  std::vector<double> heights = relative_heights(spec, 1);
  for (double& height : heights) height *= spec.first;
  return heights;
}

double layers_thickness(const LayerSpec& spec) { return spec.first * relative_thickness(spec, 1); }

int layers_within(const LayerSpec& spec, double thickness, int most) {
  LayerSpec one_more = spec;
  one_more.count = most;
  double reached = 0;
  int layers = 0;
  for (const double height : layer_heights(one_more)) {
    if (reached >= thickness) break;
    reached += height;
    ++layers;
  }
  return layers;
}

LayerSpec with_first_height(const LayerSpec& spec, double first) {
  constexpr double most = 1.5;
  constexpr int halvings = 80;
  const double thickness = layers_thickness(spec);
  LayerSpec other = spec;
  other.first = std::min(first, thickness / spec.count);
  const auto scale = [&](double share) {
    other.growth = 1 + share * (spec.growth - 1);
    other.growth_to = 1 + share * (spec.growth_to - 1);
  };
  double low = 0, high = most;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    scale(middle);
    (layers_thickness(other) <= thickness ? low : high) = middle;
  }
  scale(low);
  return other;
}

ColumnHeights column_heights(const LayerSpec& spec, double first, double length) {
  ColumnHeights column{{0}, std::min(first, length / spec.count), spec.growth};
  const double share = share_for(spec, length / column.first);
  const std::vector<double> heights = relative_heights(spec, share);
  column.growth = 1 + share * (spec.growth - 1);
  const double unit = length / relative_thickness(spec, share);  // takes away what bisection has left over
  double reached = 0;
  for (const double height : heights) {
    reached += unit * height;
    column.reached.push_back(reached);
  }
  column.reached.back() = length;
  column.first = unit;
  return column;
}

}  // namespace quadloop
