#include "io/input/geom_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "io/input/line_reader.hpp"

namespace quadloop::io {

namespace {

Chain read_chain(LineReader& lines, std::int64_t number, std::int64_t total) {
  lines.require_next(fmt::format("the name of boundary {} of {}", number, total));
  const auto& words = lines.words();
  if (words.size() > 2 || (words.size() == 2 && words[1] != "open")) {
    lines.refuse(
        fmt::format("'{}' is not a boundary's name; it is one word, followed by 'open' where it is an open "
                    "chain (is a count too small?)",
                    fmt::join(words, " ")));
  }
  Chain chain{std::string(words[0]), words.size() == 2, {}, lines.place()};
  lines.require_next(fmt::format("the number of points of boundary '{}'", chain.name));
  if (lines.words().size() != 1)
    lines.refuse(fmt::format("the number of points of boundary '{}' should stand here alone", chain.name));
  const std::int64_t count = lines.count(0, fmt::format("points of boundary '{}'", chain.name));
  chain.points.reserve(std::min<std::size_t>(count, lines.most_points_left()));
  for (std::int64_t i = 1; i <= count; ++i) {
    if (Point p; lines.next_point(p)) {
      chain.points.push_back(p);
      continue;
    }
    lines.require_next(fmt::format("point {} of {} of boundary '{}'", i, count, chain.name));
    if (lines.words().size() != 2) {
      lines.refuse(fmt::format(
          "point {} of {} of boundary '{}' should be two numbers, not '{}' (is the count too large?)", i,
          count, chain.name, fmt::join(lines.words(), " ")));
    }
    chain.points.push_back({lines.real(0), lines.real(1)});
  }
  return chain;
}

void append(std::string& text, double value) {
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
  text.append(digits, end);
}

void append(std::string& text, Point p) {
  append(text, p.x);
  text += ' ';
  append(text, p.y);
  text += '\n';
}

}  // namespace

std::vector<Chain> read_geom(const std::string& path) {
  LineReader lines(path);
  lines.require_next("the number of boundaries");
  if (lines.words().size() != 1) lines.refuse("the number of boundaries should stand here alone");
  const std::int64_t total = lines.count(0, "boundaries");
  std::vector<Chain> chains;
  for (std::int64_t i = 1; i <= total; ++i) chains.push_back(read_chain(lines, i, total));
  if (lines.next()) {
    lines.refuse(
        fmt::format("more text after the last of {} boundaries; correct the number of boundaries in the "
                    "first row or of points before this one",
                    total));
  }
  return chains;
}

std::string geom_text(const Geometry& geometry) {
  const std::vector<Chain> chains = chains_of(geometry);
  std::string text = fmt::format("# The domain lies to the left of each boundary.\n{}\n", chains.size());
  for (const Chain& chain : chains) {
    text += fmt::format("{}{}\n{}\n", chain.name, chain.open ? " open" : "", chain.points.size());
    for (const Point p : chain.points) append(text, p);
  }
  return text;
}

}  // namespace quadloop::io
