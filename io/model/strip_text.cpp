#include "io/model/strip_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "io/model/layers_text.hpp"
#include "io/text/text_scanner.hpp"

namespace quadloop::io {

namespace {

constexpr std::string_view head = "# strip ", nodes_head = "# nodes ", of_wake = "wake", of_line = "line";

std::optional<std::int32_t> whole_number(std::string_view word) {
  std::int32_t number = 0;
  const auto [stopped, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || stopped != word.data() + word.size() || number < 1) return {};
  return number;
}

/// The current strip while comments are read line by line.
struct Unfinished {
  StripLayers strip;
  std::size_t wanted = 0;  ///< expected number of nodes

  bool is_whole() const { return strip.nodes.size() == wanted; }
};

std::optional<Unfinished> begun(std::string_view text) {
  Unfinished begun;
  StripLayers& strip = begun.strip;
  strip.name = next_word(text);
  const auto count = whole_number(next_word(text));
  const bool is_thickness = parse_real(next_word(text), strip.layers.thickness) &&
                            std::isfinite(strip.layers.thickness) && strip.layers.thickness >= 0;
  const auto across = whole_number(next_word(text)), columns = whole_number(next_word(text));
  const std::string_view kind = next_word(text);
  const bool is_kind = kind == of_wake || kind == of_line;
  if (!count || !is_thickness || !across || !columns || !is_kind || !next_word(text).empty()) return {};
  strip.layers.count = *count;
  strip.across = *across;
  strip.from_wall = kind == of_wake;
  begun.wanted = static_cast<std::size_t>(*across) * *columns;
  return begun;
}

/// Reads the nodes of one line; returns false if it contains anything else, or too many.
bool add_nodes(std::string_view text, Unfinished& to) {
  for (std::string_view word = next_word(text); !word.empty(); word = next_word(text)) {
    const std::size_t dash = word.find('-');
    const auto first = whole_number(word.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : whole_number(word.substr(dash + 1));
    if (!first || !last) return false;
    const std::int32_t step = *first <= *last ? 1 : -1;
    if (std::size_t(std::abs(*last - *first)) >= to.wanted - to.strip.nodes.size()) return false;
    for (std::int32_t node = *first; node != *last + step; node += step)
      to.strip.nodes.emplace_back(node - 1);
  }
  return true;
}

}  // namespace

std::string comments_of(const StripLayers& strip) {
  constexpr int runs_of_line = 8;
  std::string text = fmt::format("{}{} {} {} {} {}\n", head, strip.name, text_of_layers(strip.layers),
                                 strip.across, strip.columns(), strip.from_wall ? of_wake : of_line);
  const auto number = [&](std::size_t i) { return strip.nodes[i].value() + 1; };
  int runs = 0;
  for (std::size_t i = 0; i < strip.nodes.size();) {
    const std::size_t first = i++;
    const std::int64_t step = i < strip.nodes.size() ? number(i) - number(first) : 0;
    if (step == 1 || step == -1) {
      while (i < strip.nodes.size() && number(i) - number(i - 1) == step) ++i;
    }
    text += runs == 0 ? "# nodes" : "";
    text += i - first > 1 ? fmt::format(" {}-{}", number(first), number(i - 1))
                          : fmt::format(" {}", number(first));
    runs = (runs + 1) % runs_of_line;
    if (runs == 0 || i == strip.nodes.size()) text += "\n";
  }
  return text;
}

StripsInText strips_in_comments(std::string_view comments, std::int32_t nodes_of_mesh) {
  StripsInText found;
  std::optional<Unfinished> under_way;
  const auto end = [&](bool damaged) {
    if (!under_way) return;
    const bool good = !damaged && under_way->is_whole() && is_sound(under_way->strip, nodes_of_mesh);
    StripLayers strip = std::move(under_way->strip);
    under_way.reset();
    if (good)
      found.strips.push_back(std::move(strip));
    else
      found.damaged.push_back(strip.name);
  };
  while (!comments.empty()) {
    std::string_view line = comments.substr(0, comments.find('\n'));
    comments.remove_prefix(std::min(line.size() + 1, comments.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with(head)) {
      end(false);
      under_way = begun(line.substr(head.size()));
      std::string_view rest = line.substr(head.size());
      if (!under_way) found.damaged.emplace_back(next_word(rest));
    } else if (under_way && line.starts_with(nodes_head)) {
      if (!add_nodes(line.substr(nodes_head.size()), *under_way)) end(true);
    }
  }
  end(false);
  return found;
}

bool is_sound(const StripLayers& strip, std::int64_t nodes_of_mesh) {
  if (strip.layers.count < 1 || strip.across < 1 || strip.columns() < 2) return false;
  if ((strip.across - 1) / 2 < strip.layers.count || std::ssize(strip.nodes) % strip.across != 0)
    return false;
  std::vector<GlobalNodeId> sorted = strip.nodes;
  std::ranges::sort(sorted);
  return sorted.front().value() >= 0 && sorted.back().value() < nodes_of_mesh &&
         std::ranges::adjacent_find(sorted) == sorted.end();
}

}  // namespace quadloop::io
