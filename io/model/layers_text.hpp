#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Removes and returns the next word of the text; empty at its end.
std::string_view next_word(std::string_view& text);

/// Removes and returns the first line of the text, without blanks before it.
std::string_view first_line(std::string_view& text);

/// A whole number from 1 to `most`, which must be all of the word.
std::optional<std::int32_t> counted_number(std::string_view word, std::int32_t most);

/// Returns count and thickness as stored in files, "30 0.0118": the shortest text that reads back to the same
/// double.
std::string text_of_layers(const WallLayers& layers);

/// Inverse of text_of_layers(). The thickness may be missing. Returns no layers if the text is invalid.
WallLayers layers_of_text(std::string_view text);

}  // namespace quadloop::io
