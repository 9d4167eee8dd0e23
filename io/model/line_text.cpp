#include "io/model/line_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "io/model/layers_text.hpp"
#include "io/text/text_scanner.hpp"

namespace quadloop::io {

namespace {

constexpr std::string_view line_head = "# inner line ";

/// A whole number from 1 to `most`, which must be all of the word.
std::optional<std::int32_t> counted_number(std::string_view word, std::int32_t most) {
  std::int32_t number = 0;
  const auto [stopped, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || stopped != word.data() + word.size() || number < 1 || number > most) return {};
  return number;
}

/// Takes the first line off the text, without blanks before it.
std::string_view first_line(std::string_view& text) {
  std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return line;
}

std::optional<std::array<NodeId, 2>> edge_of(std::string_view line, std::int32_t nodes_of_mesh) {
  if (!line.starts_with("# ")) return {};
  line.remove_prefix(2);
  const auto from = counted_number(next_word(line), nodes_of_mesh),
             to = counted_number(next_word(line), nodes_of_mesh);
  if (!from || !to || from == to) return {};
  return std::array{NodeId{*from - 1}, NodeId{*to - 1}};
}

}  // namespace

std::string line_comment(const std::string& name, std::int64_t edges) {
  return fmt::format("{}{} {}\n", line_head, name, edges);
}

std::vector<BoundaryEdges> lines_in_comments(std::string_view comments, std::int32_t nodes_of_mesh) {
  std::vector<BoundaryEdges> lines;
  while (!comments.empty()) {
    std::string_view head = first_line(comments);
    if (!head.starts_with(line_head)) continue;
    head.remove_prefix(line_head.size());
    BoundaryEdges line{std::string(next_word(head)), {}, {}};
    const auto count = counted_number(next_word(head), 3 * nodes_of_mesh);
    for (std::int32_t e = 0; count && e < *count; ++e) {
      const auto edge = edge_of(first_line(comments), nodes_of_mesh);
      if (!edge) break;
      line.edges.push_back(*edge);
    }
    if (count && std::ssize(line.edges) == *count) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace quadloop::io
