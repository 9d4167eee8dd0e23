#pragma once

#include <string>
#include <vector>

#include "io/plot/canvas/plot_canvas.hpp"

namespace quadloop::io {

/// Maps a number from 0 to 1 to a colour; values outside are clamped.
using ColourMap = Colour (*)(double);

/// "viridis", "coolwarm", "grey", "plasma".
std::vector<std::string> colour_map_names();

/// Returns the map of this name; null if there is none.
ColourMap colour_map_named(const std::string& name);

/// Viridis: 0 dark blue to 1 yellow, perceptually uniform.
Colour perceptual_colour(double t);
/// 0 red, 0.5 yellow, 1 green.
Colour quality_colour(double t);

}  // namespace quadloop::io
