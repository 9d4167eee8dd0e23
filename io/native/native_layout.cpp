#include "io/native/native_layout.hpp"

#include <algorithm>
#include <utility>

#include "io/model/layers_text.hpp"
#include "io/model/loaded_mesh.hpp"
#include "io/text/tokens.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr std::string_view block_head = "# block ";
constexpr std::size_t longest_quote = 40;

/// Returns the name in the brackets of "#Number of edges for boundary 1 (name)".
std::string name_in(std::string_view comment) {
  const std::size_t open = comment.find('('), close = comment.rfind(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return {};
  std::string_view name = comment.substr(open + 1, close - open - 1);
  while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
  while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
  return std::string(name);
}

std::string edges_of(const NativeLayout& layout, std::int64_t number) {
  return "edges of boundary " + std::to_string(number) + " (" + layout.names_in_file[number - 1] + ")";
}

const std::vector<std::string>& names_of(const NativeLayout& layout, NativeArray array) {
  return array == NativeArray::values ? *layout.variables : *layout.cell_variables;
}

}  // namespace

std::int64_t NativeLayout::rows_of(NativeArray array) const {
  std::int64_t rows = 0;
  for (const NativeSection& section : sections) rows += section.array == array ? section.rows : 0;
  return rows;
}

std::string expected_in(const NativeLayout& layout, const NativeSection& section, std::int64_t number) {
  switch (section.array) {
    case NativeArray::points: return number % 2 == 0 ? "an x coordinate" : "a y coordinate";
    case NativeArray::triangles: return "a node of the triangular elements";
    case NativeArray::quads: return "a node of the quadrilateral elements";
    case NativeArray::edges: return "a node of the " + edges_of(layout, section.item);
    case NativeArray::constants: return "a constant";
    default: return "a value of the solution";
  }
}

std::string place_of_value(const NativeLayout& layout, const NativeSection& section, std::int64_t number) {
  if (section.array != NativeArray::values && section.array != NativeArray::cell_values) return {};
  return "; it is " + names_of(layout, section.array)[number % section.width] +
         (section.array == NativeArray::values ? " at node " : " at cell ") +
         std::to_string(number / section.width + 1);
}

std::optional<TextFault> NativeLayoutReader::read(RangeTokens& tokens, int ranks, bool is_last) {
  tokens_ = &tokens;
  ranks_ = ranks;
  for (const NativeLayout::Boundary& boundary : layout_.boundaries) names_.entry_of(boundary.name);
  try {
    while (step_ != Step::done) {
      const bool at_end = wanted_ >= tokens.end(), beyond = wanted_ > tokens.end();
      if (beyond && is_last) refuse_missing_rows();
      // What lower ranks have passed over is before this token only if it is the first one here.
      passed_ = wanted_ > tokens.begin() ? std::string() : text_;
      if (!beyond) passed_ += tokens.text_before(wanted_);
      if (at_end && !is_last) {
        text_ = std::exchange(passed_, {});
        return {};
      }
      at_end_ = at_end;
      take_step();
    }
  } catch (const TextFault& fault) {
    step_ = Step::done;
    return fault;
  }
  return {};
}

void NativeLayoutReader::take_step() {
  switch (step_) {
    case Step::points: return read_points();
    case Step::blocks: return read_blocks();
    case Step::triangles: return read_triangles();
    case Step::quads: return read_quads();
    case Step::boundaries: return read_boundaries();
    case Step::edges: return read_edges();
    case Step::after_mesh: return look_after_mesh();
    case Step::constants: return read_constants();
    case Step::after_constants: return look_for(Step::variables);
    case Step::variables: return read_variables("variables", Step::variable_names);
    case Step::variable_names: return read_values(NativeArray::values);
    case Step::after_values: return look_for(Step::end);
    case Step::cell_variables: return read_variables("cell variables", Step::cell_variable_names);
    case Step::cell_variable_names: return read_values(NativeArray::cell_values);
    default: return require_end();
  }
}

std::int64_t NativeLayoutReader::count(const std::string& of, std::int64_t width) {
  const std::string expected = "the number of " + of;
  if (at_end_) refuse_end(expected);
  const std::string_view token = tokens_->next();
  place_ = tokens_->place();
  line_ = 0;
  ++wanted_;
  std::int64_t value = 0;
  if (!parse_integer(token, value)) refuse(why_no_integer(token, expected));
  const std::size_t bytes_left = tokens_->file_size() - tokens_->place_after();
  if (const std::string fault = why_no_count(value, of, width, bytes_left, ranks_); !fault.empty())
    refuse(fault);
  return value;
}

void NativeLayoutReader::add_section(NativeArray array, std::int64_t rows, std::int64_t width,
                                     std::int64_t item) {
  layout_.sections.push_back({array, wanted_, rows, width, item});
  wanted_ += rows * width;
}

void NativeLayoutReader::read_points() {
  layout_.nodes = count("grid points", 2);
  add_section(NativeArray::points, layout_.nodes, 2);
  step_ = Step::blocks;
}

void NativeLayoutReader::read_blocks() {
  layout_.blocks = count("blocks", 1);
  if (layout_.blocks == 0) refuse("a mesh has at least one block");
  step_ = Step::triangles;
}

/// A block may have its name in the comment "# block NAME" before its triangles.
void NativeLayoutReader::read_triangles() {
  const std::string_view comment = comment_with(block_head);
  const auto block = static_cast<std::int32_t>(layout_.block_names.size());
  layout_.block_names.push_back(comment.starts_with(block_head)
                                    ? std::string(comment.substr(block_head.size()))
                                    : usual_block_name(static_cast<std::int32_t>(layout_.blocks), block));
  add_section(NativeArray::triangles, count("triangular elements", 3), 3, block);
  step_ = Step::quads;
}

