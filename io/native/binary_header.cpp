#include "io/native/binary_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "io/model/layers_text.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/boundary_conditions.hpp"

namespace quadloop::io {

namespace {

constexpr std::size_t alignment = 8;  // of the numbers, for programs that memory-map the file

std::string one_line(std::string name) {
  std::ranges::replace_if(
      name, [](unsigned char c) { return c < ' ' || c == 0x7f; }, '_');
  return name;
}

class HeaderParser {
 public:
  HeaderParser(std::string_view text, std::int64_t size, const std::string& path)
      : text_{text}, size_{size}, path_{path} {}

  BinaryHeader parse() {
    next();  // the first two, already checked
    next();
    next();
    if (take("nodes "))
      header_.nodes = count("nodes");
    else
      refuse("should say 'nodes N'");
    next();
    if (!take("node_bytes ")) refuse("should say 'node_bytes 4' or 'node_bytes 8'");
    header_.node_bytes = count("bytes");
    if (header_.node_bytes != 4 && header_.node_bytes != 8) refuse("a node's number has 4 or 8 bytes");
    while (next(), !take("end")) line();
    if (line_.find_first_not_of(' ') != std::string_view::npos) refuse("something follows 'end'");
    if (header_.blocks.empty()) refuse("a mesh has at least one block");
    return std::move(header_);
  }

 private:
  void next() {
    if (text_.empty()) refuse("the head ends before its line 'end'");
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    line_ = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++number_;
  }

  bool take(std::string_view word) {
    if (!line_.starts_with(word)) return false;
    line_.remove_prefix(word.size());
    return true;
  }

  void line() {
    if (take("block ")) {
      const std::int64_t triangles = count("triangles"), quads = count("quads");
      header_.blocks.push_back({std::string(line_), triangles, quads});
    } else if (take("boundary ")) {
      const std::int64_t edges = count("edges");
      header_.boundaries.push_back({"", condition(), edges});
      if (line_.empty()) refuse("a boundary has a name");
      header_.boundaries.back().name = line_;
    } else if (take("line ")) {
      const std::int64_t edges = count("edges");
      if (line_.empty()) refuse("an inner line has a name");
      header_.boundaries.push_back({std::string(line_), {}, edges, {}, true});
    } else if (take("layers ")) {
      if (header_.boundaries.empty()) refuse("layers stand behind their boundary");
      header_.boundaries.back().layers = layers_of_text(line_);
      if (header_.boundaries.back().layers.count == 0)
        refuse("layers are a count above 0, and a thickness where it is known");
    } else if (take("constants ")) {
      header_.constants = count("constants");
    } else if (take("variable ")) {
      header_.variables.emplace_back(line_);
    } else if (take("cell_variable ")) {
      header_.cell_variables.emplace_back(line_);
    } else if (line_.starts_with('#')) {
      header_.comments.append(line_).append("\n");
    } else {
      refuse(fmt::format("'{}' is not a line of a head", line_.substr(0, longest_quote)));
    }
  }

  std::string_view word() {
    const std::string_view word = line_.substr(0, line_.find(' '));
    line_.remove_prefix(std::min(word.size() + 1, line_.size()));
    return word;
  }

  /// Reads a number of items that take at least one byte each, so that sums of their sizes cannot overflow.
  std::int64_t count(const char* of) {
    const std::string_view text = word();
    std::int64_t value = -1;
    const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || stopped != text.data() + text.size() || value < 0)
      refuse(fmt::format("'{}' is not a number of {}", text.substr(0, longest_quote), of));
    if (value > size_)
      refuse(fmt::format("{} {} cannot be in a file of {} bytes; it is cut short, or damaged", value, of,
                         size_));
    return value;
  }

  BoundaryCondition condition() {
    const std::string_view text = word();
    const auto known = BoundaryCondition::named(text);
    if (!known) refuse(fmt::format("'{}' is no boundary condition", text.substr(0, longest_quote)));
    return *known;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", path_, number_, what));
  }

  static constexpr std::size_t longest_quote = 40;
  std::string_view text_, line_;
  std::int64_t size_;
  const std::string& path_;
  int number_ = 0;
  BinaryHeader header_;
};

}  // namespace

std::int64_t BinaryHeader::triangles() const {
  std::int64_t sum = 0;
  for (const Block& block : blocks) sum += block.triangles;
  return sum;
}

std::int64_t BinaryHeader::quads() const {
  std::int64_t sum = 0;
  for (const Block& block : blocks) sum += block.quads;
  return sum;
}

std::int64_t BinaryHeader::edges() const {
  std::int64_t sum = 0;
  for (const BoundaryHead& boundary : boundaries) sum += boundary.edges;
  return sum;
}

std::int64_t BinaryHeader::bytes_of_numbers() const {
  constexpr std::int64_t real = sizeof(double);
  const std::int64_t cells = triangles() + quads();
  return real * (2 * nodes + constants + nodes * std::ssize(variables) + cells * std::ssize(cell_variables)) +
         node_bytes * (3 * triangles() + 4 * quads() + 2 * edges());
}

std::int64_t node_bytes_for(std::int64_t nodes) {
  return nodes <= std::numeric_limits<std::int32_t>::max() ? 4 : 8;
}

std::string text_of(const BinaryHeader& header) {
  std::string lines = fmt::format("nodes {}\nnode_bytes {}\n", header.nodes, header.node_bytes);
  for (const auto& [name, triangles, quads] : header.blocks)
    lines += fmt::format("block {} {} {}\n", triangles, quads, one_line(name));
  for (const auto& [name, condition, edges, layers, inner_line] : header.boundaries) {
    lines += inner_line ? fmt::format("line {} {}\n", edges, one_line(name))
                        : fmt::format("boundary {} {} {}\n", edges, condition.word(), one_line(name));
    if (layers.count > 0) lines += "layers " + text_of_layers(layers) + "\n";
  }
  if (header.constants > 0) lines += fmt::format("constants {}\n", header.constants);
  for (const std::string& name : header.variables) lines += "variable " + one_line(name) + "\n";
  for (const std::string& name : header.cell_variables) lines += "cell_variable " + one_line(name) + "\n";
  lines += header.comments + "end";
  constexpr std::size_t digits = 12;
  const std::size_t before = binary_first_line.size() + std::string_view("header \n").size() + digits;
  // including a line end
  const std::size_t size = (before + lines.size() + alignment) / alignment * alignment;
  lines.append(size - before - lines.size() - 1, ' ');
  return fmt::format("{}header {:{}}\n{}\n", binary_first_line, size, digits, lines);
}

BinaryHeader header_of_text(const std::string& text, std::int64_t size, const std::string& path) {
  BinaryHeader header = HeaderParser(text, size, path).parse();
  const std::int64_t has = size - std::ssize(text);
  if (header.bytes_of_numbers() != has)
    throw InputError(
        fmt::format("{}: {} bytes follow its head, which tells of {}; it is cut short, or damaged", path, has,
                    header.bytes_of_numbers()));
  return header;
}

}  // namespace quadloop::io
