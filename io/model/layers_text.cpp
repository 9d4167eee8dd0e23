#include "io/model/layers_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "io/text/text_scanner.hpp"

namespace quadloop::io {

std::string_view next_word(std::string_view& text) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r"), text.size());
  text.remove_prefix(begin);
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r"));
  text.remove_prefix(word.size());
  return word;
}

std::string text_of_layers(const WallLayers& layers) {
  std::array<char, 32> number{};
  const char* const end = std::to_chars(number.data(), number.data() + number.size(), layers.thickness).ptr;
  return std::to_string(layers.count) + " " + std::string(static_cast<const char*>(number.data()), end);
}

WallLayers layers_of_text(std::string_view text) {
  const std::string_view count = next_word(text), thickness = next_word(text);
  WallLayers layers;
  const auto [stopped, error] = std::from_chars(count.data(), count.data() + count.size(), layers.count);
  const bool is_count = error == std::errc{} && stopped == count.data() + count.size() && layers.count > 0;
  if (!is_count || !next_word(text).empty()) return {};
  if (thickness.empty()) return layers;
  const bool is_thickness =
      parse_real(thickness, layers.thickness) && std::isfinite(layers.thickness) && layers.thickness >= 0;
  return is_thickness ? layers : WallLayers{};
}

}  // namespace quadloop::io
