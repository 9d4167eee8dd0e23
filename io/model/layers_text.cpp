#include "io/model/layers_text.hpp"

#include <algorithm>
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

std::string_view first_line(std::string_view& text) {
  std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return line;
}

std::optional<std::int32_t> counted_number(std::string_view word, std::int32_t most) {
  std::int32_t number = 0;
  const auto [stopped, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || stopped != word.data() + word.size() || number < 1 || number > most) return {};
  return number;
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
