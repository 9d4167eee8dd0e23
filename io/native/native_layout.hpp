#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/reading/value_pipe.hpp"
#include "io/text/name_index.hpp"
#include "io/text/range_tokens.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// The numbers of a native text file, apart from counts.
enum class NativeArray : std::uint8_t { points, triangles, quads, edges, constants, values, cell_values };
inline constexpr std::size_t native_arrays = 7;

/// Rows of an array that follow each other in the file.
struct NativeSection {
  NativeArray array = NativeArray::points;
  std::int64_t first_token = 0, rows = 0, width = 0;
  std::int64_t item = 0;  ///< the number of the block, from 0, or of the boundary as in the file, from 1

  std::int64_t end_token() const { return first_token + rows * width; }
};

/// Where the rows of a native text file are, with all that is not in rows.
struct NativeLayout {
  struct Boundary {
    std::string name;
    WallLayers layers;
  };

  std::vector<NativeSection> sections;  ///< in their order in the file
  std::int64_t nodes = 0, blocks = 0;
  std::vector<std::string> block_names;
  std::vector<Boundary> boundaries;  ///< of distinct names
  /// For each boundary in the file, in its order, its name and its entry of `boundaries`.
  std::vector<std::string> names_in_file;
  std::vector<std::int32_t> boundary_entries;
  std::string comments;  ///< after the boundaries: strips, pairs, inner lines, named nodes
  std::optional<std::int64_t> constants;
  std::optional<std::vector<std::string>> variables, cell_variables;

  /// Returns the number of rows of an array.
  std::int64_t rows_of(NativeArray array) const;
};

template <class Pipe>
void pass_fields(Pipe& pipe, NativeLayout::Boundary& boundary) {
  pass(pipe, boundary.name, boundary.layers);
}

template <class Pipe>
void pass_fields(Pipe& pipe, NativeLayout& layout) {
  pass(pipe, layout.sections, layout.nodes, layout.blocks, layout.block_names, layout.boundaries,
       layout.names_in_file, layout.boundary_entries, layout.comments, layout.constants, layout.variables,
       layout.cell_variables);
}

/// An error in the file, and its place.
struct TextFault {
  std::int64_t place = 0, line = 0;
  std::string message;
};

/// Finds the layout of a native text file from its counts and comments. The ranks continue one after another:
/// each reads those on its lines, and passes over the rows. So the object is handed on.
class NativeLayoutReader {
 public:
  /// Continues on this rank, the last one or not, of `ranks`. Returns an error, after which other ranks do
  /// nothing. Throws InputError if the file cannot be read.
  std::optional<TextFault> read(RangeTokens& tokens, int ranks, bool is_last);

  /// No rank continues.
  void stop() { step_ = Step::done; }
  const NativeLayout& layout() const { return layout_; }

  template <class Pipe>
  friend void pass_fields(Pipe& pipe, NativeLayoutReader& reader) {
    pass(pipe, reader.layout_, reader.step_, reader.wanted_, reader.text_, reader.boundaries_,
         reader.variables_, reader.place_, reader.line_);
  }

 private:
  /// What comes next: a count, or a look at what is before the next token.
  enum class Step : std::uint8_t {
    points,
    blocks,
    triangles,
    quads,
    boundaries,
    edges,
    after_mesh,
    constants,
    after_constants,
    variables,
    variable_names,
    after_values,
    cell_variables,
    cell_variable_names,
    end,
    done
  };

  void take_step();
  void read_points();
  void read_blocks();
  void read_triangles();
  void read_quads();
  void read_boundaries();
  void read_edges();
  void look_after_mesh();
  void look_for(Step next);
  void read_constants();
  void read_variables(const std::string& of, Step next);
  void read_values(NativeArray array);
  void require_end();
  std::vector<std::string> names_in(std::string_view comment);
  std::int64_t count(const std::string& of, std::int64_t width);
  void add_section(NativeArray array, std::int64_t rows, std::int64_t width, std::int64_t item = 0);
  std::string_view comment_with(std::string_view text) const;
  [[noreturn]] void refuse(const std::string& message);
  [[noreturn]] void refuse_end(const std::string& expected);
  [[noreturn]] void refuse_missing_rows();

  NativeLayout layout_;
  Step step_ = Step::points;
  std::int64_t wanted_ = 0;            ///< the next token to look at
  std::string text_;                   ///< what lower ranks have passed over before it
  std::int64_t boundaries_ = 0;        ///< their number in the file
  std::int64_t variables_ = 0;         ///< their number, before their names
  std::int64_t place_ = 0, line_ = 0;  ///< of the last count; line 0: not known
  // of this rank:
  NameIndex names_;  ///< of boundaries
  RangeTokens* tokens_ = nullptr;
  int ranks_ = 1;
  std::string passed_;  ///< what is before the token
  bool at_end_ = false;
};

/// Returns what a row's number is called in messages, "a node of the triangular elements".
std::string expected_in(const NativeLayout& layout, const NativeSection& section, std::int64_t number);
/// Returns what a message adds for a value of the solution, "; it is pressure at node 3"; otherwise empty.
std::string place_of_value(const NativeLayout& layout, const NativeSection& section, std::int64_t number);

}  // namespace quadloop::io
