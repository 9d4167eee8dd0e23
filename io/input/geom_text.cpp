#include "io/input/geom_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <span>

#include "io/input/line_reader.hpp"

namespace quadloop::io {

namespace {

/// Reads the curve to the next point after the two numbers of a point: `curve` and its control points between
/// its ends, then `weights` of all control points or `spacing`, where there are any.
Curve read_curve(const LineReader& lines) {
  Curve curve;
  const auto& words = lines.words();
  std::size_t w = 3;
  const auto is_number = [&] { return w < words.size() && words[w] != "weights" && words[w] != "spacing"; };
  while (is_number()) {
    const double x = lines.real(w++);
    if (!is_number()) lines.refuse("a control point of a curve should be two numbers");
    curve.inner.push_back({x, lines.real(w++)});
  }
  if (curve.straight() || curve.degree() > Curve::largest_degree)
    lines.refuse(
        fmt::format("a curve has 1 to {} control points between its ends", Curve::largest_degree - 1));
  if (w < words.size() && words[w] == "weights") {
    for (++w; is_number();) curve.weights.push_back(lines.real(w++));
    if (curve.weights.size() != curve.inner.size() + 2 || std::ranges::min(curve.weights) <= 0)
      lines.refuse(fmt::format("the curve needs {} weights above 0", curve.inner.size() + 2));
  }
  if (w + 2 == words.size() && words[w] == "spacing") curve.spacing = lines.real(w + 1), w += 2;
  if (w != words.size()) lines.refuse(fmt::format("'{}' is not part of a curve", words[w]));
  return curve;
}

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
    const auto& point = lines.words();
    const bool is_curve = point.size() > 2 && point[2] == "curve";
    if (point.size() != 2 && !is_curve) {
      lines.refuse(fmt::format(
          "point {} of {} of boundary '{}' should be two numbers, not '{}' (is the count too large?)", i,
          count, chain.name, fmt::join(point, " ")));
    }
    if (is_curve && chain.open && i == count)
      lines.refuse(fmt::format("the last point of the open chain '{}' begins no curve", chain.name));
    if (is_curve) {
      chain.curves.resize(i - 1);
      chain.curves.push_back(read_curve(lines));
    }
    chain.points.push_back({lines.real(0), lines.real(1)});
  }
  if (!chain.curves.empty()) chain.curves.resize(chain.points.size() - (chain.open ? 1 : 0));
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
}

void append(std::string& text, const Curve& curve) {
  if (curve.straight()) return;
  text += " curve";
  for (const Point p : curve.inner) {
    text += ' ';
    append(text, p);
  }
  if (!curve.weights.empty()) text += " weights";
  for (const double weight : curve.weights) {
    text += ' ';
    append(text, weight);
  }
  if (curve.spacing > 0) text += " spacing ";
  if (curve.spacing > 0) append(text, curve.spacing);
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

std::string geom_text(const Geometry& geometry) { return geom_text(chains_of(geometry)); }

std::string geom_text(std::span<const Chain> chains) {
  std::string text = fmt::format("# The domain lies to the left of each boundary.\n{}\n", chains.size());
  for (const Chain& chain : chains) {
    text += fmt::format("{}{}\n{}\n", chain.name, chain.open ? " open" : "", chain.points.size());
    for (std::size_t i = 0; i < chain.points.size(); ++i) {
      append(text, chain.points[i]);
      if (i < chain.curves.size()) append(text, chain.curves[i]);
      text += '\n';
    }
  }
  return text;
}

}  // namespace quadloop::io
