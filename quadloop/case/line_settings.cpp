#include "quadloop/case/line_settings.hpp"

#include <fmt/format.h>

namespace quadloop {

namespace {

std::vector<Point> read_path(const CaseTable& table) {
  std::vector<Point> path;
  for (const std::vector<double>& point : table.pairs("path")) {
    path.push_back({point[0], point[1]});
    if (path.size() > 1 && path[path.size() - 2] == path.back())
      table.refuse("path",
                   fmt::format("has the point ({}, {}) twice in a row", path.back().x, path.back().y));
  }
  return path;
}

double read_spacing(const CaseTable& table) {
  const auto spacing = table.number("spacing", Range::positive());
  if (!spacing) table.refuse("spacing", "is missing: the length of cells along the line");
  return *spacing;
}

LayerLine read_wake(const CaseTable& table) {
  LayerLine wake;
  wake.from = table.text("from").value_or("");
  if (wake.from.empty())
    table.refuse("from", "is missing: the boundary at whose sharp or blunt edge the wake begins");
  wake.path = read_path(table);
  const auto length = table.number("length", Range::positive());
  if (length.has_value() != wake.path.empty())
    table.refuse("length", "or path must be given, and not both: how far the wake goes on, or where");
  wake.length = length.value_or(0);
  wake.spacing = read_spacing(table);
  table.finish();
  return wake;
}

LayerLine read_free_line(const CaseTable& table, LayerSettings& layer_settings) {
  LayerLine line;
  line.path = read_path(table);
  if (line.path.size() < 2) table.refuse("path", "must have two points at least");
  line.spacing = read_spacing(table);
  line.layers = layer_settings.read_among_others(table);
  table.finish();
  return line;
}

}  // namespace

std::vector<LayerLine> read_layer_lines(const CaseTable& root, LayerSettings& layer_settings) {
  std::vector<LayerLine> lines;
  for (const CaseTable& wake : root.tables("wake")) lines.push_back(read_wake(wake));
  for (const CaseTable& line : root.tables("layer_line"))
    lines.push_back(read_free_line(line, layer_settings));
  return lines;
}

}  // namespace quadloop
