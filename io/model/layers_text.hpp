#pragma once

#include <string>
#include <string_view>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The next word of the text, which loses it; empty at its end.
std::string_view next_word(std::string_view& text);

/// Count and thickness as files keep them, "30 0.0118": the shortest text that reads back to the same double.
std::string text_of_layers(const WallLayers& layers);

/// The way back. The thickness may be missing. No layers where the text is no such thing.
WallLayers layers_of_text(std::string_view text);

}  // namespace quadloop
