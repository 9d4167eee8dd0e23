#include "io/model/line_text.hpp"

#include <fmt/format.h>

#include <optional>

#include "io/model/layers_text.hpp"
#include "io/text/text_scanner.hpp"

namespace quadloop::io {

namespace {

constexpr std::string_view line_head = "# inner line ";

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
