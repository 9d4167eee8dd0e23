#include "io/plot/canvas/colour_map.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace quadloop::io {

namespace {

template <std::size_t count>
Colour interpolated(const std::array<Colour, count>& stops, double t) {
  const double at = std::clamp(t, 0.0, 1.0) * (count - 1);
  const auto i = std::min(static_cast<std::size_t>(at), count - 2);
  return mixed(stops[i], stops[i + 1], at - static_cast<double>(i));
}

/// Diverging map of two colours with a pale grey centre (Moreland 2009).
Colour diverging_colour(double t) {
  static constexpr std::array<Colour, 9> stops{{{0.231, 0.298, 0.753},
                                                {0.384, 0.510, 0.918},
                                                {0.553, 0.690, 0.996},
                                                {0.722, 0.816, 0.976},
                                                {0.867, 0.867, 0.867},
                                                {0.961, 0.769, 0.678},
                                                {0.957, 0.604, 0.482},
                                                {0.871, 0.376, 0.302},
                                                {0.706, 0.016, 0.149}}};
  return interpolated(stops, t);
}

Colour plasma_colour(double t) {
  static constexpr std::array<Colour, 9> stops{{{0.050, 0.030, 0.528},
                                                {0.294, 0.012, 0.631},
                                                {0.492, 0.012, 0.658},
                                                {0.658, 0.134, 0.588},
                                                {0.798, 0.280, 0.470},
                                                {0.899, 0.422, 0.361},
                                                {0.973, 0.580, 0.254},
                                                {0.993, 0.765, 0.157},
                                                {0.940, 0.975, 0.131}}};
  return interpolated(stops, t);
}

Colour grey_colour(double t) {
  return interpolated(std::array<Colour, 2>{{{0.08, 0.08, 0.08}, {0.98, 0.98, 0.98}}}, t);
}

constexpr std::array<std::pair<const char*, ColourMap>, 4> maps{{{"viridis", perceptual_colour},
                                                                 {"coolwarm", diverging_colour},
                                                                 {"grey", grey_colour},
                                                                 {"plasma", plasma_colour}}};

}  // namespace

std::vector<std::string> colour_map_names() {
  std::vector<std::string> names;
  for (const auto& [name, map] : maps) names.emplace_back(name);
  return names;
}

ColourMap colour_map_named(const std::string& name) {
  const auto* const found =
      std::find_if(maps.begin(), maps.end(), [&](const auto& map) { return map.first == name; });
  return found == maps.end() ? nullptr : found->second;
}

Colour perceptual_colour(double t) {  // stops of viridis
  static constexpr std::array<Colour, 9> stops{{{0.267, 0.005, 0.329},
                                                {0.279, 0.175, 0.483},
                                                {0.230, 0.322, 0.546},
                                                {0.173, 0.449, 0.558},
                                                {0.128, 0.567, 0.551},
                                                {0.158, 0.684, 0.502},
                                                {0.369, 0.789, 0.383},
                                                {0.678, 0.864, 0.190},
                                                {0.993, 0.906, 0.144}}};
  return interpolated(stops, t);
}

Colour quality_colour(double t) {
  constexpr Colour red{0.80, 0.13, 0.12}, yellow{0.98, 0.85, 0.35}, green{0.36, 0.68, 0.38};
  return interpolated(std::array<Colour, 3>{{red, yellow, green}}, t);
}

}  // namespace quadloop::io
