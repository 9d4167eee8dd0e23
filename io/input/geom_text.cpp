#include "io/input/geom_text.hpp"

#include <fmt/format.h>

#include <charconv>

#include "io/input/line_reader.hpp"

namespace quadloop {

namespace {

Chain read_chain(LineReader& lines, std::int64_t number, std::int64_t total) {
  lines.require_next(fmt::format("the name of boundary {} of {}", number, total));
  const auto& words = lines.words();
  if (words.size() > 2 || (words.size() == 2 && words[1] != "open")) {
    lines.refuse(fmt::format("'{}' is not a boundary's name; it is one word, followed by 'open' where it is an open chain (is a count too small?)",
                             fmt::join(words, " ")));
  }
  Chain chain{std::string(words[0]), words.size() == 2, {}, lines.place()};
  lines.require_next(fmt::format("the number of points of boundary '{}'", chain.name));
  if (lines.words().size() != 1) lines.refuse(fmt::format("the number of points of boundary '{}' should stand here alone", chain.name));
  const std::int64_t count = lines.count(0, fmt::format("points of boundary '{}'", chain.name));
  for (std::int64_t i = 1; i <= count; ++i) {
    lines.require_next(fmt::format("point {} of {} of boundary '{}'", i, count, chain.name));
    if (lines.words().size() != 2) {
      lines.refuse(fmt::format("point {} of {} of boundary '{}' should be two numbers, not '{}' (is the count too large?)", i, count, chain.name,
                               fmt::join(lines.words(), " ")));
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

const std::string& name_of(const Geometry& geometry, std::int32_t segment) { return geometry.boundary(geometry.boundary_of(segment)).name; }

/// The first segment of a loop before which the boundary changes, or -1 where it never does.
std::int32_t first_change(const Geometry& geometry, std::int32_t loop) {
  for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) {
    if (geometry.boundary_of(v) != geometry.boundary_of(geometry.previous(v))) return v;
  }
  return -1;
}

/// Returns the number of entries written.
std::int64_t append_loop(std::string& text, const Geometry& geometry, std::int32_t loop) {
  const std::int32_t change = first_change(geometry, loop), begin = geometry.loop_start(loop), end = geometry.loop_start(loop + 1);
  if (change < 0) {
    text += fmt::format("{}\n{}\n", name_of(geometry, begin), end - begin);
    for (std::int32_t v = begin; v < end; ++v) append(text, geometry.point(v));
    return 1;
  }
  std::int64_t entries = 0;
  std::int32_t v = change;
  do {
    const BoundaryId boundary = geometry.boundary_of(v);
    std::string rows;
    std::int32_t count = 1;
    append(rows, geometry.point(v));
    do {
      v = geometry.next(v);
      append(rows, geometry.point(v));
      ++count;
    } while (geometry.boundary_of(v) == boundary && v != change);
    text += fmt::format("{} open\n{}\n", geometry.boundary(boundary).name, count) + rows;
    ++entries;
  } while (v != change);
  return entries;
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
    lines.refuse(fmt::format(
        "more text after the last of {} boundaries; correct the number of boundaries in the first row or of points before this one", total));
  }
  return chains;
}

std::string geom_text(const Geometry& geometry) {
  std::string entries;
  std::int64_t count = 0;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) count += append_loop(entries, geometry, loop);
  return fmt::format("# The domain lies to the left of each boundary.\n{}\n", count) + entries;
}

}  // namespace quadloop
