#include "io/parts/part_index.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "io/model/line_text.hpp"
#include "io/model/pair_text.hpp"
#include "io/model/strip_text.hpp"
#include "io/text/text_scanner.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/partition/mesh_part.hpp"

namespace quadloop::io {

namespace {

std::int64_t read_count(TextScanner& scan, const char* of) {
  const std::int64_t count = scan.integer(of);
  if (count < 0 || count > std::numeric_limits<std::int32_t>::max())
    scan.refuse(fmt::format("{} {} of the whole mesh; one rank joins at most {}", count, of,
                            std::numeric_limits<std::int32_t>::max()));
  return count;
}

void read_boundary(TextScanner& scan, PartIndex& index) {
  index.edges.push_back(read_count(scan, "edges"));
  BoundaryEdges boundary;
  const std::int64_t layers = read_count(scan, "layers");
  boundary.layers = {static_cast<std::int32_t>(layers), scan.real("the thickness of layers")};
  const std::string word(scan.token("a boundary condition"));
  const auto condition = BoundaryCondition::named(word);
  if (!condition) scan.refuse(fmt::format("'{}' is no boundary condition", word));
  boundary.condition = *condition;
  boundary.name = scan.rest_of_line();
  if (boundary.name.empty()) scan.refuse("a boundary has no name");
  index.boundaries.push_back(std::move(boundary));
}

/// Reads strips, inner lines and pairs. Invalid strips in comments are named in a warning.
void read_comments(const TextScanner& scan, PartIndex& index) {
  for (const BoundaryEdges& line :
       lines_in_comments(scan.passed_over(), static_cast<std::int32_t>(index.nodes))) {
    PartIndex::Line& of_whole =
        index.lines.emplace_back(line.name, std::vector<std::array<std::int64_t, 2>>{});
    for (const auto& [from, to] : line.edges) of_whole.edges.push_back({from.value(), to.value()});
  }
  StripsInText found = strips_in_comments(scan.passed_over(), static_cast<std::int32_t>(index.nodes));
  index.strips = std::move(found.strips);
  index.pairs = pairs_in_comments(scan.passed_over());
  for (const std::string& name : found.damaged)
    index.warnings.push_back(
        fmt::format("{}: the comment '# strip {}' does not list the nodes of a strip; its cells are treated "
                    "as ordinary cells",
                    scan.path(), name));
}

}  // namespace

bool is_part_index(const std::string& path) { return suffix_of(path) == part_index_suffix; }

std::string part_path(const std::string& prefix, std::int32_t part, const std::string& suffix) {
  return prefix + "." + part_name(part) + "." + suffix;
}

void write_part_index(OutputSet& outputs, const PartIndex& index, const std::string& path) {
  std::string text =
      fmt::format("#Number of parts\n{}\n#Number of formats\n{}\n", index.parts, index.formats.size());
  for (const std::string& format : index.formats) text += format + "\n";
  text += fmt::format(
      "#Number of grid points, triangular elements, quadrilateral elements of the whole mesh\n{} {} {}\n",
      index.nodes, index.triangles, index.quads);
  text += fmt::format("#Number of blocks; their names\n{}\n", index.blocks.size());
  for (const std::string& block : index.blocks) text += block + "\n";
  text += fmt::format("#Number of boundaries; edges, layers, thickness, condition, name of each\n{}\n",
                      index.boundaries.size());
  for (std::size_t b = 0; b < index.boundaries.size(); ++b) {
    const BoundaryEdges& boundary = index.boundaries[b];
    text += fmt::format("{} {} {} {} {}\n", index.edges[b], boundary.layers.count, boundary.layers.thickness,
                        boundary.condition.word(), boundary.name);
  }
  for (const PartIndex::Line& line : index.lines) {
    text += line_comment(line.name, std::ssize(line.edges));
    for (const auto& [from, to] : line.edges) text += fmt::format("# {} {}\n", from + 1, to + 1);
  }
  for (const StripLayers& strip : index.strips) text += comments_of(strip);
  for (const PeriodicPair& pair : index.pairs) text += comment_of(pair);
  OutputFile file(outputs.stage(path));
  file.write(text);
  file.close();
}

PartIndex read_part_index(const std::string& path) {
  TextScanner scan(path);
  PartIndex index;
  index.parts = static_cast<std::int32_t>(read_count(scan, "parts"));
  if (index.parts < 1) scan.refuse("a set has at least one part");
  const std::size_t formats = scan.count("formats", 1);
  for (std::size_t i = 0; i < formats; ++i) index.formats.emplace_back(scan.token("a format"));
  index.nodes = read_count(scan, "grid points");
  index.triangles = read_count(scan, "triangular elements");
  index.quads = read_count(scan, "quadrilateral elements");
  const std::size_t blocks = scan.count("blocks", 1);
  for (std::size_t i = 0; i < blocks; ++i) {
    std::string name(scan.token("a block's name"));
    if (const std::string_view more = scan.rest_of_line(); !more.empty()) name.append(" ").append(more);
    index.blocks.push_back(std::move(name));
  }
  if (blocks == 0) scan.refuse("a mesh has at least one block");
  const std::size_t boundaries = scan.count("boundaries", 1);
  for (std::size_t i = 0; i < boundaries; ++i) read_boundary(scan, index);
  scan.forget_comments();
  if (!scan.at_end()) {
    scan.token("");
    scan.refuse("text after the end");
  }
  read_comments(scan, index);
  return index;
}

}  // namespace quadloop::io
