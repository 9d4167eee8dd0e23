#include "io/msh/msh_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/msh/msh_text.hpp"

namespace quadloop::io {

namespace {

constexpr std::string_view node_section = "$NodeData", element_section = "$ElementData",
                           corner_section = "$ElementNodeData";

/// Reads a string up to the end of its line, without its quotes.
std::string read_text(TextScanner& scan) {
  scan.token("a string");
  scan.go_to(scan.place());
  std::string_view text = scan.rest_of_line();
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return std::string(text);
}

/// Reads after the line "$NodeData": strings (the first is the name), reals (time), integers (step,
/// components, rows, partition), then the rows, each with its tag and values.
MshValues read_section(TextScanner& scan, std::string_view head) {
  MshValues section;
  const std::size_t texts = scan.count("strings", 1);
  for (std::size_t i = 0; i < texts; ++i) {
    const std::string text = read_text(scan);
    if (i == 0) section.name = text;
  }
  if (section.name.empty()) section.name = "values";
  const std::size_t reals = scan.count("reals", 1);
  for (std::size_t i = 0; i < reals; ++i) scan.token("a real number");
  const std::size_t integers = scan.count("integers", 1);
  if (integers < 3) scan.refuse("a section of values has three integers or more: step, components, rows");
  scan.integer("a step in time");
  const std::int64_t width = scan.integer("the number of components");
  if (width != 1 && width != 3 && width != 9)
    scan.refuse(fmt::format("values of {} components; they have 1, 3 or 9", width));
  section.width = width;
  const std::size_t rows = scan.count("rows of values", section.width + 1);
  for (std::size_t i = 3; i < integers; ++i) scan.integer("an integer");
  section.rows.reserve(rows);
  section.values.reserve(rows * section.width);
  for (std::size_t i = 0; i < rows; ++i) {
    section.rows.add(scan.integer("the tag of a row of values"));
    for (std::size_t k = 0; k < section.width; ++k) section.values.push_back(scan.real("a value"));
  }
  section.rows.sort();
  const std::string end = "$End" + std::string(head.substr(1));
  if (scan.token(end) != end) scan.refuse("expected " + end + "; a row too many, or a count too small");
  return section;
}

void put(std::vector<MshValues>& sections, MshValues section) {
  const auto same = std::ranges::find(sections, section.name, &MshValues::name);
  if (same == sections.end())
    sections.push_back(std::move(section));
  else
    *same = std::move(section);
}

/// Returns one component of the rows given by `row_of`.
std::vector<double> component(const MshValues& section, std::span<const NodeId> row_of, std::size_t k) {
  std::vector<double> column;
  column.reserve(row_of.size());
  for (const NodeId row : row_of) column.push_back(section.values[row.value() * section.width + k]);
  return column;
}

std::string component_name(const MshValues& section, std::size_t k) {
  if (section.width == 1) return section.name;
  return section.width == 3 ? fmt::format("{}_{}", section.name, "xyz"[k])
                            : fmt::format("{}_{}", section.name, k + 1);
}

}  // namespace

MshSolution read_msh_values(TextScanner& scan) {
  MshSolution found;
  const std::string_view text = scan.text();
  for (std::size_t at = text.find('$'); at != std::string_view::npos; at = text.find('$', at + 1)) {
    for (const std::string_view head : {node_section, element_section, corner_section}) {
      if (!text.substr(at).starts_with(head) || !MshText::is_line(text, at, head.size())) continue;
      if (head == corner_section) {
        ++found.others;
        continue;
      }
      scan.go_to(at);
      scan.token("");
      put(head == node_section ? found.at_nodes : found.in_elements, read_section(scan, head));
      at = scan.place();
    }
  }
  return found;
}

CellValues msh_columns(const std::vector<MshValues>& sections, std::span<const std::int64_t> tags,
                       const char* of, std::vector<std::string>& losses) {
  CellValues result;
  std::vector<std::vector<double>> columns;
  for (const MshValues& section : sections) {
    std::vector<NodeId> row_of;
    row_of.reserve(tags.size());
    for (const std::int64_t tag : tags) row_of.push_back(section.rows.node_of(tag));
    const auto missing = std::ranges::count_if(row_of, [](NodeId row) { return !row.valid(); });
    if (missing > 0) {
      losses.push_back(fmt::format("'{}' has no values for {} of the {} {}, and is left out", section.name,
                                   missing, tags.size(), of));
      continue;
    }
    for (std::size_t k = 0; k < section.width; ++k) {
      std::vector<double> column = component(section, row_of, k);
      const bool is_plane = section.width == 3 && k == 2 &&
                            std::ranges::all_of(column, [](double value) { return value == 0; });
      if (is_plane) continue;
      result.names.push_back(component_name(section, k));
      columns.push_back(std::move(column));
    }
  }
  result.values.reserve(tags.size() * columns.size());
  for (std::size_t i = 0; i < tags.size(); ++i) {
    for (const std::vector<double>& column : columns) result.values.push_back(column[i]);
  }
  return result;
}

}  // namespace quadloop::io
