#pragma once

#include <string>
#include <vector>

#include "io/plot/canvas/plot_canvas.hpp"

namespace quadloop {

/// The colour of a number from 0 to 1; what lies outside has that of the nearer end.
using ColourMap = Colour (*)(double);

/// "viridis", "coolwarm", "grey", "plasma".
std::vector<std::string> colour_map_names();

/// One of these by its name; null where there is none.
ColourMap colour_map_named(const std::string& name);

/// Viridis: 0 dark blue to 1 yellow, evenly perceived.
Colour perceptual_colour(double t);
/// 0 red, 0.5 yellow, 1 green.
Colour quality_colour(double t);

}  // namespace quadloop
