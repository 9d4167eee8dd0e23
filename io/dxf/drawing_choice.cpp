#include "io/dxf/drawing_choice.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/geometry/assemble/boundary_rules.hpp"

namespace quadloop::io {

bool matches_layer(const std::string& pattern, const std::string& layer) {
  return matches(small_letters(pattern), small_letters(layer));
}

bool DrawingChoice::has_layer(const std::string& layer) const {
  return layers.empty() ||
         std::ranges::any_of(layers, [&](const std::string& name) { return matches_layer(name, layer); });
}

std::string one_word(std::string name) {
  for (char& c : name) c = std::string_view(" \t\r\n\v\f,#").find(c) != std::string_view::npos ? '_' : c;
  return name;
}

std::string LeftOut::text() const {
  std::vector<std::string> kinds;
  for (const auto& [kind, count] : counts_) kinds.push_back(fmt::format("{} {}", count, kind));
  return fmt::format("{}", fmt::join(kinds, ", "));
}

void refuse_empty(const std::string& path, const DrawingChoice& choice,
                  const std::vector<std::string>& layers, const LeftOut& left_out) {
  if (!choice.layers.empty() && left_out.empty())
    throw InputError(
        fmt::format("{}: no layer of the file has lines or polygons and is one of [{}]; its layers are: {}",
                    path, fmt::join(choice.layers, ", "), first_few(layers)));
  throw InputError(fmt::format("{}: holds no lines and no polygons; a geometry needs closed outlines{}", path,
                               left_out.empty() ? "" : ". Left out: " + left_out.text()));
}

}  // namespace quadloop::io