void NativeLayoutReader::read_quads() {
  const std::int64_t quads = count("quadrilateral elements", 4);
  add_section(NativeArray::quads, quads, 4, std::ssize(layout_.block_names) - 1);
  step_ = std::ssize(layout_.block_names) < layout_.blocks ? Step::triangles : Step::boundaries;
}

void NativeLayoutReader::read_boundaries() {
  boundaries_ = count("boundaries", 1);
  step_ = boundaries_ > 0 ? Step::edges : Step::after_mesh;
}

void NativeLayoutReader::read_edges() {
  const std::int64_t number = std::ssize(layout_.names_in_file) + 1;
  std::string name = at_end_ ? std::string() : name_in(comment_with("("));
  if (name.empty()) name = std::string("boundary_").append(std::to_string(number));
  layout_.names_in_file.push_back(name);
  const std::string head = "# layers " + name + " ";
  const std::string_view comment = comment_with(head);
  const WallLayers layers =
      comment.starts_with(head) && !at_end_ ? layers_of_text(comment.substr(head.size())) : WallLayers{};
  add_section(NativeArray::edges, count(edges_of(layout_, number), 2), 2, number);
  const auto [entry, is_new] = names_.entry_of(name);
  if (is_new) layout_.boundaries.push_back({name, layers});
  if (layout_.boundaries[entry].layers.count == 0) layout_.boundaries[entry].layers = layers;
  layout_.boundary_entries.push_back(entry);
  if (number == boundaries_) step_ = Step::after_mesh;
}

/// Comments after the boundaries are part of the mesh. Another comment distinguishes cell values from other
/// sections and from extra rows.
void NativeLayoutReader::look_after_mesh() {
  layout_.comments = passed_;
  look_for(Step::constants);
}

/// Takes the next step if a token follows, or that of cell values if a comment announces those.
void NativeLayoutReader::look_for(Step next) {
  step_ = at_end_ ? Step::done : comment_with("cell variables").empty() ? next : Step::cell_variables;
}

void NativeLayoutReader::read_constants() {
  layout_.constants = count("constants", 1);
  add_section(NativeArray::constants, *layout_.constants, 1);
  step_ = Step::after_constants;
}

void NativeLayoutReader::read_variables(const std::string& of, Step next) {
  variables_ = count(of, 1);
  line_ = tokens_->line_of(place_);
  step_ = next;
}

/// Their names are in a comment behind their number.
void NativeLayoutReader::read_values(NativeArray array) {
  const bool of_nodes = array == NativeArray::values;
  const std::int64_t rows = of_nodes ? layout_.nodes
                                     : layout_.rows_of(NativeArray::triangles) +
                                           layout_.rows_of(NativeArray::quads),
                     bytes_left = at_end_ ? 0 : tokens_->file_size() - tokens_->next_place();
  (of_nodes ? layout_.variables : layout_.cell_variables) =
      names_in(at_end_ ? std::string_view() : comment_with("names:"));
  if (variables_ > 0 && 2 * rows > (bytes_left + 1) / variables_)
    refuse("the file ends before the " + std::to_string(rows) + " rows of " + std::to_string(variables_) +
           " variables");
  if (variables_ > 0) add_section(array, rows, variables_);
  step_ = of_nodes ? Step::after_values : Step::end;
}

std::vector<std::string> NativeLayoutReader::names_in(std::string_view comment) {
  std::vector<std::string> names;
  const std::size_t colon = comment.find("names:");
  std::string_view rest = colon == std::string_view::npos ? "" : comment.substr(colon + 6);
  while (true) {
    const std::size_t begin = rest.find_first_not_of(" \t");
    if (begin == std::string_view::npos) break;
    const std::size_t end = std::min(rest.find_first_of(" \t", begin), rest.size());
    names.emplace_back(rest.substr(begin, end - begin));
    rest.remove_prefix(end);
  }
  if (!names.empty() && std::ssize(names) != variables_)
    refuse(std::to_string(names.size()) + " names stand over " + std::to_string(variables_) + " variables");
  for (std::int64_t v = std::ssize(names); v < variables_; ++v)
    names.push_back(std::string("v").append(std::to_string(v + 1)));
  return names;
}

void NativeLayoutReader::require_end() {
  step_ = Step::done;
  if (at_end_) return;
  const std::string found(tokens_->next().substr(0, longest_quote));
  place_ = tokens_->place();
  line_ = 0;
  refuse("text after the end: \"" + found + "\"; a row too many, or a count too small");
}

std::string_view NativeLayoutReader::comment_with(std::string_view text) const {
  return last_comment_with(text, passed_, RangeTokens::comment);
}

void NativeLayoutReader::refuse(const std::string& message) {
  throw TextFault{place_, line_ > 0 ? line_ : tokens_->line_of(place_), message};
}

void NativeLayoutReader::refuse_end(const std::string& expected) {
  place_ = tokens_->file_size();
  line_ = 0;
  refuse("the file ends where " + expected + " should follow");
}

void NativeLayoutReader::refuse_missing_rows() {
  const NativeSection& section = layout_.sections.back();
  const std::int64_t number = tokens_->end() - section.first_token;
  place_ = tokens_->file_size();
  line_ = 0;
  refuse("the file ends where " + expected_in(layout_, section, number) + " should follow" +
         place_of_value(layout_, section, number));
}

}  // namespace quadloop::io
