#include "io/foam/foam_fields.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "io/files/reading/input_file.hpp"
#include "io/foam/foam_patches.hpp"
#include "io/foam/foam_text.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

namespace fs = std::filesystem;

constexpr const char* field_blanks = " \t\r\n";

/// The text of a field file, with the position of its values.
struct FoamText {
  std::string path, text;
  std::size_t components = 0;      ///< 1 or 3
  std::size_t begin = 0, end = 0;  ///< of the value of internalField, up to its semicolon

  std::string name() const { return fs::path(path).filename(); }
  std::vector<std::string> variables() const {
    return components == 1 ? std::vector{name()} : std::vector{name() + "_x", name() + "_y"};
  }
};

/// Returns the position of the value after a key at the beginning of a line.
std::size_t value_of_key(const std::string& text, const std::string& key) {
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
    const std::size_t line = text.find_last_not_of(" \t", at - std::min<std::size_t>(at, 1));
    const bool begins = at == 0 || line == std::string::npos || text[line] == '\n' || text[line] == '{' ||
                        text[line] == ';' || text[line] == '}';
    const std::size_t value = text.find_first_not_of(field_blanks, at + key.size());
    if (begins && value != std::string::npos && value > at + key.size()) return value;
  }
  return std::string::npos;
}

std::string word_at(const std::string& text, std::size_t at) {
  if (at == std::string::npos) return {};
  return text.substr(at, text.find_first_of(" \t\r\n;", at) - at);
}

/// Empty if the file is not a cell field.
std::optional<FoamText> field_in(const std::string& path) {
  FoamText field{path, read_input(path), 0, 0, 0};
  const std::string plain = without_foam_comments(field.text);
  const std::string of_class = word_at(plain, value_of_key(plain, "class"));
  if (of_class == "volScalarField") field.components = 1;
  if (of_class == "volVectorField") field.components = 3;
  if (field.components == 0) return {};
  if (word_at(plain, value_of_key(plain, "format")) == "binary")
    throw InputError(path + ": is binary; set writeFormat ascii; in system/controlDict");
  field.begin = value_of_key(plain, "internalField");
  if (field.begin != std::string::npos) field.end = plain.find(';', field.begin);
  if (field.begin == std::string::npos || field.end == std::string::npos)
    throw InputError(path + ": has no internalField that ends with a semicolon");
  return field;
}

std::vector<FoamText> fields_in(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code fault;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, fault)) {
    if (entry.path().extension() == ".gz")
      throw InputError(
          entry.path().string() +
          ": is compressed; unpack it (gunzip), and set writeCompression off; in system/controlDict");
    if (entry.is_regular_file() && entry.path().filename().string().front() != '.')
      paths.push_back(entry.path());
  }
  if (fault) throw InputError(folder + ": cannot be read: " + fault.message());
  std::ranges::sort(paths);
  std::vector<FoamText> fields;
  for (const std::string& path : paths) {
    if (auto field = field_in(path)) fields.push_back(std::move(*field));
  }
  return fields;
}

/// A value of a field in the text: of internalField, or of a patch.
struct ValueText {
  const FoamText& field;
  std::size_t begin, end;
  std::string name, of, whole;  ///< for messages: "internalField", "cells", "the mesh"
};

/// Reads the numbers in a part of the text, ignoring brackets.
class Numbers {
 public:
  Numbers(const ValueText& value, std::size_t at)
      : value_{value}, at_{value.field.text.data() + at}, end_{value.field.text.data() + value.end} {}

  double next() {
    while (at_ < end_ &&
           (*at_ == '(' || *at_ == ')' || *at_ == '{' || std::isspace(static_cast<unsigned char>(*at_)) != 0))
      ++at_;
    double value = 0;
    const auto [after, fault] = std::from_chars(at_, end_, value);
    if (fault != std::errc() || !std::isfinite(value))
      throw InputError(value_.field.path + ": a value of " + value_.name +
                       " is missing, or no finite number");
    at_ = after;
    return value;
  }
  bool at_end() {
    while (at_ < end_ && (*at_ == ')' || *at_ == '}' || std::isspace(static_cast<unsigned char>(*at_)) != 0))
      ++at_;
    return at_ == end_;
  }

 private:
  const ValueText& value_;
  const char *at_, *end_;
};

/// Reads `count` rows of the field's components.
std::vector<double> values_of(const ValueText& value, std::size_t count) {
  const FoamText& field = value.field;
  const std::string word = word_at(field.text, value.begin);
  if (word == "uniform") {
    Numbers numbers(value, value.begin + word.size());
    std::vector<double> row(field.components), values;
    for (double& component : row) component = numbers.next();
    for (std::size_t i = 0; i < count; ++i) values.insert(values.end(), row.begin(), row.end());
    return values;
  }
  const std::size_t list = field.text.find('>', value.begin);
  if (word != "nonuniform" || list >= value.end)
    throw InputError(field.path + ": " + value.name + " is neither uniform nor a nonuniform list");
  Numbers numbers(value, list + 1);
  const double given = numbers.next();
  if (given != static_cast<double>(count))
    throw InputError(field.path + ": has values for " + std::to_string(static_cast<std::int64_t>(given)) +
                     " " + value.of + ", " + value.whole + " has " + std::to_string(count));
  std::vector<double> values(count * field.components);
  for (double& component : values) component = numbers.next();
  if (!numbers.at_end()) throw InputError(field.path + ": has more values than " + value.of);
  return values;
}

