#include <algorithm>
#include <charconv>
#include <memory>
#include <span>

#include "io/native_file.hpp"
#include "io/row_stream.hpp"

namespace quadloop {

namespace {

constexpr std::int64_t rows_per_piece = std::int64_t{1} << 16;
constexpr std::size_t longest_number = 25;  // with the blank or line end after it: -1.7976931348623157e+308

/// Grows a text number by number into room that was made once.
class TextRows {
 public:
  TextRows(std::int64_t rows, std::size_t width) : text_(static_cast<std::size_t>(rows) * width * longest_number) {}

  template <class Number>
  void put(Number value, char after) {
    char* const begin = text_.data() + used_;
    char* const end = std::to_chars(begin, begin + longest_number, value).ptr;
    *end = after;
    used_ += static_cast<std::size_t>(end - begin) + 1;
  }
  std::vector<char> take() {
    text_.resize(used_);
    return std::move(text_);
  }

 private:
  std::vector<char> text_;
  std::size_t used_ = 0;
};

/// The file under way: `file` exists on rank 0 alone.
class NativeWriter {
 public:
  NativeWriter(OutputSet& outputs, const Mesh& mesh, const std::string& path) : comm_{outputs.communicator()}, mesh_{mesh} {
    const StagedFile staged = outputs.stage(path);
    comm_.together([&] {
      if (comm_.is_root()) file_ = std::make_unique<OutputFile>(staged);
    });
  }

  void write_mesh() {
    write_nodes();
    write_text("#Number of blocks\n1\n");
    write_connectivity("#Number of triangular elements\n", std::span(mesh_.triangles));
    write_connectivity("#Number of quadrilateral elements\n", std::span(mesh_.quads));
    write_boundaries();
  }

  void write_solution(const Solution& solution) {
    std::string head = "#Number of constants\n" + std::to_string(solution.constants.size()) + "\n";
    TextRows constants(static_cast<std::int64_t>(solution.constants.size()), 1);
    for (const double value : solution.constants) constants.put(value, '\n');
    const std::vector<char> text = constants.take();
    head.append(text.begin(), text.end());
    head += "#Number of variables\n" + std::to_string(solution.names.size()) + "\n#names:";
    for (const std::string& name : solution.names) head += " " + name;
    write_text(head + "\n");
    write_real_rows(solution.values.data(), solution.names.size());
  }

  void close() {
    comm_.together([&] {
      if (file_) file_->close();
    });
  }

 private:
  void write_text(const std::string& text) {
    comm_.together([&] {
      if (file_) file_->write(text);
    });
  }

  template <class Make>
  void write_rows(std::size_t rows, const Make& make) {
    const RowStream stream{comm_, static_cast<std::int64_t>(rows), rows_per_piece};
    stream.run<char>(make, [&](std::span<const char> text) { file_->write({text.data(), text.size()}); });
  }

  void write_nodes() {
    write_text("#Number of grid points\n" + std::to_string(comm_.sum(mesh_.owned_nodes)) + "\n");
    write_rows(static_cast<std::size_t>(mesh_.owned_nodes), [&](std::int64_t begin, std::int64_t end) {
      TextRows text(end - begin, 2);
      for (std::int64_t i = begin; i < end; ++i) {
        const Point p = mesh_.points[static_cast<std::size_t>(i)];
        text.put(p.x, ' ');
        text.put(p.y, '\n');
      }
      return text.take();
    });
  }

  /// One row of `width` numbers for each owned node.
  void write_real_rows(const double* values, std::size_t width) {
    if (width == 0) return;
    write_rows(static_cast<std::size_t>(mesh_.owned_nodes), [&](std::int64_t begin, std::int64_t end) {
      TextRows text(end - begin, width);
      const double* value = values + static_cast<std::size_t>(begin) * width;
      for (std::int64_t i = begin; i < end; ++i) {
        for (std::size_t k = 0; k < width; ++k) text.put(*value++, k + 1 < width ? ' ' : '\n');
      }
      return text.take();
    });
  }

  template <std::size_t width>
  void write_connectivity(const std::string& comment, std::span<const std::array<NodeId, width>> rows) {
    write_text(comment + std::to_string(comm_.sum(static_cast<std::int64_t>(rows.size()))) + "\n");
    write_rows(rows.size(), [&](std::int64_t begin, std::int64_t end) {
      TextRows text(end - begin, width);
      for (std::int64_t i = begin; i < end; ++i) {
        const auto& row = rows[static_cast<std::size_t>(i)];
        for (std::size_t k = 0; k < width; ++k) text.put(mesh_.global(row[k]).value() + 1, k + 1 < width ? ' ' : '\n');
      }
      return text.take();
    });
  }

  void write_boundaries() {
    std::vector<const BoundaryEdges*> present;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      if (comm_.any(!boundary.edges.empty())) present.push_back(&boundary);
    }
    write_text("#Number of boundaries\n" + std::to_string(present.size()) + "\n");
    int number = 0;
    for (const BoundaryEdges* boundary : present) {
      const std::string comment = "#Number of edges for boundary " + std::to_string(++number) + " (" + boundary->name + ")\n";
      write_connectivity(comment, std::span(boundary->edges));
    }
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  std::unique_ptr<OutputFile> file_;
};

}  // namespace

void write_native(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Solution* solution) {
  NativeWriter writer(outputs, mesh, path);
  writer.write_mesh();
  if (solution != nullptr) writer.write_solution(*solution);
  writer.close();
}

void write_native(const Communicator& comm, const Mesh& mesh, const std::string& path, const Solution* solution) {
  OutputSet outputs(comm);
  write_native(outputs, mesh, path, solution);
  outputs.commit();
}

}  // namespace quadloop
