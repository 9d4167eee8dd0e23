#include "io/parts/part_links.hpp"

#include <fmt/format.h>

#include "io/text/text_output.hpp"
#include "io/text/text_scanner.hpp"

namespace quadloop::io {

namespace {

class LinksWriter {
 public:
  LinksWriter(OutputSet& outputs, const std::string& path) : file_{outputs, path} {}

  void write(const MeshPart& part, std::int32_t parts) {
    file_.write(fmt::format("#Part, of so many\n{} {}\n", part.number + 1, parts));
    file_.write(fmt::format(
        "#Number of grid points; of each the number in the whole mesh and the part that owns it\n{}\n",
        part.nodes.size()));
    file_.write_rows(std::ssize(part.nodes), 2, [&](TextRows& text, std::size_t i) {
      text.put(part.nodes[i] + 1, ' ');
      text.put(part.owners[i] + 1, '\n');
    });
    numbers("Number of triangular elements; of each the number in the whole mesh", part.triangles);
    numbers("Number of quadrilateral elements; of each the number in the whole mesh", part.quads);
    file_.write(fmt::format("#Number of boundaries of the whole mesh\n{}\n", part.edges.size()));
    for (std::size_t b = 0; b < part.edges.size(); ++b)
      numbers(
          fmt::format("Number of edges of boundary {} ({}); of each the number among all of that boundary's",
                      b + 1, part.mesh.boundaries[b].name),
          part.edges[b]);
    file_.write(fmt::format("#Number of neighbours\n{}\n", part.neighbours.size()));
    for (const MeshPart::Neighbour& neighbour : part.neighbours) {
      file_.write(
          fmt::format("#Neighbour, number of nodes shared with it; the nodes, as numbered here\n{} {}\n",
                      neighbour.part + 1, neighbour.nodes.size()));
      file_.write_rows(std::ssize(neighbour.nodes), 1, [&](TextRows& text, std::size_t i) {
        text.put(neighbour.nodes[i].value() + 1, '\n');
      });
    }
    file_.close();
  }

 private:
  void numbers(const std::string& comment, const std::vector<std::int64_t>& rows) {
    file_.write(fmt::format("#{}\n{}\n", comment, rows.size()));
    file_.write_rows(std::ssize(rows), 1,
                     [&](TextRows& text, std::size_t i) { text.put(rows[i] + 1, '\n'); });
  }

  TextOutput file_;
};

/// Numbers in the file are from 1; those of the whole mesh are checked where they are used.
class LinksReader {
 public:
  explicit LinksReader(const std::string& path) : scan_{path} {}

  MeshPart read(std::int32_t number, std::int32_t parts) {
    part_.number = number;
    if (scan_.integer("the part") != number + 1 || scan_.integer("the number of parts") != parts)
      scan_.refuse(fmt::format("this is not part {} of {}", number + 1, parts));
    const std::size_t nodes = scan_.count("grid points", 2);
    for (std::size_t i = 0; i < nodes; ++i) {
      part_.nodes.push_back(scan_.integer("a node's number in the whole mesh") - 1);
      part_.owners.push_back(up_to(parts, "the part that owns a node"));
    }
    read_numbers("triangular elements", part_.triangles);
    read_numbers("quadrilateral elements", part_.quads);
    part_.edges.resize(scan_.count("boundaries", 1));
    for (auto& edges : part_.edges) read_numbers("boundary edges", edges);
    const std::size_t neighbours = scan_.count("neighbours", 2);
    for (std::size_t i = 0; i < neighbours; ++i) read_neighbour(parts);
    if (!scan_.at_end()) {
      scan_.token("");
      scan_.refuse("text after the end");
    }
    return std::move(part_);
  }

 private:
  void read_numbers(const std::string& of, std::vector<std::int64_t>& numbers) {
    numbers.resize(scan_.count(of, 1));
    for (std::int64_t& number : numbers) number = scan_.integer("a number in the whole mesh") - 1;
  }

  void read_neighbour(std::int32_t parts) {
    MeshPart::Neighbour neighbour{up_to(parts, "a neighbour"), {}};
    const std::size_t nodes = scan_.count("shared nodes", 1);
    for (std::size_t i = 0; i < nodes; ++i)
      neighbour.nodes.emplace_back(up_to(std::ssize(part_.nodes), "a shared node"));
    part_.neighbours.push_back(std::move(neighbour));
  }

  /// Reads a number from 1 to `last`; returns it from 0.
  std::int32_t up_to(std::int64_t last, const char* what) {
    const std::int64_t number = scan_.integer(what);
    if (number < 1 || number > last)
      scan_.refuse(fmt::format("{} is {}, not one of 1 to {}", what, number, last));
    return static_cast<std::int32_t>(number - 1);
  }

  TextScanner scan_;
  MeshPart part_;
};

}  // namespace

void write_part_links(OutputSet& outputs, const MeshPart& part, std::int32_t parts, const std::string& path) {
  LinksWriter(outputs, path).write(part, parts);
}

MeshPart read_part_links(const std::string& path, std::int32_t part, std::int32_t parts) {
  return LinksReader(path).read(part, parts);
}

}  // namespace quadloop::io
