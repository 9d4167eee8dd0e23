#include "io/model/pair_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/model/layers_text.hpp"
#include "io/model/node_text.hpp"
#include "io/model/strip_text.hpp"
#include "io/text/text_scanner.hpp"

namespace quadloop::io {

namespace {

constexpr std::string_view pair_head = "# pair ", by_translation = "translation", by_rotation = "rotation";

std::optional<double> next_number(std::string_view& text) {
  double number = 0;
  if (!parse_real(next_word(text), number) || !std::isfinite(number)) return {};
  return number;
}

std::optional<PeriodicPair> pair_of(std::string_view text) {
  PeriodicPair pair;
  pair.from = next_word(text);
  pair.to = next_word(text);
  const std::string_view kind = next_word(text);
  if (kind != by_translation && kind != by_rotation) return {};
  const std::optional<double> degrees = kind == by_rotation ? next_number(text) : 0, x = next_number(text),
                              y = next_number(text);
  if (!degrees || !x || !y || pair.from == pair.to || !next_word(text).empty()) return {};
  pair.degrees = *degrees;
  (pair.rotates() ? pair.centre : pair.translation) = {*x, *y};
  return pair;
}

}  // namespace

std::string comment_of(const PeriodicPair& pair) {
  const std::string names = fmt::format("{}{} {} ", pair_head, pair.from, pair.to);
  return pair.rotates()
             ? names + fmt::format("{} {} {} {}\n", by_rotation, pair.degrees, pair.centre.x, pair.centre.y)
             : names + fmt::format("{} {} {}\n", by_translation, pair.translation.x, pair.translation.y);
}

std::vector<PeriodicPair> pairs_in_comments(std::string_view comments) {
  std::vector<PeriodicPair> pairs;
  while (!comments.empty()) {
    const std::string_view line = first_line(comments);
    if (!line.starts_with(pair_head)) continue;
    if (const auto pair = pair_of(line.substr(pair_head.size()))) pairs.push_back(*pair);
  }
  return pairs;
}

std::string comments_of(const Mesh& mesh) {
  std::string text;
  for (const StripLayers& strip : mesh.strips) text += comments_of(strip);
  for (const PeriodicPair& pair : mesh.pairs) text += comment_of(pair);
  for (const NamedNode& node : mesh.named_nodes) text += comment_of(node);
  return text;
}

}  // namespace quadloop::io
