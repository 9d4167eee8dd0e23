#include "mesher/geometry/layer_spec.hpp"

#include <algorithm>

namespace quadloop {

namespace {

constexpr int layers_before_rise = 5;
constexpr double rise = 1.05;

/// Calls `visit` with each height relative to the first one, and its derivative, with the excess of each
/// growth ratio scaled by `share`.
template <class Visit>
void for_relative_heights(const LayerSpec& spec, double share, const Visit& visit) {
  double height = 1, slope = 0, growth = spec.growth;
  for (int layer = 0; layer < spec.count; ++layer) {
    if (layer >= spec.equal) {
      const double ratio = 1 + share * (growth - 1);
      slope = slope * ratio + height * (growth - 1);
      height *= ratio;
      if (layer - spec.equal + 1 >= layers_before_rise) growth = std::min(spec.growth_to, rise * growth);
    }
    visit(height, slope);
  }
}

std::vector<double> relative_heights(const LayerSpec& spec, double share) {
  std::vector<double> heights;
  heights.reserve(spec.count);
  for_relative_heights(spec, share, [&](double height, double) { heights.push_back(height); });
  return heights;
}

/// Total thickness relative to the first layer, and its derivative with respect to the factor.
struct Thickness {
  double sum = 0, slope = 0;
};

Thickness relative_thickness(const LayerSpec& spec, double share) {
  Thickness all;
  for_relative_heights(spec, share, [&](double height, double slope) {
    all.sum += height;
    all.slope += slope;
  });
  return all;
}

/// The factor of the growth ratios for which the total thickness is this multiple of the first layer:
/// Newton's method from 1 downwards, which converges monotonically, as the thickness is a polynomial of the
/// factor with no negative coefficient.
double share_for(const LayerSpec& spec, double thickness) {
  double share = 1;
  for (;;) {
    const auto [sum, slope] = relative_thickness(spec, share);
    if (sum <= thickness || slope == 0) return share;
    const double next = std::max(0.0, share - (sum - thickness) / slope);
    if (next >= share) return share;
    share = next;
  }
}

/// Limits of the factor by which the excess of growth ratios over 1 is scaled.
struct ShareLimits {
  double low = 0, high = 1;
};

/// Layers like `other` with growth ratios between those of `spec` scaled by the limits: the largest ones with
/// at most this thickness, else the smallest ones.
LayerSpec with_scaled_growth(const LayerSpec& spec, LayerSpec other, double thickness,
                             const ShareLimits& limits) {
  constexpr int halvings = 80;
  const auto scale = [&](double share) {
    other.growth = 1 + share * (spec.growth - 1);
    other.growth_to = 1 + share * (spec.growth_to - 1);
  };
  auto [low, high] = limits;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    scale(middle);
    (layers_thickness(other) <= thickness ? low : high) = middle;
  }
  scale(low);
  return other;
}

}  // namespace

std::vector<double> layer_heights(const LayerSpec& spec) {
  std::vector<double> heights = relative_heights(spec, 1);
  for (double& height : heights) height *= spec.first;
  return heights;
}

double layers_thickness(const LayerSpec& spec) { return spec.first * relative_thickness(spec, 1).sum; }

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

double thickness_with_last(const LayerSpec& spec, double last) {
  constexpr int halvings = 50;
  const auto last_with = [&](double share) { return spec.first * relative_heights(spec, share).back(); };
  if (last_with(1) <= last) return layers_thickness(spec);
  double low = 0, high = 1;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (last_with(middle) <= last ? low : high) = middle;
  }
  return spec.first * relative_thickness(spec, low).sum;
}

LayerSpec with_first_height(const LayerSpec& spec, double first) {
  constexpr double most = 1.5;
  const double thickness = layers_thickness(spec);
  LayerSpec other = spec;
  other.first = std::min(first, thickness / spec.count);
  return with_scaled_growth(spec, other, thickness, {0, most});
}

LayerSpec with_thickness(const LayerSpec& spec, double first, double thickness) {
  constexpr double least_share = 0.7, most_growth = 1.3;
  LayerSpec other = spec;
  other.first = first;
  const double high = spec.growth_to < most_growth ? (most_growth - 1) / (spec.growth_to - 1) : 1;
  return with_scaled_growth(spec, other, thickness, {least_share, high});
}

ColumnHeights column_heights(const LayerSpec& spec, double first, double length) {
  ColumnHeights column{{0}, std::min(first, length / spec.count), spec.growth};
  const double share = share_for(spec, length / column.first);
  const std::vector<double> heights = relative_heights(spec, share);
  column.growth = 1 + share * (spec.growth - 1);
  const double unit = length / relative_thickness(spec, share).sum;  // removes the remaining rounding error
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
