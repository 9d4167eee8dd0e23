#include "io/cgns/cgns_sink.hpp"

#include <optional>

#include "io/cgns/cgns_exponents.hpp"
#include "io/cgns/cgns_names.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

void CgnsSink::begin_base() {
  file_->check(cg_base_write(id(), base_name, dimension_, dimension_, &base_));
  file_->check(cg_goto(id(), base_, "end"));
  // the unit of length is chosen by the user
  file_->check(cg_dataclass_write(NormalizedByUnknownDimensional));
}

void CgnsSink::begin_zone(const std::string& name, std::int64_t nodes, std::int64_t cells) {
  const std::array<cgsize_t, 3> size{static_cast<cgsize_t>(nodes), static_cast<cgsize_t>(cells), 0};
  file_->check(cg_zone_write(id(), base_, name.c_str(), size.data(), Unstructured, &zone_));
  next_element_ = 1;
}

void CgnsSink::put_coordinates(std::span<const double> rows) {
  constexpr std::array names{"CoordinateX", "CoordinateY", "CoordinateZ"};
  const cgsize_t first = next_row_, last = advance(rows.size() / dimension_);
  for (int k = 0; k < dimension_; ++k) {
    take_column(rows, dimension_, k);
    int coordinate = 0;
    file_->check(cg_coord_partial_write(id(), base_, zone_, RealDouble, names[k], &first, &last,
                                        column_.data(), &coordinate));
    if (first == 1) put_length_dimension(coordinate);
  }
}

void CgnsSink::begin_solution(GridLocation_t location) {
  const char* const name = location == CellCenter ? "CellSolution" : "FlowSolution";
  file_->check(cg_sol_write(id(), base_, zone_, name, location, &solution_));
}

void CgnsSink::put_solution(std::span<const double> rows, const std::vector<std::string>& variables) {
  const std::vector<std::string> names = cgns_variable_names(variables);
  const std::size_t width = names.size();
  const cgsize_t first = next_row_, last = advance(rows.size() / width);
  for (std::size_t k = 0; k < width; ++k) {
    take_column(rows, width, k);
    int field = 0;
    file_->check(cg_field_partial_write(id(), base_, zone_, solution_, RealDouble, names[k].c_str(), &first,
                                        &last, column_.data(), &field));
    if (first == 1) describe_variable(field, variables[k], names[k]);
  }
}

void CgnsSink::begin_section(const std::string& name, ElementType_t type, std::int64_t elements) {
  const auto last = static_cast<cgsize_t>(next_element_ + elements - 1);
  file_->check(
      cg_section_partial_write(id(), base_, zone_, name.c_str(), type, next_element_, last, 0, &section_));
}

void CgnsSink::put_elements(std::span<const cgsize_t> nodes, std::size_t width) {
  const cgsize_t first = next_element_;
  next_element_ += static_cast<cgsize_t>(nodes.size() / width);
  file_->check(
      cg_elements_partial_write(id(), base_, zone_, section_, first, next_element_ - 1, nodes.data()));
}

std::unique_ptr<CgnsSink::File> CgnsSink::open(const StagedFile& staged) {
  cg_set_file_type(CG_FILE_HDF5);
  try {
    return std::make_unique<File>(staged.temporary, staged.path, CG_MODE_WRITE);
  } catch (const OutputError&) {  // the reason is unknown; writing a byte may reveal it
    OutputFile probe(staged);
    probe.write("?");
    probe.close();
    throw;
  }
}

cgsize_t CgnsSink::advance(std::size_t rows) {
  next_row_ += static_cast<cgsize_t>(rows);
  return next_row_ - 1;
}

void CgnsSink::take_column(std::span<const double> rows, std::size_t width, std::size_t k) {
  column_.resize(rows.size() / width);
  for (std::size_t i = 0; i < column_.size(); ++i) column_[i] = rows[i * width + k];
}

/// Sets the exponents of mass, length, time, temperature, angle: coordinates are lengths.
void CgnsSink::put_length_dimension(int coordinate) {
  const std::array<float, 5> exponents{0, 1, 0, 0, 0};
  file_->check(
      cg_goto(id(), base_, "Zone_t", zone_, "GridCoordinates_t", 1, "DataArray_t", coordinate, "end"));
  file_->check(cg_exponents_write(RealSingle, exponents.data()));
}

/// Sets the dimensions of a variable; the units are those of the solver, or it is non-dimensional.
void CgnsSink::describe_variable(int field, const std::string& variable, const std::string& name) {
  file_->check(
      cg_goto(id(), base_, "Zone_t", zone_, "FlowSolution_t", solution_, "DataArray_t", field, "end"));
  if (variable_name_of_cgns(name) != variable)
    file_->check(cg_descriptor_write(full_name_descriptor, variable.c_str()));
  const std::optional<CgnsExponents> exponents = cgns_exponents(name);
  if (!exponents) return;
  if (*exponents == CgnsExponents{})
    file_->check(cg_dataclass_write(NondimensionalParameter));
  else
    file_->check(cg_exponents_write(RealSingle, exponents->data()));
}

}  // namespace quadloop::io
