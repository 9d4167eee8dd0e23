#include "io/model/node_text.hpp"

#include <fmt/format.h>

#include "io/model/layers_text.hpp"
#include "mesher/base/trimmed.hpp"

namespace quadloop::io {

namespace {

constexpr std::string_view node_head = "# node ";

}  // namespace

std::string comment_of(const NamedNode& node) {
  return fmt::format("{}{} {}\n", node_head, node.node.value() + 1, node.name);
}

std::vector<NamedNode> nodes_in_comments(std::string_view comments, std::int32_t nodes_of_mesh) {
  std::vector<NamedNode> nodes;
  while (!comments.empty()) {
    std::string_view line = first_line(comments);
    if (!line.starts_with(node_head)) continue;
    line.remove_prefix(node_head.size());
    const auto number = counted_number(next_word(line), nodes_of_mesh);
    const std::string_view name = trimmed(line);
    if (number && !name.empty()) nodes.push_back({std::string(name), GlobalNodeId{*number - 1}});
  }
  return nodes;
}

}  // namespace quadloop::io
