#include "io/cgns/cgns_values.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "io/cgns/cgns_names.hpp"

namespace quadloop::io {

namespace {

using Name = std::array<char, 33>;

/// Returns the name in its descriptor, else the equivalent of the standard name.
std::string own_name(const CgnsZone& from, int solution, int field, const std::string& name) {
  const auto& file = from.file;
  file.check(cg_goto(file.id(), from.base, "Zone_t", from.zone, "FlowSolution_t", solution, "DataArray_t",
                     field, "end"));
  const std::string kept = file.descriptor_here(full_name_descriptor).value_or("");
  return kept.empty() ? variable_name_of_cgns(name) : kept;
}

/// Variables of a solution: their names in the file, and ours.
struct Variables {
  std::vector<std::string> in_file, own;
};

Variables variables_of(const CgnsZone& from, int solution) {
  const auto& file = from.file;
  int fields = 0;
  file.check(cg_nfields(file.id(), from.base, from.zone, solution, &fields));
  Variables variables;
  for (int f = 1; f <= fields; ++f) {
    Name name{};
    DataType_t type = RealDouble;
    file.check(cg_field_info(file.id(), from.base, from.zone, solution, f, &type, name.data()));
    variables.in_file.emplace_back(name.data());
    variables.own.push_back(own_name(from, solution, f, name.data()));
  }
  return variables;
}

/// Reads one variable after another, `rows` values each.
std::vector<double> read_columns(const CgnsZone& from, int solution, cgsize_t rows,
                                 std::vector<std::string>& names) {
  const auto& file = from.file;
  Variables variables = variables_of(from, solution);
  std::vector<double> columns(variables.own.size() * std::size_t(rows));
  double* column = columns.data();
  for (const std::string& name : variables.in_file) {
    const cgsize_t first = 1;
    file.check(cg_field_read(file.id(), from.base, from.zone, solution, name.c_str(), RealDouble, &first,
                             &rows, column));
    column += rows;
  }
  names = std::move(variables.own);
  return columns;
}

void append_row(const std::vector<double>& columns, std::size_t rows, std::size_t row,
                std::vector<double>& values) {
  for (std::size_t at = row; at < columns.size(); at += rows) values.push_back(columns[at]);
}

/// In the file rows are in the order of the elements.
void read_in_cells(const CgnsZone& from, int solution, std::span<const std::vector<std::int64_t>> kinds,
                   CellValues& result) {
  std::vector<std::int64_t> sorted;
  for (const auto& elements : kinds) sorted.insert(sorted.end(), elements.begin(), elements.end());
  if (std::ssize(sorted) != from.cells)
    throw InputError(from.file.shown() + ": zone " + std::to_string(from.zone) + " is said to have " +
                     std::to_string(from.cells) + " cells, its sections hold " +
                     std::to_string(sorted.size()));
  std::ranges::sort(sorted);
  const std::vector<double> columns = read_columns(from, solution, from.cells, result.names);
  for (const auto& elements : kinds) {
    for (const std::int64_t element : elements)
      append_row(columns, from.cells, std::ranges::lower_bound(sorted, element) - sorted.begin(),
                 result.values);
  }
}

/// Calls `nodal(solution, name)` for the first solution at the vertices, `in_cells(solution, name)` for the
/// first in the cells.
template <class Nodal, class InCells>
void for_solutions(const CgnsZone& from, const Nodal& nodal, const InCells& in_cells) {
  int solutions = 0;
  bool has_nodal = false, has_cells = false;
  const auto& file = from.file;
  file.check(cg_nsols(file.id(), from.base, from.zone, &solutions));
  for (int s = 1; s <= solutions; ++s) {
    Name name{};
    GridLocation_t location = Vertex;
    file.check(cg_sol_info(file.id(), from.base, from.zone, s, name.data(), &location));
    if (location == Vertex && !std::exchange(has_nodal, true)) nodal(s, name.data());
    if (location == CellCenter && !std::exchange(has_cells, true)) in_cells(s, name.data());
  }
}

}  // namespace

Field read_cgns_values(const CgnsZone& from, std::span<const std::vector<std::int64_t>> elements) {
  Field result;
  for_solutions(
      from,
      [&](int solution, const char*) {
        const std::vector<double> columns = read_columns(from, solution, from.nodes, result.names);
        for (cgsize_t i = 0; i < from.nodes; ++i) append_row(columns, from.nodes, i, result.values);
      },
      [&](int solution, const char*) { read_in_cells(from, solution, elements, result.cells); });
  return result;
}

Field note_cgns_values(const CgnsZone& from, const std::string& path, std::int64_t cells,
                       CgnsContents& contents) {
  Field result;
  const auto note = [&](int solution, const std::string& name, std::int64_t count,
                        std::vector<CgnsArray>& arrays) {
    Variables variables = variables_of(from, solution);
    for (const std::string& variable : variables.in_file)
      arrays.emplace_back(path + "/" + name + "/" + variable, count);
    return std::move(variables.own);
  };
  for_solutions(
      from,
      [&](int solution, const char* name) {
        result.names = note(solution, name, from.nodes, contents.values);
      },
      [&](int solution, const char* name) {
        result.cells.names =
            note(solution, name, cells == from.cells ? cells : CgnsArray::unknown, contents.cell_values);
      });
  return result;
}

}  // namespace quadloop::io
