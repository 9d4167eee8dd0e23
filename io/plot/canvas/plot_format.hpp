#pragma once

#include <string>

namespace quadloop::io {

enum class PlotFormat { png, svg, pdf };

/// Returns the format of a picture's file by its suffix. Throws InputError for another suffix.
PlotFormat plot_format_of(const std::string& path);

}  // namespace quadloop::io