std::vector<double> values_of_cells(const FoamText& field, std::size_t cells) {
  return values_of({field, field.begin, field.end, "internalField", "cells", "the mesh"}, cells);
}

/// Returns the values of a field on a patch; empty if there are none.
std::vector<double> values_of_patch(const FoamText& field, const FoamPatch& patch) {
  const std::string plain = without_foam_comments(field.text);
  const auto boundary = foam_entry(foam_entries(plain), "boundaryField");
  if (!boundary || !boundary->is_block) return {};
  const auto block = foam_entry(foam_entries(plain, boundary->begin, boundary->end), patch.name);
  if (!block || !block->is_block) return {};
  const auto value = foam_entry(foam_entries(plain, block->begin, block->end), "value");
  if (!value || value->is_block) return {};
  return values_of({field, value->begin, value->end, "the value of " + patch.name, "faces", patch.name},
                   patch.cells.size());
}

/// Stores a patch's values in the columns of the field's variables.
void put_on_cells(const FoamText& field, const FoamPatch& patch, CellValues& cells) {
  const std::vector<double> values = values_of_patch(field, patch);
  const std::vector<std::string> variables = field.variables();
  for (std::size_t k = 0; k < variables.size() && !values.empty(); ++k) {
    const std::size_t column = std::ranges::find(cells.names, variables[k]) - cells.names.begin();
    if (column == cells.width()) continue;
    for (std::size_t face = 0; face < patch.cells.size(); ++face)
      cells.values[patch.cells[face] * cells.width() + column] = values[face * field.components + k];
  }
}

std::string text_of(double value) {
  std::array<char, 32> room;
  return {room.data(), std::to_chars(room.data(), room.data() + room.size(), value).ptr};
}

std::string list_of(const CellValues& cells, const std::vector<std::size_t>& columns) {
  const bool scalar = columns.size() == 1;
  const std::size_t rows = cells.values.size() / cells.width();
  std::string text = std::string("nonuniform List<") + (scalar ? "scalar" : "vector") + ">\n" +
                     std::to_string(rows) + "\n(\n";
  for (std::size_t row = 0; row < rows; ++row) {
    const auto value = [&](std::size_t k) { return text_of(cells.values[row * cells.width() + columns[k]]); };
    text += scalar ? value(0) + "\n" : "(" + value(0) + " " + value(1) + " 0)\n";
  }
  return text + ")\n";
}

}  // namespace

std::string latest_foam_time(const std::string& case_folder) {
  std::string latest;
  double largest = 0;
  std::error_code fault;
  for (const fs::directory_entry& entry : fs::directory_iterator(case_folder, fault)) {
    const std::string name = entry.path().filename();
    double time = 0;
    const auto [after, no_number] = std::from_chars(name.data(), name.data() + name.size(), time);
    if (no_number != std::errc() || after != name.data() + name.size() || !(time > largest)) continue;
    largest = time;
    latest = entry.path();
  }
  return latest;
}

CellValues read_foam_fields(const std::string& folder, std::size_t cells) {
  CellValues read;
  std::vector<std::vector<double>> columns;
  for (const FoamText& field : fields_in(folder)) {
    const std::vector<double> values = values_of_cells(field, cells);
    const std::vector<std::string> variables = field.variables();
    for (std::size_t k = 0; k < variables.size(); ++k) {
      read.names.push_back(variables[k]);
      std::vector<double>& column = columns.emplace_back();
      for (std::size_t i = k; i < values.size(); i += field.components) column.push_back(values[i]);
    }
  }
  for (std::size_t cell = 0; cell < cells; ++cell) {
    for (const std::vector<double>& column : columns) read.values.push_back(column[cell]);
  }
  return read;
}

void require_foam_fields(const std::string& folder) { fields_in(folder); }

void put_wall_values(const std::string& folder, const std::string& poly_mesh, CellValues& cells) {
  std::vector<FoamPatch> patches;
  for (const char* const name : {"yPlus", "wallShearStress"}) {
    const std::string path = (fs::path(folder) / name).string();
    const auto field = fs::is_regular_file(path) ? field_in(path) : std::nullopt;
    if (!field) continue;
    if (patches.empty())
      patches = read_foam_patches(poly_mesh, static_cast<std::int64_t>(cells.values.size() / cells.width()));
    for (const FoamPatch& patch : patches) {
      if (patch.type == "wall") put_on_cells(*field, patch, cells);
    }
  }
}

std::vector<std::string> set_foam_fields(const std::string& folder, const CellValues& cells) {
  std::vector<std::string> changed;
  for (FoamText& field : fields_in(folder)) {
    std::vector<std::size_t> columns;
    for (const std::string& variable : field.variables()) {
      const auto found = std::ranges::find(cells.names, variable);
      if (found != cells.names.end()) columns.push_back(found - cells.names.begin());
    }
    if (columns.size() < field.variables().size()) continue;
    field.text.replace(field.begin, field.end - field.begin, list_of(cells, columns));
    std::ofstream file(field.path, std::ios::binary | std::ios::trunc);
    file << field.text;
    file.close();
    if (!file) throw OutputError(field.path + ": cannot be written");
    changed.push_back(field.name());
  }
  return changed;
}

}  // namespace quadloop::io
